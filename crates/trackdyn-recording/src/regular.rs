//! Stamps of samples that come at even intervals and are stamped late by chance.

use crate::recording::{Recording, Run, UncheckedRun};
use std::ops::Range;
use trackdyn_core::real;

/// Samples on either side that tell when a sample was due.
const NEIGHBOURS: usize = 5;

/// Fewer samples than this in a row have no interval.
const FEWEST: usize = 4;

/// The times at which samples were due, by a straight line through the stamps (s) of their neighbours; in the order of
/// the stamps, as many as they.
fn regular(stamps: &[f64]) -> Vec<f64> {
    let mut found = Vec::with_capacity(stamps.len());
    for (stretch, _) in stretches(stamps) {
        for k in stretch.clone() {
            let near = k.saturating_sub(NEIGHBOURS).max(stretch.start)
                ..(k + NEIGHBOURS + 1).min(stretch.end);
            found.push(if near.len() < FEWEST { stamps[k] } else { due(stamps, near, k) });
        }
    }
    found
}

/// Puts samples at the times at which they were due. `stamp` is where a sample keeps its time, s.
pub fn regularise<S>(samples: &mut [S], stamp: impl Fn(&mut S) -> &mut f64) {
    let stamps: Vec<f64> = samples.iter_mut().map(|sample| *stamp(sample)).collect();
    for (sample, due) in samples.iter_mut().zip(regular(&stamps)) {
        *stamp(sample) = due;
    }
}

/// The samples between gaps, by their indices, and the usual interval, s. Where the interval changes by half or more,
/// there is a gap, and nothing is known across it.
pub fn stretches(stamps: &[f64]) -> Vec<(Range<usize>, f64)> {
    let mut intervals: Vec<f64> = stamps.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let middle = intervals.len() / 2;
    let usual = if intervals.is_empty() {
        0.0
    } else {
        *intervals.select_nth_unstable_by(middle, f64::total_cmp).1
    };
    let mut start = 0;
    let even = |a: &f64, b: &f64| ((b - a) / usual - 1.0).abs() < 0.5;
    let stretch = |stretch: &[f64]| {
        start += stretch.len();
        (start - stretch.len()..start, usual)
    };
    stamps.chunk_by(even).map(stretch).collect()
}

/// The stamp of a sample on the line through those near it.
fn due(stamps: &[f64], near: Range<usize>, at: usize) -> f64 {
    let count = real(near.len());
    let place = |k: usize| real(k) - real(at);
    let (x, t) = near.clone().fold((0.0, 0.0), |(x, t), k| (x + place(k), t + stamps[k]));
    let (x, t) = (x / count, t / count);
    let (xx, xt) = near.fold((0.0, 0.0), |(xx, xt), k| {
        let off = place(k) - x;
        (xx + off * off, xt + off * (stamps[k] - t))
    });
    // t̄ + (0 − x̄) slope
    t - x * xt / xx
}

impl Recording {
    /// The same recording with poses at the times at which they were due. Its fingerprint is that of the recording.
    pub fn with_regular_poses(&self) -> Self {
        let regular = |run: &Run| {
            let mut rows: UncheckedRun = run.clone().into_rows();
            regularise(&mut rows.poses.samples, |pose| &mut pose.t);
            Run::new(rows, &mut Vec::new())
        };
        self.with_runs(self.runs().iter().map(regular).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_stamps_stay_and_late_ones_come_nearer() {
        let even = |k: i32| 3.0 + 0.05 * f64::from(k);
        let stamps: Vec<f64> = (0..40).map(even).collect();
        for (a, b) in stamps.iter().zip(regular(&stamps)) {
            assert!((a - b).abs() < 1e-12);
        }
        // Late by turns, by up to 8 ms.
        let late = |k: i32| 0.002 * f64::from((7 * k) % 5);
        let stamps: Vec<f64> = (0..40).map(|k| even(k) + late(k)).collect();
        let square = |stamps: &[f64]| -> f64 {
            (0..).zip(stamps).map(|(k, t)| (t - even(k) - 0.004).powi(2)).sum()
        };
        let after = regular(&stamps);
        assert!(square(&after) < square(&stamps) / 5.0, "{} {}", square(&after), square(&stamps));
    }

    #[test]
    fn nothing_is_known_across_a_gap() {
        let gap = |k: i32| f64::from(k) * 0.05 + if k < 10 { 0.0 } else { 1.03 };
        let stamps: Vec<f64> = (0..20).map(gap).collect();
        for (a, b) in stamps.iter().zip(regular(&stamps)) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
        assert!(regular(&[]).is_empty());
    }
}
