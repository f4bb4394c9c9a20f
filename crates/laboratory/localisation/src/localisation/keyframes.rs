//! Which scan a scan is matched against.

use crate::error::Error;
use crate::estimate::PoseEstimate;
use crate::localisation::{Localisation, MatchAgainst};
use crate::matching::{Match, MatchOptions, Status};
use crate::reference::Reference;
use crate::scan::Scan;
use nalgebra::{Matrix3, Vector3};
use trackdyn_core::Pose;
use trackdyn_core::pose::wrap_angle;

/// A scan that others are matched against.
struct Keyframe {
    /// Index of the scan.
    scan: usize,
    reference: Reference,
    /// Pose of its sensor in the frame of the first.
    estimate: PoseEstimate,
}

/// Where the sensor was at a scan.
pub(super) struct Found {
    /// Pose of the sensor in the frame of the first.
    pub(super) estimate: PoseEstimate,
    pub(super) status: Status,
    /// Index of the scan that was the reference.
    pub(super) reference: usize,
    pub(super) reduced_chi_square: f64,
}

/// Follows the sensor from scan to scan.
pub(super) struct Tracker<'a> {
    options: &'a MatchOptions,
    /// Least overlap with a keyframe.
    overlap: f64,
    keyframes: Vec<Keyframe>,
    /// Index of the keyframe in use.
    current: usize,
    /// The scan before: its index, itself and its pose.
    before: (usize, &'a Scan, PoseEstimate),
}

/// Largest number of earlier keyframes that are tried before a new one is made, nearest first.
/// Those further off share less.
const MAX_KEYFRAMES_TRIED: usize = 3;

impl<'a> Tracker<'a> {
    pub(super) fn new(first: &'a Scan, options: &'a Localisation) -> Result<Self, Error> {
        // No overlap reaches two: every scan becomes the reference of the next.
        let overlap = match options.against {
            MatchAgainst::Previous => 2.0,
            MatchAgainst::Keyframes { overlap } => overlap,
        };
        let estimate = PoseEstimate::exact(Pose::default());
        let mut tracker = Self {
            options: &options.matching,
            overlap,
            keyframes: Vec::new(),
            current: 0,
            before: (0, first, estimate),
        };
        tracker.promote_the_scan_before()?;
        Ok(tracker)
    }

    /// Localises the next scan, given about how the sensor moved.
    pub(super) fn follow(&mut self, scan: &'a Scan, guess: &Pose) -> Result<Found, Error> {
        let index = self.before.0 + 1;
        let predicted = self.before.2.pose.compose(guess);
        let (keyframe, found) = self.find(scan, &predicted)?;
        let failed = !found.is_good();
        let reference = &self.keyframes[keyframe];
        let estimate = if failed {
            let deviation = self.options.guess;
            let deviations = Vector3::new(deviation.position, deviation.position, deviation.yaw);
            let covariance = Matrix3::from_diagonal(&deviations.component_mul(&deviations));
            self.before.2.compose(&PoseEstimate { pose: *guess, covariance })
        } else {
            reference.estimate.compose(&found.motion)
        };
        let reference = reference.scan;
        self.current = keyframe;
        self.before = (index, scan, estimate);
        if failed {
            // What the scans before show is no longer known to be near.
            self.promote_the_scan_before()?;
        }
        Ok(Found {
            estimate,
            status: found.status,
            reference,
            reduced_chi_square: found.reduced_chi_square,
        })
    }

    /// The keyframe to trust, and the match against it: the one in use, an earlier one, or the scan
    /// before. Where the scan before shows too little, a keyframe with less overlap is better.
    fn find(&mut self, scan: &Scan, predicted: &Pose) -> Result<(usize, Match), Error> {
        let mut second_best: Option<(usize, Match)> = None;
        if self.overlap <= 1.0 {
            let mut tried = self.nearest(predicted);
            tried.retain(|keyframe| *keyframe != self.current);
            tried.truncate(MAX_KEYFRAMES_TRIED);
            for keyframe in std::iter::once(self.current).chain(tried) {
                let found = self.against(keyframe, scan, predicted)?;
                if found.status != Status::Converged {
                    continue;
                }
                if found.overlap() >= self.overlap {
                    return Ok((keyframe, found));
                }
                if second_best.is_none_or(|(_, best)| found.matched > best.matched) {
                    second_best = Some((keyframe, found));
                }
            }
        }
        if self.keyframes[self.current].scan != self.before.0 {
            self.promote_the_scan_before()?;
        }
        let found = self.against(self.current, scan, predicted)?;
        match second_best {
            Some(second_best) if found.status != Status::Converged => Ok(second_best),
            _ => Ok((self.current, found)),
        }
    }

    fn against(&self, keyframe: usize, scan: &Scan, predicted: &Pose) -> Result<Match, Error> {
        let Keyframe { reference, estimate, .. } = &self.keyframes[keyframe];
        let mut guess = estimate.pose.relative(predicted);
        guess.yaw = wrap_angle(guess.yaw);
        reference.locate(scan, &guess, self.options)
    }

    /// Keyframes, by distance: a turn of one radian sees as little of what a scan saw as a metre.
    fn nearest(&self, predicted: &Pose) -> Vec<usize> {
        let distance = |keyframe: &Keyframe| {
            let off = keyframe.estimate.pose.relative(predicted);
            off.x.hypot(off.y) + wrap_angle(off.yaw).abs()
        };
        let mut order: Vec<usize> = (0..self.keyframes.len()).collect();
        order.sort_by(|a, b| {
            distance(&self.keyframes[*a]).total_cmp(&distance(&self.keyframes[*b]))
        });
        order
    }

    fn promote_the_scan_before(&mut self) -> Result<(), Error> {
        let (index, scan, estimate) = self.before;
        let reference = Reference::new(scan, self.options.range_noise)?;
        self.current = self.keyframes.len();
        self.keyframes.push(Keyframe { scan: index, reference, estimate });
        Ok(())
    }
}
