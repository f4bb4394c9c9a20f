//! Encoder speeds that a slower source holds between its updates.
//!
//! A driver that reports at 4 Hz, logged at 20 Hz, repeats each value four times: the recorded
//! speed is a staircase, and the speed of the belt is not. A fitted drive lag would smooth the
//! staircase. Where values change at even times several readings apart, a line leads from one to
//! the next. A value that stays for longer was confirmed at each update: the line begins one
//! interval before the change.

use super::with_speeds;
use crate::settings;
use trackdyn_core::robust::{median, usual_interval};
use trackdyn_core::{PerSide, Side};
use trackdyn_recording::TrackSample;

/// Readings of all runs with lines between the updates of each track whose values are held.
pub(super) fn joined(
    runs: &[Vec<TrackSample>],
    settings: &settings::Evidence,
) -> Vec<Vec<TrackSample>> {
    let intervals = PerSide::from_fn(|side| update_interval(runs, side, settings));
    let joined = |run: &Vec<TrackSample>| {
        let of = |side: Side| match intervals[side] {
            Some(interval) => joined_run(run, side, interval),
            None => run.iter().map(|reading| reading.speeds()[side]).collect(),
        };
        with_speeds(run, &PerSide::from_fn(of))
    };
    runs.iter().map(joined).collect()
}

/// Places where the value of a track changes.
fn changes(run: &[TrackSample], side: Side) -> Vec<usize> {
    let differs = |&k: &usize| run[k].speeds()[side] != run[k - 1].speeds()[side];
    (1..run.len()).filter(differs).collect()
}

/// Interval at which the source of a track's values reports, s; none where it reports as often as
/// it is read, or at no even times.
fn update_interval(
    runs: &[Vec<TrackSample>],
    side: Side,
    settings: &settings::Evidence,
) -> Option<f64> {
    let usual = |run: &Vec<TrackSample>| usual_interval(run.iter().map(|reading| reading.t));
    let reading = median(&mut runs.iter().map(usual).filter(|of| *of > 0.0).collect::<Vec<_>>())?;
    let gaps = |run: &Vec<TrackSample>| -> Vec<f64> {
        let changes = changes(run, side);
        changes.windows(2).map(|pair| run[pair[1]].t - run[pair[0]].t).collect()
    };
    let mut gaps: Vec<f64> = runs.iter().flat_map(gaps).collect();
    let interval = median(&mut gaps)?;
    // Intervals are whole numbers of readings, to half of one.
    let early = gaps.iter().filter(|gap| **gap < interval - 0.5 * reading).count();
    let is_even = early <= gaps.len() / settings.held_changes_per_early_one;
    let is_held = interval > 1.5 * reading && interval <= settings.max_held;
    (is_held && is_even).then_some(interval)
}

/// Speeds of a track with a line before each change, over an update interval, s, at most.
fn joined_run(run: &[TrackSample], side: Side, interval: f64) -> Vec<f64> {
    let value = |k: usize| run[k].speeds()[side];
    let mut speeds: Vec<f64> = (0..run.len()).map(value).collect();
    let mut before = 0;
    for change in changes(run, side) {
        let [from, until] = [value(change - 1), value(change)];
        for k in before..change {
            // v = v₀ + (v₁ − v₀)(t − (t₁ − T))/T
            let share = 1.0 - (run[change].t - run[k].t) / interval;
            speeds[k] = from + (until - from) * share.max(0.0);
        }
        before = change;
    }
    speeds
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Readings at 20 Hz of a left track that rises and then stays, reported every `held` readings;
    /// the right one is read as often as it reports.
    fn run(held: u32) -> Vec<TrackSample> {
        let speed = |t: f64| (0.8 * t).min(2.0);
        let reading = |k: u32| TrackSample {
            t: 0.05 * f64::from(k),
            v_left: speed(0.05 * f64::from(k / held * held)),
            v_right: 0.1 * f64::from(k),
        };
        (0..100).map(reading).collect()
    }

    #[test]
    fn a_staircase_becomes_the_ramp_that_it_samples() {
        let settings = settings::Evidence::default();
        let held = vec![run(5)];
        let joined = joined(&held, &settings);
        for (reading, exact) in joined[0].iter().zip(&run(1)) {
            assert!((reading.v_left - exact.v_left).abs() < 1e-9, "{reading:?} {exact:?}");
            assert_eq!(reading.v_right, exact.v_right);
        }
    }

    #[test]
    fn what_is_not_held_at_even_times_stays() {
        let settings = settings::Evidence::default();
        // every reading its own value; commands that change seldom, at any time
        let own = vec![run(1)];
        assert_eq!(joined(&own, &settings), own);
        let mut steps = run(1);
        for (k, reading) in steps.iter_mut().enumerate() {
            let passed = [3, 5, 14, 16, 17, 40, 41, 55, 80].iter().filter(|at| **at < k).count();
            reading.v_left = trackdyn_core::real(passed);
        }
        assert_eq!(joined(&[steps.clone()], &settings)[0], steps);
    }
}
