//! How schedules are generated.

use crate::Error;
use trackdyn_core::real;
use trackdyn_model::Grid;

/// Largest number of commands of all runs together: 50 MB, and 17 h of one command in 0.03 s.
pub(super) const MAX_COMMANDS: usize = 2_000_000;

/// Smallest speed, m/s: at less, 20 m take hours.
const MIN_SPEED: f64 = 0.01;

/// Longest time to the largest speed, s.
const MAX_START: f64 = 60.0;

/// Largest number of runs.
const MAX_RUNS: usize = 10_000;

/// How schedules are generated.
#[derive(Clone, Debug, PartialEq)]
pub struct ScheduleOptions {
    /// Number of runs; where absent, what is usual for the kind.
    pub runs: Option<usize>,
    /// Seed of the driver's hand and of orders.
    pub seed: u64,
    /// Largest track speed, m/s.
    pub fastest: f64,
    /// Time of each run, s, with a second at rest before and after a drive by hand; where absent,
    /// until the path or the plan is driven.
    pub duration: Option<f64>,
    /// Time between commands, s.
    pub interval: f64,
    /// Largest change of a track's speed, m/s²; infinite for steps.
    pub acceleration: f64,
    /// Side of a square, m.
    pub side: f64,
    /// Distance between the ICRs, x_r − x_l, by which turns of squares are measured, m.
    pub icr_distance: f64,
}

impl Default for ScheduleOptions {
    /// The paper's: commands every 30 ms, up to 1 m/s, and the printed ICRs of Auriga-alpha.
    fn default() -> Self {
        Self {
            runs: None,
            seed: 1,
            fastest: 1.0,
            duration: None,
            interval: 0.03,
            acceleration: 1.0,
            side: 3.0,
            icr_distance: 0.832,
        }
    }
}

impl ScheduleOptions {
    /// Checks the values.
    ///
    /// # Errors
    /// [`Error::Option`].
    pub fn check(&self) -> Result<(), Error> {
        let fail = |name, value: f64, expected: String| Err(Error::option(name, &value, expected));
        if let Some(runs) = self.runs.filter(|runs| !(1..=MAX_RUNS).contains(runs)) {
            return Err(Error::option("runs", &runs, format!("1 to {MAX_RUNS}")));
        }
        if !(self.fastest >= MIN_SPEED && self.fastest <= Grid::MAX_SPEED) {
            let expected = format!("{MIN_SPEED} to {} m/s", Grid::MAX_SPEED);
            return fail("fastest", self.fastest, expected);
        }
        if !(self.interval >= 1e-3 && self.interval <= 1.0) {
            return fail("interval", self.interval, "0.001 to 1 s between commands".to_owned());
        }
        let longest = real(MAX_COMMANDS) * self.interval;
        let in_range = |time: &f64| *time >= self.interval && *time <= longest;
        if let Some(time) = self.duration.filter(|time| !in_range(time)) {
            return fail("duration", time, format!("{} to {longest} s", self.interval));
        }
        let least = self.fastest / MAX_START;
        if self.acceleration.is_nan() || self.acceleration < least {
            return fail("acceleration", self.acceleration, format!("at least {least} m/s²"));
        }
        Ok(())
    }

    /// Checks what squares are made of.
    ///
    /// # Errors
    /// [`Error::Option`].
    pub fn check_square(&self) -> Result<(), Error> {
        let fail = |name, value: f64, expected: String| Err(Error::option(name, &value, expected));
        for (name, value, most) in
            [("side", self.side, 1e4), ("icr_distance", self.icr_distance, 100.0)]
        {
            if !(value > 0.0 && value <= most) {
                return fail(name, value, format!("a positive length in m, at most {most}"));
            }
        }
        let longest = real(MAX_COMMANDS) * self.interval;
        if 4.0 * self.side / self.fastest > longest {
            return fail("side", self.side, format!("a square driven within {longest} s"));
        }
        Ok(())
    }
}
