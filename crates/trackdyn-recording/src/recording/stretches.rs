//! Stretches of a run: what tracks and poses did between two of its poses.

use super::Run;
use crate::hold::travelled;
use crate::sample::PoseSample;
use trackdyn_core::PerSide;

/// Number of stretches that the extent of the path is divided into.
const PARTS: f64 = 40.0;

/// Largest turn within a stretch, rad.
const MAX_TURN: f64 = 0.5;

/// What tracks and poses did between two poses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stretch {
    /// Its time, s.
    pub(super) duration: f64,
    /// Way of each track, m.
    pub(super) tracks: PerSide<f64>,
    /// Distance of both poses, m.
    pub(super) distance: f64,
    /// Way of the poses along their mean heading, m.
    pub(super) forward: f64,
    /// Turn of the poses, rad.
    pub(super) turn: f64,
    /// Whether it ended by its distance and not by its turn.
    pub(super) is_straight: bool,
}

impl Stretch {
    /// Mean way of the tracks, m.
    pub(super) fn forward_of_tracks(&self) -> f64 {
        0.5 * (self.tracks.left + self.tracks.right)
    }
}

/// Diagonal of the box around all finite positions, m.
pub(super) fn path_extent(poses: &[PoseSample]) -> Option<f64> {
    let span = |of: fn(&PoseSample) -> f64| {
        let values = || poses.iter().map(of).filter(|value| value.is_finite());
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    let extent = span(|sample| sample.pose.x).hypot(span(|sample| sample.pose.y));
    extent.is_finite().then_some(extent)
}

/// The stretches of a run, each up to a portion of the path's extent or half a radian. Poses are
/// `tau` s late.
pub(super) fn stretches(run: &Run, tau: f64) -> Vec<Stretch> {
    let poses = run.poses();
    let (Some(extent), [first_reading, ..]) = (path_extent(poses), run.tracks()) else {
        return Vec::new();
    };
    let length = if run.has_positions() { extent / PARTS } else { f64::INFINITY };
    let last_reading = run.tracks()[run.tracks().len() - 1].t;
    let mut stretches = Vec::new();
    let within =
        |sample: &&PoseSample| (first_reading.t..=last_reading).contains(&(sample.t - tau));
    let mut poses = poses.iter().filter(within);
    let Some(mut start) = poses.next() else { return stretches };
    for end in poses {
        let turn = end.pose.yaw - start.pose.yaw;
        let (x, y) = (end.pose.x - start.pose.x, end.pose.y - start.pose.y);
        let distance = x.hypot(y);
        let is_straight = distance >= length && distance > 0.0;
        if !is_straight && turn.abs() < MAX_TURN {
            continue;
        }
        let (sin, cos) = (start.pose.yaw + 0.5 * turn).sin_cos();
        stretches.push(Stretch {
            duration: end.t - start.t,
            tracks: travelled(run.tracks(), start.t, end.t, tau),
            distance,
            forward: cos * x + sin * y,
            turn,
            is_straight: is_straight && turn.abs() < MAX_TURN,
        });
        start = end;
    }
    stretches
}
