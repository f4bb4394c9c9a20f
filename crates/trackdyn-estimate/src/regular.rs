//! Stamps of samples that come at even intervals and are stamped late by chance.
//!
//! # Law
//! A sample was due where a straight line through the stamps of its neighbours passes. More
//! neighbours average more of the random lateness, but follow a wandering clock less well. The
//! number of neighbours is the one that predicts each stamp best from the others: Σ (r/(1 − h))² is
//! least. Here r is the residual of a stamp and h its leverage on its own line, so that r/(1 − h)
//! is the residual from the line without it.
//!
//! # Sources
//! Stone, Journal of the Royal Statistical Society B 36(2), 1974 (leaving one out); Cleveland,
//! Journal of the American Statistical Association 74(368), 1979 (lines through neighbours).

use std::ops::Range;
use trackdyn_core::{real, settings_group};
use trackdyn_recording::{Recording, Run, UncheckedRun};

settings_group! {
    /// How the times at which samples were due are found from stamps that jitter.
    Settings {
        /// Fewest neighbours on each side that tell a time, then twice as many.
        min_neighbours: usize = 5, "", [1.0, 1e6],
            "Fewer share their jitter.",
            "Lower: jitter stays; higher: a wandering clock is not followed.";
        /// Fewest samples in a row with an interval.
        min_samples: usize = 4, "", [3.0, 1e6],
            "A line leaves two to judge it.",
            "Higher: short rows keep their jitter.";
        /// Change of the interval, over the usual one, that is a gap.
        min_gap: f64 = 0.5, "", [0.01, 10.0],
            "A missing sample changes it by one.",
            "Lower: jitter cuts rows; higher: gaps are bridged.";
    }
}

/// The times at which samples were due, by a straight line through the stamps (s) of their
/// neighbours; in the order of the stamps, as many as they.
fn regular(stamps: &[f64], settings: &Settings) -> Vec<f64> {
    let stretches = stretches(stamps, settings).into_iter();
    let rows: Vec<Row> =
        stretches.map(|(at, _)| Row::new(&stamps[at], settings.min_samples)).collect();
    let longest = rows.iter().map(|row| row.off.len()).max().unwrap_or_default();
    let fewest = settings.min_neighbours;
    let doubled = std::iter::successors(Some(fewest), |neighbours| Some(2 * neighbours));
    // twice as many as there are on one side are all that there are on both
    let tried = doubled.take_while(|neighbours| *neighbours < 2 * longest.max(fewest));
    let missed = |neighbours: usize| rows.iter().map(|row| row.missed(neighbours)).sum::<f64>();
    let best = tried.map(|neighbours| (missed(neighbours), neighbours));
    let best = best.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(fewest, |best| best.1);
    rows.iter().flat_map(|row| row.due(best)).collect()
}

/// Puts samples at the times at which they were due. `stamp` is where a sample keeps its time, s.
pub fn regularise<S>(samples: &mut [S], stamp: impl Fn(&mut S) -> &mut f64, settings: &Settings) {
    let stamps: Vec<f64> = samples.iter_mut().map(|sample| *stamp(sample)).collect();
    for (sample, due) in samples.iter_mut().zip(regular(&stamps, settings)) {
        *stamp(sample) = due;
    }
}

/// The samples between gaps, by their indices, and the usual interval, s: nothing is known across a
/// gap.
pub fn stretches(stamps: &[f64], settings: &Settings) -> Vec<(Range<usize>, f64)> {
    let mut intervals: Vec<f64> = stamps.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let middle = intervals.len() / 2;
    let usual = if intervals.is_empty() {
        0.0
    } else {
        *intervals.select_nth_unstable_by(middle, f64::total_cmp).1
    };
    let mut start = 0;
    let even = |a: &f64, b: &f64| ((b - a) / usual - 1.0).abs() < settings.min_gap;
    let stretch = |stretch: &[f64]| {
        start += stretch.len();
        (start - stretch.len()..start, usual)
    };
    stamps.chunk_by(even).map(stretch).collect()
}

/// Stamps in a row, as deviations from evenly spaced ones between the first and the last.
struct Row {
    /// Fewest samples of a line.
    min_samples: usize,
    first: f64,
    interval: f64,
    off: Vec<f64>,
    /// Cumulative sums of the deviations, and of each deviation times its place; the first is
    /// empty.
    sums: Vec<[f64; 2]>,
}

/// The line through some stamps, at one of them.
struct Line {
    /// Deviation from the evenly spaced stamp there, s.
    off: f64,
    /// h: leverage of that stamp on the line.
    own: f64,
}

impl Row {
    fn new(stamps: &[f64], min_samples: usize) -> Self {
        let (first, last) = (stamps[0], stamps[stamps.len() - 1]);
        let interval = (last - first) / real(stamps.len().max(2) - 1);
        let even = |k: usize| first + interval * real(k);
        let off: Vec<f64> = stamps.iter().enumerate().map(|(k, t)| t - even(k)).collect();
        let mut sums = vec![[0.0; 2]];
        for (k, off) in off.iter().enumerate() {
            let [sum, moment] = sums[k];
            sums.push([sum + off, moment + off * real(k)]);
        }
        Self { min_samples, first, interval, off, sums }
    }

    /// The line through a sample and so many neighbours on either side, at that sample; none where
    /// they have no interval.
    fn line(&self, at: usize, neighbours: usize) -> Option<Line> {
        let near = at.saturating_sub(neighbours)..(at + neighbours + 1).min(self.off.len());
        if near.len() < self.min_samples {
            return None;
        }
        let count = real(near.len());
        let [sum, moment] = [0, 1].map(|k| self.sums[near.end][k] - self.sums[near.start][k]);
        let middle = (real(near.start) + real(near.end) - 1.0) / 2.0;
        // Σ (k − k̄)² of n places in a row
        let spread = count * (count * count - 1.0) / 12.0;
        let slope = (moment - middle * sum) / spread;
        let from_middle = real(at) - middle;
        let off = sum / count + slope * from_middle;
        Some(Line { off, own: 1.0 / count + from_middle * from_middle / spread })
    }

    /// Sum of the squared residuals of each stamp from the line through the others, s².
    fn missed(&self, neighbours: usize) -> f64 {
        let by = |at: usize| {
            let line = self.line(at, neighbours)?;
            Some(((self.off[at] - line.off) / (1.0 - line.own)).powi(2))
        };
        (0..self.off.len()).filter_map(by).sum()
    }

    /// The times at which the samples were due, s.
    fn due(&self, neighbours: usize) -> impl Iterator<Item = f64> {
        (0..self.off.len()).map(move |at| {
            let off = self.line(at, neighbours).map_or(self.off[at], |line| line.off);
            self.first + self.interval * real(at) + off
        })
    }
}

/// A recording with its poses at the times at which they were due. The fingerprint stays.
pub fn with_regular_poses(recording: &Recording, settings: &Settings) -> Recording {
    let regular = |run: &Run| {
        let mut rows: UncheckedRun = run.clone().into_rows();
        regularise(&mut rows.poses.samples, |pose| &mut pose.t, settings);
        Run::new(rows, &mut Vec::new())
    };
    recording.with_runs(recording.runs().iter().map(regular).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Root mean square difference between stamps and the times at which samples were due, s.
    fn off(stamps: &[f64], due: &[f64]) -> f64 {
        let squares = stamps.iter().zip(due).map(|(stamp, due)| (stamp - due).powi(2));
        (squares.sum::<f64>() / real(due.len())).sqrt()
    }

    fn by_default(stamps: &[f64]) -> Vec<f64> {
        regular(stamps, &Settings::default())
    }

    /// Numbers from −1 to 1 without any order.
    fn scattered(count: usize) -> impl Iterator<Item = f64> {
        let numbers = (0..count).scan(1_u32, |state, _| {
            *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            Some(*state)
        });
        numbers.map(|number| f64::from(number) / f64::from(u32::MAX / 2) - 1.0)
    }

    /// Root mean square errors of 500 stamps of a clock, each up to 10 ms early or late: as they
    /// are, and made regular.
    fn off_by(clock: impl Fn(f64) -> f64) -> [f64; 2] {
        let due: Vec<f64> = (0..500).map(|k| clock(f64::from(k))).collect();
        let stamps: Vec<f64> =
            due.iter().zip(scattered(500)).map(|(due, by)| due + 0.01 * by).collect();
        [off(&stamps, &due), off(&by_default(&stamps), &due)]
    }

    #[test]
    fn even_stamps_stay_and_late_ones_come_nearer() {
        let even = |k: i32| 3.0 + 0.05 * f64::from(k);
        let stamps: Vec<f64> = (0..40).map(even).collect();
        for (a, b) in stamps.iter().zip(by_default(&stamps)) {
            assert!((a - b).abs() < 1e-12);
        }
        // Late by turns, by up to 8 ms.
        let late = |k: i32| 0.002 * f64::from((7 * k) % 5);
        let stamps: Vec<f64> = (0..40).map(|k| even(k) + late(k)).collect();
        let square = |stamps: &[f64]| -> f64 {
            (0..).zip(stamps).map(|(k, t)| (t - even(k) - 0.004).powi(2)).sum()
        };
        let after = by_default(&stamps);
        assert!(square(&after) < square(&stamps) / 5.0, "{} {}", square(&after), square(&stamps));
    }

    /// Seconds since 1970 have a quarter of a microsecond in their last digit.
    #[test]
    fn stamps_of_the_epoch_stay() {
        let stamps: Vec<f64> = (0..40).map(|k| 1.7e9 + 0.05 * f64::from(k)).collect();
        for (a, b) in stamps.iter().zip(by_default(&stamps)) {
            assert!((a - b).abs() < 1e-6);
        }
    }

    /// A line through n samples that come late by chance is off by √(2/n) of that: it has two
    /// numbers.
    #[test]
    fn a_clock_that_ticks_evenly_is_known_by_all_of_its_samples() {
        let [before, after] = off_by(|k| 3.0 + 0.1 * k);
        // three standard errors; five on either side leave 0.3
        assert!(after < 3.0 * (2.0_f64 / 500.0).sqrt() * before, "{before} {after}");
    }

    /// A clock that runs now fast, now slow, by more than its stamps are late: only near samples
    /// tell the time.
    #[test]
    fn a_clock_that_wanders_is_followed() {
        let [before, after] = off_by(|k| 3.0 + 0.1 * k + 0.2 * (k / 20.0).sin());
        assert!(after < before / 1.5, "{before} {after}");
    }

    #[test]
    fn nothing_is_known_across_a_gap() {
        let gap = |k: i32| f64::from(k) * 0.05 + if k < 10 { 0.0 } else { 1.03 };
        let stamps: Vec<f64> = (0..20).map(gap).collect();
        for (a, b) in stamps.iter().zip(by_default(&stamps)) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
        assert!(by_default(&[]).is_empty());
    }
}
