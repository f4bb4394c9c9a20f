//! Commands at equal intervals that no belt has to jump after.

use super::ScheduleOptions;
use trackdyn_core::{Command, PerSide, Schedule, real};

/// A schedule that is being written, one command per interval.
pub(super) struct Ramp {
    interval: f64,
    acceleration: f64,
    /// Speeds of the intervals so far, m/s.
    speeds: Vec<PerSide<f64>>,
}

impl Ramp {
    pub(super) fn new(options: &ScheduleOptions) -> Self {
        Self { interval: options.interval, acceleration: options.acceleration, speeds: Vec::new() }
    }

    /// Time so far, s.
    pub(super) fn time(&self) -> f64 {
        real(self.speeds.len()) * self.interval
    }

    /// Speeds of the last interval; zero at the start.
    pub(super) fn now(&self) -> PerSide<f64> {
        self.speeds.last().copied().unwrap_or_default()
    }

    /// One interval towards these speeds. Both sides change in proportion: from rest, the ratio of
    /// the speeds and with it the turn are those of the target from the first command on.
    pub(super) fn towards(&mut self, target: PerSide<f64>) {
        let now = self.now();
        let change = PerSide::new(target.left - now.left, target.right - now.right);
        let largest = change.left.abs().max(change.right.abs());
        let allowed = self.acceleration * self.interval;
        let next = if largest <= allowed {
            target
        } else {
            let share = allowed / largest;
            PerSide::new(now.left + share * change.left, now.right + share * change.right)
        };
        self.speeds.push(next);
    }

    /// Goes to these speeds and then holds them for a time, s.
    pub(super) fn hold(&mut self, target: PerSide<f64>, duration: f64) {
        while self.now() != target {
            self.towards(target);
        }
        let end = self.time() + duration;
        while self.time() < end - self.interval / 2.0 {
            self.towards(target);
        }
    }

    /// From rest to rest so that the tracks run exactly these distances, m, the longer of them at
    /// most at `fastest` (m/s).
    pub(super) fn travel(&mut self, distance: PerSide<f64>, fastest: f64) {
        let longest = distance.left.abs().max(distance.right.abs());
        if longest == 0.0 {
            return;
        }
        // up, along and down: v ≤ √(a s) where the peak is not reached
        let peak = fastest.min((self.acceleration * longest).sqrt());
        let rise = peak / self.acceleration;
        let duration = longest / peak + rise;
        let count = intervals(duration, self.interval);
        let middle = |k: usize| (real(k) + 0.5) / real(count) * duration;
        let height = |t: f64| {
            if rise == 0.0 { 1.0 } else { (t.min(duration - t) / rise).min(1.0) }
        };
        let shape: Vec<f64> = (0..count).map(|k| height(middle(k))).collect();
        let sum: f64 = shape.iter().sum::<f64>() * self.interval;
        self.speeds.extend(shape.iter().map(|height| distance.map(|length| height * length / sum)));
    }

    /// The schedule, from rest at t = 0 to a last command that ends it.
    pub(super) fn finish(mut self) -> Schedule {
        if self.speeds.is_empty() {
            self.speeds.push(PerSide::default());
        }
        let last = self.now();
        let commands = self.speeds.iter().chain([&last]).enumerate();
        let commands =
            commands.map(|(k, &speeds)| Command { t: real(k) * self.interval, speeds }).collect();
        match Schedule::new(commands) {
            Ok(schedule) => schedule,
            Err(error) => unreachable!("times increase, speeds are finite: {error}"),
        }
    }
}

/// Whole intervals that cover a time.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "options limit the number of commands"
)]
fn intervals(duration: f64, interval: f64) -> usize {
    (duration / interval).ceil().max(1.0) as usize
}
