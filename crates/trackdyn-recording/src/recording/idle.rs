//! Sides whose speed never changes while the poses move as if it did.
//!
//! # Law
//! Where a track stands or runs at one speed, turn and way forward are T u + D w, with T the time
//! of a stretch and D the way of the other track. Where this leaves much of the turns or of the
//! ways, for all delays of the poses, the track did not do what its readings say.

use super::Run;
use super::stretches::Stretch;
use crate::doubt::Doubt;
use trackdyn_core::{PerSide, Pose, Side, real};

/// Fewest stretches that a finding needs.
const MIN_STRETCHES: usize = 20;

/// Largest difference of two readings of a speed that never changes, m/s.
const MAX_CHANGE: f64 = 1e-9;

/// Part of the squares that constant speeds have to explain.
const MIN_EXPLAINED_SHARE: f64 = 0.7;

/// Least turn that is larger than noise, rad.
const MIN_TURN: f64 = 0.1;

/// Largest standard deviation of the positions of a robot that stands still, m.
const STILL_POSITION: f64 = 0.02;

/// Standard deviation of its yaw, rad.
const STILL_YAW: f64 = 0.02;

/// Delays of the poses that are tried, s.
const DELAYS: [f64; 5] = [-0.5, 0.0, 0.25, 0.5, 1.0];

/// A side that shows one speed all the time, and poses that contradict it.
pub(super) fn dead_encoder(runs: &[Run], late: &dyn Fn(f64) -> Vec<Stretch>) -> Option<Doubt> {
    let speed = PerSide::from_fn(|side: Side| constant_speed(runs, side));
    let (side, of_dead) = speed.either(|left, _| left)?;
    let is_explained = DELAYS.iter().any(|&delay| are_explained(&late(delay), side));
    if is_explained {
        return None;
    }
    if speed == PerSide::new(Some(0.0), Some(0.0)) && runs.iter().all(is_still) {
        let duration = runs.iter().map(Run::duration).sum();
        return Some(Doubt::StoodStill { duration });
    }
    Some(Doubt::DeadEncoder { side, speed: of_dead })
}

/// Whether the poses of a run show nothing but noise. Of white noise, steps have twice the variance
/// of the values; a robot that moves has gone many steps.
fn is_still(run: &Run) -> bool {
    let is_noise = |of: &dyn Fn(&Pose) -> f64, small: f64| {
        let values: Vec<f64> = run.poses().iter().map(|sample| of(&sample.pose)).collect();
        let values: Vec<f64> = values.into_iter().filter(|value| value.is_finite()).collect();
        let count = real(values.len().max(1));
        let mean = values.iter().sum::<f64>() / count;
        let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count;
        let steps = values.windows(2).map(|pair| (pair[1] - pair[0]).powi(2));
        variance <= (steps.sum::<f64>() / count).max(small * small)
    };
    is_noise(&|pose| pose.x, STILL_POSITION)
        && is_noise(&|pose| pose.y, STILL_POSITION)
        && is_noise(&|pose| pose.yaw, STILL_YAW)
}

/// The speed of a side that never changes.
fn constant_speed(runs: &[Run], side: Side) -> Option<f64> {
    let mut speeds = runs.iter().flat_map(Run::tracks).map(|reading| reading.speeds()[side]);
    let first = speeds.next()?;
    speeds.all(|speed| (speed - first).abs() <= MAX_CHANGE).then_some(first)
}

/// Whether turns and ways are those of a track at one speed.
fn are_explained(stretches: &[Stretch], dead: Option<Side>) -> bool {
    if stretches.len() < MIN_STRETCHES {
        return true;
    }
    let other = |stretch: &Stretch| dead.map_or(0.0, |side| stretch.tracks[side.other()]);
    let left_of = |of: fn(&Stretch) -> f64| {
        let rows = stretches.iter().map(|stretch| [stretch.duration, other(stretch), of(stretch)]);
        left(rows)
    };
    let [turn, turns] = left_of(|stretch| stretch.turn);
    let [way, ways] = left_of(|stretch| stretch.forward);
    let is_explained = |left: f64, all: f64| left <= (1.0 - MIN_EXPLAINED_SHARE) * all;
    let is_noise = turn <= real(stretches.len()) * MIN_TURN * MIN_TURN;
    (is_explained(turn, turns) || is_noise) && is_explained(way, ways)
}

/// Sum of the squares of z that no T u + D w explains, and of all z, from rows of T, D and z.
fn left(rows: impl Iterator<Item = [f64; 3]>) -> [f64; 2] {
    let (mut tt, mut td, mut dd, mut tz, mut dz, mut zz) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for [t, d, z] in rows {
        tt += t * t;
        td += t * d;
        dd += d * d;
        tz += t * z;
        dz += d * z;
        zz += z * z;
    }
    let determinant = tt * dd - td * td;
    let is_regular = determinant > 1e-9 * tt * dd;
    let explained = if is_regular {
        (dd * tz * tz - 2.0 * td * tz * dz + tt * dz * dz) / determinant
    } else if tt > 0.0 {
        tz * tz / tt
    } else {
        0.0
    };
    [(zz - explained).max(0.0), zz]
}
