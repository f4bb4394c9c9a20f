//! The poses of a series of scans.
//!
//! Scans are matched against keyframes: a scan stays the reference of those that follow for as long
//! as they share enough with it. Errors add up from keyframe to keyframe, not from scan to scan,
//! and stop adding up where the robot comes back to a place that an earlier keyframe saw.

use crate::error::{Error, accept, finite};
use crate::estimate::PoseEstimate;
use crate::matching::{MatchOptions, Status};
use crate::scan::Scan;
use trackdyn_core::Pose;

mod keyframes;

use keyframes::Tracker;

/// How a series of scans is localised.
#[derive(Clone, Debug, PartialEq)]
pub struct Localisation {
    /// How two scans are matched; the guess is that of the odometry between two scans.
    pub matching: MatchOptions,
    /// What scans are matched against.
    pub against: MatchAgainst,
    /// Pose of the sensor on the robot (x forward, y left), m and rad.
    pub robot_from_sensor: Pose,
}

/// What scans are matched against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MatchAgainst {
    /// The scan before, as the paper does: errors add up with every scan.
    Previous,
    /// A keyframe, for as long as this share of the returns, 0 to 1, agrees with its lines.
    Keyframes {
        /// Least share.
        overlap: f64,
    },
}

impl Default for Localisation {
    /// Keyframes of which 60 % of the returns agree, where drift was least on paths through a
    /// furnished room, with the sensor at the robot's origin.
    fn default() -> Self {
        Self {
            matching: MatchOptions::default(),
            against: MatchAgainst::Keyframes { overlap: 0.6 },
            robot_from_sensor: Pose::default(),
        }
    }
}

/// Where the robot was at one scan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalisedPose {
    /// Time of the scan, s.
    pub stamp: f64,
    /// Pose of the robot in the frame of its first one, with covariance. Neighbours share a
    /// reference, and with it much of their error: their motion is known better than the sum of
    /// their covariances says.
    pub estimate: PoseEstimate,
    /// What became of the match. Where it failed, the pose is that of the odometry from the scan
    /// before.
    pub status: Status,
    /// Index of the scan that was the reference, from 0; its own for the first.
    pub reference: usize,
    /// Squared residuals per degree of freedom, 1; not a number where nothing was matched.
    pub reduced_chi_square: f64,
}

/// Localises a series of scans, given where odometry puts the robot at each of them.
///
/// Of the odometry only the motion between neighbouring scans is used, as the guess of a match and
/// where a match fails or is degenerate.
///
/// # Assumes
/// Scans as [`Reference::locate`](crate::Reference::locate) does. Errors of matches along a chain
/// of keyframes are taken as independent; a keyframe that is matched and matched against has errors
/// of opposite sign in the two, so that the covariance is on the safe side.
///
/// # Errors
/// [`Error::Odometry`], [`Error::Order`], and [`Error::Value`] for odometry or options that cannot
/// be.
pub fn localise(
    scans: &[Scan],
    odometry: &[Pose],
    options: &Localisation,
) -> Result<Vec<LocalisedPose>, Error> {
    check(scans, odometry, options)?;
    let Some(first) = scans.first() else { return Ok(Vec::new()) };
    let mut tracker = Tracker::new(first, options)?;
    let mut poses = vec![LocalisedPose {
        stamp: first.stamp(),
        estimate: PoseEstimate::exact(Pose::default()),
        status: Status::Converged,
        reference: 0,
        reduced_chi_square: f64::NAN,
    }];
    let mount = &options.robot_from_sensor;
    for (scan, pair) in scans[1..].iter().zip(odometry.windows(2)) {
        let guess = mount.inverse().compose(&pair[0].relative(&pair[1])).compose(mount);
        let found = tracker.follow(scan, &guess)?;
        poses.push(LocalisedPose {
            stamp: scan.stamp(),
            estimate: found.estimate.of_carrier(mount),
            status: found.status,
            reference: found.reference,
            reduced_chi_square: found.reduced_chi_square,
        });
    }
    Ok(poses)
}

fn check(scans: &[Scan], odometry: &[Pose], options: &Localisation) -> Result<(), Error> {
    options.matching.check()?;
    if let MatchAgainst::Keyframes { overlap } = options.against {
        let good = (0.0..=1.0).contains(&overlap);
        accept("overlap", overlap, good, "a share between 0 and 1")?;
    }
    for pose in odometry.iter().chain([&options.robot_from_sensor]) {
        finite("pose, x", pose.x)?;
        finite("pose, y", pose.y)?;
        finite("pose, yaw", pose.yaw)?;
    }
    if odometry.len() != scans.len() {
        return Err(Error::Odometry { found: odometry.len(), expected: scans.len() });
    }
    match scans.windows(2).position(|pair| pair[1].stamp() <= pair[0].stamp()) {
        Some(index) => Err(Error::Order {
            index: index + 1,
            stamp: scans[index + 1].stamp(),
            before: scans[index].stamp(),
        }),
        None => Ok(()),
    }
}
