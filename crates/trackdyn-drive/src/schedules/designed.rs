//! Manoeuvres that set each pattern of track speeds against the others.
//!
//! Spins, arcs with tracks of the same and of opposite sign, straight runs, and turns about either
//! track at rest. Each is driven both ways, forward and backward, at a quarter, half, three
//! quarters and all of the largest speed; turns about a track at rest are driven forward only. A
//! departure from constant ICRs shows as a difference between patterns, directions or speeds. Every
//! manoeuvre starts and ends at rest, where inertia and delays show. The order is random, so that a
//! drift in time is not taken for one of them.

use super::ScheduleOptions;
use super::ramp::Ramp;
use crate::random::{Purpose, stream};
use rand::seq::SliceRandom;
use trackdyn_core::{PerSide, Schedule};

/// Time at constant speeds, s: ten segments of 0.27 s.
const STEADY_DURATION: f64 = 2.7;
/// Standing between manoeuvres, s.
const REST_DURATION: f64 = 1.2;
/// Shares of the largest speed.
const SPEEDS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
/// Track speeds (left, right) per speed of the faster one.
const PATTERNS: [(f64, f64); 14] = [
    (1.0, 1.0),
    (-1.0, -1.0),
    (-1.0, 1.0),
    (1.0, -1.0),
    // same sign, by the ratio a half
    (0.5, 1.0),
    (1.0, 0.5),
    (-0.5, -1.0),
    (-1.0, -0.5),
    // opposite sign, by the ratio a third
    (-1.0 / 3.0, 1.0),
    (1.0, -1.0 / 3.0),
    (1.0 / 3.0, -1.0),
    (-1.0, 1.0 / 3.0),
    // one track at rest
    (0.0, 1.0),
    (1.0, 0.0),
];

/// All manoeuvres in the order of this run, again and again until the duration where one is asked
/// for.
pub(super) fn schedule(options: &ScheduleOptions, run: i64) -> Schedule {
    let mut manoeuvres: Vec<PerSide<f64>> = SPEEDS
        .iter()
        .flat_map(|speed| {
            PATTERNS.map(|(left, right)| {
                PerSide::new(left, right).map(|share| options.fastest * speed * share)
            })
        })
        .collect();
    let mut random = stream(options.seed, run, Purpose::Order);
    manoeuvres.shuffle(&mut random);
    let mut ramp = Ramp::new(options);
    ramp.hold(PerSide::default(), REST_DURATION);
    loop {
        for speeds in &manoeuvres {
            ramp.hold(*speeds, STEADY_DURATION);
            ramp.hold(PerSide::default(), REST_DURATION);
            if options.duration.is_some_and(|duration| ramp.time() >= duration) {
                return ramp.finish();
            }
        }
        if options.duration.is_none() {
            return ramp.finish();
        }
    }
}
