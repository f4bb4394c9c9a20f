//! Poses that stay where they are in all of a recording.

use super::Run;
use super::stretches::path_extent;
use crate::doubt::Doubt;
use crate::sample::TrackSample;

/// Least way of the tracks, and least way that one ran more than the other, m.
const MIN_WAY: f64 = 1.0;

/// Sum of two squared correlations from which on poses follow the tracks.
const MAX_EXPLAINED_SHARE: f64 = 0.7;

/// Largest turn of poses that are stuck, rad.
const MAX_STUCK_TURN: f64 = 0.1;

/// Largest extent of poses that are stuck, per way of the tracks.
const MAX_STUCK_SHARE: f64 = 0.02;

/// Largest extent of poses that are stuck, m.
const MAX_STUCK_EXTENT: f64 = 0.2;

/// Poses that do not move while the tracks do. Poses of another unit are as small and follow the
/// tracks: `explained` is the sum of two squared correlations of their motions.
pub(super) fn stuck_poses(runs: &[Run], explained: f64) -> Option<Doubt> {
    let extent = |run: &Run| path_extent(run.poses()).unwrap_or(0.0);
    let extent = runs.iter().map(extent).fold(0.0, f64::max);
    let turns = |run: &Run| {
        let yaws = || run.poses().iter().map(|sample| sample.pose.yaw);
        yaws().fold(f64::NEG_INFINITY, f64::max) - yaws().fold(f64::INFINITY, f64::min)
    };
    let is_turned = runs.iter().map(turns).any(|turn| turn > MAX_STUCK_TURN);
    let steps = || runs.iter().flat_map(|run| run.tracks().windows(2));
    let sum = |of: fn(&TrackSample) -> f64| -> f64 {
        steps().map(|pair| of(&pair[0]).abs() * (pair[1].t - pair[0].t)).sum()
    };
    let travelled = sum(|sample| f64::midpoint(sample.v_left, sample.v_right));
    let turning = sum(|sample| sample.v_right - sample.v_left);
    let is_stuck = travelled >= MIN_WAY
        && turning >= MIN_WAY
        && extent <= (MAX_STUCK_SHARE * travelled).min(MAX_STUCK_EXTENT)
        && !is_turned
        && runs.iter().all(Run::has_positions)
        && explained < MAX_EXPLAINED_SHARE;
    is_stuck.then_some(Doubt::StuckPoses { travelled, extent })
}
