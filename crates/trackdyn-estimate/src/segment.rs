//! Segments: pieces between two poses with several track readings in them.
//!
//! Within a run all segments span the same number of pose intervals. Where stamps of poses are
//! coarse, a cut at the first pose that is late enough would pick late stamps, and segments would
//! look longer than they are: by half a percent in runs of two seconds whose stamps are those of
//! readings 0.05 s apart.

use crate::gaps::Gaps;
use std::ops::Range;
use trackdyn_core::robust::usual_interval;
use trackdyn_core::{Pose, real};
use trackdyn_recording::hold::{holding, readings};
use trackdyn_recording::recording::longest_interval;
use trackdyn_recording::{Recording, Run};

/// How to cut a recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentOptions {
    /// A segment lasts at least this long, s, by the median interval of the run's poses.
    pub minimum_duration: f64,
    /// A segment spans at least this many readings of the tracks, by the median intervals of the
    /// run.
    pub minimum_readings: usize,
    /// A longer interval between two poses is not bridged, s; none: five times the run's median,
    /// and at least 0.1 s.
    pub longest_pose_interval: Option<f64>,
    /// A longer interval between two readings is not bridged, s; none: five times the run's median,
    /// and at least 0.1 s.
    pub longest_track_interval: Option<f64>,
    /// Clock offset of the poses against the encoders, s ([`hold`](trackdyn_recording::hold)).
    pub tau: f64,
    /// Readings must also be there for clock offsets that differ from `tau` by this much, s.
    pub tau_margin: f64,
}

impl Default for SegmentOptions {
    /// # Sources
    /// Martinez et al. 2005, section 5: a segment lasts 0.27 s. Theirs has nine readings of 30 ms;
    /// five let readings at 20 Hz in.
    fn default() -> Self {
        Self {
            minimum_duration: 0.27,
            minimum_readings: 5,
            longest_pose_interval: None,
            longest_track_interval: None,
            tau: 0.0,
            tau_margin: 0.0,
        }
    }
}

/// A piece between two poses.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Index of its run in [`Recording::runs`].
    pub run: usize,
    /// Indices of its first and last pose in the run.
    pub poses: [usize; 2],
    /// Stamp of its first pose, s of the pose clock.
    pub start: f64,
    /// Stamp of its last pose, s of the pose clock.
    pub end: f64,
    /// Indices of the readings that hold at some time within it, at the clock offset of the
    /// options.
    pub readings: Range<usize>,
    /// Observed motion `start_from_end`: the last pose seen from the first, yaw over whole turns.
    pub observed: Pose,
    /// Whether its first pose is the last pose of the segment before it. The noise of the shared
    /// pose then enters both with opposite signs: increments along a line correlate by −1/2.
    pub follows: bool,
}

impl Segment {
    /// Time between its poses, s.
    pub fn duration(&self) -> f64 {
        self.end - self.start
    }
}

/// Cuts all runs, each from its first pose on; segments are as short as the options allow.
pub fn segments(recording: &Recording, options: &SegmentOptions) -> Vec<Segment> {
    let runs = recording.runs().iter().enumerate();
    runs.flat_map(|(index, run)| Cut::new(index, run, options).segments()).collect()
}

/// Share of the shortest duration below which a segment takes more pose intervals: its stamps are
/// crowded.
const MIN_DURATION_SHARE: f64 = 0.5;

/// Pose intervals that last for a time, at least one. Rounding must not add one.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small and positive")]
fn intervals_in(duration: f64, pose_interval: f64) -> usize {
    const MAX_INTERVALS: f64 = 1e6;
    let intervals = (duration / pose_interval * (1.0 - 1e-9)).ceil();
    if intervals.is_finite() { intervals.clamp(1.0, MAX_INTERVALS) as usize } else { 1 }
}

struct Cut<'a> {
    index: usize,
    run: &'a Run,
    options: &'a SegmentOptions,
    longest_pose_interval: f64,
    /// Pose intervals that a segment spans.
    pose_intervals: usize,
    gaps: Gaps,
}

impl<'a> Cut<'a> {
    fn new(index: usize, run: &'a Run, options: &'a SegmentOptions) -> Self {
        let pose_interval = usual_interval(run.poses().iter().map(|sample| sample.t));
        let track_interval = usual_interval(run.tracks().iter().map(|sample| sample.t));
        let longest_track =
            options.longest_track_interval.unwrap_or(longest_interval(track_interval));
        let wanted = options.minimum_duration.max(real(options.minimum_readings) * track_interval);
        Self {
            index,
            run,
            options,
            longest_pose_interval: options
                .longest_pose_interval
                .unwrap_or(longest_interval(pose_interval)),
            pose_intervals: intervals_in(wanted, pose_interval),
            gaps: Gaps::longer_than(longest_track, run.tracks()),
        }
    }

    fn segments(&self) -> Vec<Segment> {
        let poses = self.run.poses();
        let mut segments: Vec<Segment> = Vec::new();
        let mut first = 0;
        for last in 1..poses.len() {
            if poses[last].t - poses[last - 1].t > self.longest_pose_interval {
                first = last;
                continue;
            }
            let duration = poses[last].t - poses[first].t;
            let is_short = duration < MIN_DURATION_SHARE * self.options.minimum_duration;
            if last - first < self.pose_intervals || is_short {
                continue;
            }
            let Some(readings) = self.covered(poses[first].t, poses[last].t) else {
                // The piece up to here cannot be used: the next one starts where this one did not
                // end.
                first += 1;
                continue;
            };
            let follows = segments.last().is_some_and(|before| before.poses[1] == first);
            segments.push(Segment {
                run: self.index,
                poses: [first, last],
                start: poses[first].t,
                end: poses[last].t,
                readings,
                observed: poses[first].pose.relative(&poses[last].pose),
                follows,
            });
            first = last;
        }
        segments
    }

    /// The readings that hold between two times of the pose clock. None where a gap lies within, or
    /// where readings are missing for a clock offset within the margin.
    fn covered(&self, start: f64, end: f64) -> Option<Range<usize>> {
        let SegmentOptions { tau, tau_margin, .. } = *self.options;
        let tracks = self.run.tracks();
        let (earliest, latest) = (start - tau - tau_margin, end - tau + tau_margin);
        holding(tracks, earliest)?;
        // The last reading holds until its stamp: what comes after was not measured.
        let is_known = latest <= tracks.last()?.t && !self.gaps.meet(earliest, latest);
        is_known.then(|| readings(tracks, start, end, tau))
    }
}
