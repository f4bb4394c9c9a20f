//! A clock that runs at another rate than that of the logger, as in a simulation.
//!
//! # Law
//! What has no stamp was measured when it was logged: its time on that clock lies on the line
//! between the stamps of the messages that were logged before and after it.

use crate::rosbag::date::seconds;
use trackdyn_core::real;
use trackdyn_core::robust::{median, quantile};

/// Least change of stamp − logging by which a clock runs at another rate, s.
const MIN_CHANGE: f64 = 0.5;

/// Largest step of stamp − logging from a message to the next, in the whole change: what jumps has
/// no rate.
const MAX_STEP: f64 = 0.02;

/// Share of the messages that are logged and stamped after the one before: a driver that logs in
/// bursts shows no rate.
const MIN_RISING_SHARE: f64 = 0.9;

/// Logging and stamp of messages, ns, by their logging.
#[derive(Clone, Debug)]
pub(super) struct Rate(Vec<(i64, i64)>);

impl Rate {
    /// Of a clock, where it runs at another rate than logging. Pairs of logging and stamp are in
    /// the order of logging.
    pub(super) fn of(pairs: &[(i64, i64)]) -> Option<Self> {
        let mut ahead: Vec<f64> =
            pairs.iter().map(|(logged, stamp)| seconds(*logged, *stamp)).collect();
        let steps = ahead.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        let step = median(&mut steps.collect::<Vec<_>>())?;
        let change = quantile(&mut ahead, 0.95)? - quantile(&mut ahead, 0.05)?;
        let rises = |pair: &&[(i64, i64)]| pair[1].0 > pair[0].0 && pair[1].1 > pair[0].1;
        let rising = pairs.windows(2).filter(rises).count();
        let has_rate = change > MIN_CHANGE
            && step < MAX_STEP * change
            && real(rising) > MIN_RISING_SHARE * real(pairs.len());
        has_rate.then(|| Self(pairs.to_vec()))
    }

    /// The time that the clock shows at a logging; none before its first message and after its
    /// last.
    #[expect(clippy::cast_possible_truncation, reason = "a part of an interval between messages")]
    pub(super) fn at(&self, log_ns: i64) -> Option<i64> {
        let after = self.0.partition_point(|(logged, _)| *logged < log_ns);
        let (end, last) = *self.0.get(after)?;
        if end == log_ns {
            return Some(last);
        }
        let (start, first) = *self.0.get(after.checked_sub(1)?)?;
        let portion = seconds(start, log_ns) / seconds(start, end);
        Some(first + (1e9 * portion * seconds(first, last)).round() as i64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: i64 = 1_000_000;

    #[test]
    fn a_simulation_that_runs_slower_has_a_rate() {
        // A third of the time of the logger, which begins at 5 s.
        let pairs: Vec<(i64, i64)> =
            (0..600).map(|k| (5000 * MS + 60 * MS * k, 20 * MS * k)).collect();
        let rate = Rate::of(&pairs).expect("a rate");
        assert_eq!(rate.at(5000 * MS + 90 * MS), Some(30 * MS));
        assert_eq!(rate.at(4999 * MS), None);
    }

    #[test]
    fn a_clock_of_the_logger_and_bursts_have_none() {
        let jitter = |k: i64| (k * 7919 % 13) * MS;
        let even: Vec<(i64, i64)> =
            (0..600).map(|k| (20 * MS * k + jitter(k), 20 * MS * k)).collect();
        assert!(Rate::of(&even).is_none());
        let bursts: Vec<(i64, i64)> =
            (0..600).map(|k| (5000 * MS * (k / 250 + 1), 20 * MS * k)).collect();
        assert!(Rate::of(&bursts).is_none());
        assert!(Rate::of(&[]).is_none());
    }
}
