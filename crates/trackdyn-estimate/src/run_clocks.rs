//! Runs whose poses are late by another time than those of the other runs: logs that were put
//! together, each with a clock of its own.
//!
//! # Law
//! A run has a clock of its own if its own offset leaves at most a quarter of the variance of its
//! turning, 1 − r², that the offset of all runs leaves.

use crate::clock::{self, clock_offset, left_at};
use rayon::prelude::*;
use trackdyn_recording::{Recording, Run};

/// Shortest run that is asked, s: a shorter one turns too seldom to tell.
const MIN_DURATION: f64 = 10.0;

/// Smallest difference of two clocks, s: steps of the readings are shorter.
const MIN_DIFFERENCE: f64 = 0.2;

/// Correlation of a run by its own offset that is clear.
const MIN_CORRELATION: f64 = 0.95;

/// Largest part that the own offset of a run may leave of what the offset of all runs leaves.
const MAX_LEFT: f64 = 0.25;

/// A run with a clock of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OtherClock {
    /// Number of the run.
    pub run: i64,
    /// Its clock offset, s.
    pub tau: f64,
    /// That of all runs together, s.
    pub of_all: f64,
}

impl OtherClock {
    /// The run whose clock offset differs most from that of all runs, s; none where none differs.
    pub fn of(recording: &Recording, of_all: f64, by: &clock::Settings) -> Option<Self> {
        if recording.runs().len() < 2 {
            return None;
        }
        let found =
            recording.runs().par_iter().filter_map(|run| Self::of_run(recording, run, of_all, by));
        let found: Vec<Self> = found.collect();
        found.into_iter().max_by(|a, b| a.difference().total_cmp(&b.difference()))
    }

    fn of_run(recording: &Recording, run: &Run, of_all: f64, by: &clock::Settings) -> Option<Self> {
        let [first, last] = [run.poses().first()?, run.poses().last()?];
        if last.t - first.t < MIN_DURATION {
            return None;
        }
        let alone = recording.with_runs(vec![run.clone()]);
        let own = clock_offset(&alone, by).ok()?;
        let found = Self { run: run.id(), tau: own.tau, of_all };
        let is_another = found.difference() > MIN_DIFFERENCE
            && own.correlation >= MIN_CORRELATION
            && 1.0 - own.correlation.powi(2) <= MAX_LEFT * left_at(&alone, of_all, by);
        is_another.then_some(found)
    }

    fn difference(&self) -> f64 {
        (self.tau - self.of_all).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clock::Clock;
    use crate::synthetic::{Synthetic, random_steps};

    /// Three runs of which the last one is late by another time, s.
    fn late(by: f64) -> Option<OtherClock> {
        let synthetic = Synthetic {
            schedules: (0..3).map(|run| random_steps(20, 2.0, 0.8, run)).collect(),
            encoder_noise: 0.005,
            yaw_noise: 0.003,
            ..Synthetic::default()
        };
        let recording = synthetic.recording().expect("long enough");
        let runs = recording.runs().iter().cloned().enumerate().map(|(k, run)| {
            let mut rows = run.into_rows();
            for pose in &mut rows.poses.samples {
                pose.t += if k == 2 { by } else { 0.0 };
            }
            Run::new(rows, &mut Vec::new())
        });
        let recording = recording.with_runs(runs.collect());
        let by = clock::Settings::default();
        let tau = Clock::of(&recording, None, &by).expect("it turns").tau();
        OtherClock::of(&recording, tau, &by)
    }

    #[test]
    fn a_run_with_a_clock_of_its_own_is_found() {
        for by in [0.5, 1.5, -0.7] {
            let found = late(by).expect("another clock");
            assert!(found.run == 2 && (found.tau - by).abs() < 0.05, "{found:?}");
        }
        assert_eq!(late(0.0), None);
        assert_eq!(late(0.05), None);
    }
}
