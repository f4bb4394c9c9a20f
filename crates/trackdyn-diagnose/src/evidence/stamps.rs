//! Stamps of readings that come at even intervals and are stamped late by chance.

use std::ops::Range;
use trackdyn_core::real;
use trackdyn_recording::TrackSample;

/// Readings on either side that tell when a reading was due.
const NEIGHBOURS: usize = 5;

/// Fewer readings than this in a row have no interval.
const FEWEST: usize = 4;

/// The readings at the times at which they were due, by a straight line through the stamps of their neighbours.
/// Where the interval changes by half or more, there is a gap, and nothing is known across it.
pub(super) fn regular(run: &[TrackSample]) -> Vec<TrackSample> {
    let mut intervals: Vec<f64> = run.windows(2).map(|pair| pair[1].t - pair[0].t).collect();
    if intervals.is_empty() {
        return run.to_vec();
    }
    let middle = intervals.len() / 2;
    let (_, &mut usual, _) = intervals.select_nth_unstable_by(middle, f64::total_cmp);
    let even = |a: &TrackSample, b: &TrackSample| ((b.t - a.t) / usual - 1.0).abs() < 0.5;
    let mut found = Vec::with_capacity(run.len());
    for stretch in run.chunk_by(even) {
        for k in 0..stretch.len() {
            let near = k.saturating_sub(NEIGHBOURS)..(k + NEIGHBOURS + 1).min(stretch.len());
            let t = if near.len() < FEWEST { stretch[k].t } else { due(stretch, near, k) };
            found.push(TrackSample { t, ..stretch[k] });
        }
    }
    found
}

/// The stamp of a reading on the line through those near it.
fn due(stretch: &[TrackSample], near: Range<usize>, at: usize) -> f64 {
    let count = real(near.len());
    let place = |k: usize| real(k) - real(at);
    let (x, t) = near.clone().fold((0.0, 0.0), |(x, t), k| (x + place(k), t + stretch[k].t));
    let (x, t) = (x / count, t / count);
    let (xx, xt) = near.fold((0.0, 0.0), |(xx, xt), k| {
        let off = place(k) - x;
        (xx + off * off, xt + off * (stretch[k].t - t))
    });
    // t̄ + (0 − x̄) slope
    t - x * xt / xx
}

#[cfg(test)]
mod tests {
    use super::*;

    fn readings(stamps: impl Iterator<Item = f64>) -> Vec<TrackSample> {
        stamps.map(|t| TrackSample { t, v_left: t, v_right: -t }).collect()
    }

    #[test]
    fn even_stamps_stay_and_late_ones_come_nearer() {
        let even = |k: i32| 3.0 + 0.05 * f64::from(k);
        let run = readings((0..40).map(even));
        for (a, b) in run.iter().zip(regular(&run)) {
            assert!((a.t - b.t).abs() < 1e-12);
        }
        // Late by turns, by up to 8 ms.
        let late = |k: i32| 0.002 * f64::from((7 * k) % 5);
        let run = readings((0..40).map(|k| even(k) + late(k)));
        let square = |run: &[TrackSample]| -> f64 {
            (0..).zip(run).map(|(k, reading)| (reading.t - even(k) - 0.004).powi(2)).sum()
        };
        let after = regular(&run);
        assert!(square(&after) < square(&run) / 5.0, "{} {}", square(&after), square(&run));
        assert!(
            run.iter().zip(&after).all(|(a, b)| a.v_left == b.v_left && a.v_right == b.v_right)
        );
    }

    #[test]
    fn nothing_is_known_across_a_gap() {
        let run = readings((0..20).map(|k| f64::from(k) * 0.05 + if k < 10 { 0.0 } else { 1.03 }));
        for (a, b) in run.iter().zip(regular(&run)) {
            assert!((a.t - b.t).abs() < 1e-12, "{} {}", a.t, b.t);
        }
        assert!(regular(&[]).is_empty());
    }
}
