//! Who drives, for how long and from where.

use crate::failure::Failure;
use crate::machine::Machine;
use crate::random::uniform;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use std::f64::consts::PI;
use trackdyn_core::rounding::Digits;
use trackdyn_core::{Pose, Schedule};
use trackdyn_drive::{ScheduleKind, ScheduleOptions};

/// Runs to learn from: 0 to 8.
pub const TRAINING_RUNS: usize = 9;
/// Runs to be judged on: 9 to 11.
pub const HELD_OUT_RUNS: usize = 3;
/// The held-out runs as the diagnosis is told of them.
pub const HELD_OUT: &str = "9-11";
/// Usual time of a run, s: 1807 segments of 0.27 s over nine runs (Martinez et al. 2005, section
/// 5).
pub const RUN_TIME: f64 = 54.0;
/// Half the width of the square in which runs start, m.
const START_REACH: f64 = 1.5;

/// One run that is to be driven.
#[derive(Clone, Debug)]
pub(crate) struct Drive {
    /// Its number.
    pub(crate) id: i64,
    /// What the tracks are told.
    pub(crate) schedule: Schedule,
    /// Where it begins.
    pub(crate) start: Pose,
}

/// The runs of a case: nine of one style, and three of the other.
#[derive(Clone, Debug)]
pub(crate) struct Driving {
    /// Style of the training runs.
    pub(crate) style: ScheduleKind,
    /// Largest track speed, m/s.
    pub(crate) fastest: f64,
    /// All runs, in the order of their numbers.
    pub(crate) runs: Vec<Drive>,
}

impl Driving {
    /// Runs of this time (s) by a robot.
    pub(crate) fn draw(
        machine: &Machine,
        run_time: f64,
        random: &mut ChaCha8Rng,
    ) -> Result<Self, Failure> {
        let kinds = [ScheduleKind::Manual, ScheduleKind::Designed];
        let [style, other] = if random.random() { kinds } else { [kinds[1], kinds[0]] };
        // larger robots are faster, and the yaw rates of a spin stay alike
        let fastest = uniform(random, 0.5, 1.1) * (machine.vehicle.gauge / 0.42).sqrt();
        let fastest = Digits::Decimals(2).round(fastest);
        let count = TRAINING_RUNS + HELD_OUT_RUNS;
        let options = ScheduleOptions {
            runs: Some(count),
            seed: random.random(),
            fastest,
            duration: Some(run_time),
            ..ScheduleOptions::default()
        };
        let schedules = |kind: ScheduleKind| kind.generate(&options);
        let (training, held_out) = (schedules(style)?, schedules(other)?);
        let scheduled = training.into_iter().take(TRAINING_RUNS);
        let scheduled = scheduled.chain(held_out.into_iter().skip(TRAINING_RUNS));
        let runs = scheduled.map(|run| {
            let place = |random: &mut ChaCha8Rng| uniform(random, -START_REACH, START_REACH);
            let start = Pose::new(place(random), place(random), uniform(random, -PI, PI));
            Drive { id: run.id, schedule: run.schedule, start }
        });
        Ok(Self { style, fastest, runs: runs.collect() })
    }

    /// The runs to learn from.
    pub(crate) fn training(&self) -> &[Drive] {
        &self.runs[..TRAINING_RUNS]
    }
}
