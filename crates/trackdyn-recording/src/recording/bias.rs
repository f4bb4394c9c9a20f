//! Readings of a side that are off by one speed all the time, also at rest.
//!
//! # Law
//! The offsets of [`linear`](super::linear) are taken off where both the turn and the way forward
//! tell them: a heading that drifts turns the robot and moves it nowhere. A side that reads zero
//! while it stands has none.

use super::Run;
use super::finding::{Cleaning, Finding};
use super::linear::{Linear, MIN_PIECE, offsets};
use crate::sample::Stream;
use trackdyn_core::{Side, real};

/// Fewest standard errors of an offset. Slopes, slip and drifts of real robots, which the errors
/// take for chance, reach three.
const MIN_ERRORS: f64 = 6.0;

/// Fewest standard errors of the way per time that neither track explains.
const MIN_ERRORS_OF_WAY: f64 = 4.0;

/// Smallest offset, as share of the root mean square of the speeds of its side.
const MIN_SHARE: f64 = 0.01;

/// Largest share of readings at zero.
const MAX_ZEROS: f64 = 0.01;

/// Takes the biases off; `cleanings` takes what was found.
pub(super) fn take_off(runs: &mut [Run], cleanings: &mut Vec<Cleaning>) {
    if !runs.iter().all(Run::has_positions) {
        return;
    }
    let moving = [(Side::Left, 0), (Side::Right, 1)];
    let moving: Vec<_> = moving.into_iter().filter(|(side, _)| !stands(runs, *side)).collect();
    if moving.is_empty() {
        return;
    }
    let Some(linear) = Linear::of(runs, MIN_PIECE, &|_, _, _| false) else { return };
    let [way, error] = linear.number(|[_, forward]| forward.z);
    if way.abs() < MIN_ERRORS_OF_WAY * error {
        return;
    }
    for (side, place) in moving {
        let [speed, error] = linear.number(|fit| offsets(fit)[place]);
        let count = real(speeds(runs, side).count().max(1));
        let usual = (speeds(runs, side).map(|speed| speed * speed).sum::<f64>() / count).sqrt();
        let shows = speed.abs() > MIN_ERRORS * error && speed.abs() > MIN_SHARE * usual;
        if !shows {
            continue;
        }
        for run in runs.iter_mut() {
            let (id, t) = (run.id(), run.tracks().first().map_or(0.0, |reading| reading.t));
            for reading in run.readings_mut() {
                *reading.speed_mut(side) -= speed;
            }
            let (stream, finding) = (Stream::Tracks, Finding::Biased { side, speed });
            let count = run.tracks().len();
            cleanings.push(Cleaning { stream, finding, count, runs: 1, run: id, t });
        }
    }
}

/// Speeds of a side, m/s.
pub(super) fn speeds(runs: &[Run], side: Side) -> impl Iterator<Item = f64> + '_ {
    runs.iter().flat_map(Run::tracks).map(move |reading| reading.speeds()[side])
}

/// Whether a side reads zero while it stands.
fn stands(runs: &[Run], side: Side) -> bool {
    let zeros = speeds(runs, side).filter(|speed| *speed == 0.0).count();
    real(zeros) / real(speeds(runs, side).count().max(1)) > MAX_ZEROS
}
