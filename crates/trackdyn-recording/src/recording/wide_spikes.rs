//! Spikes of the track speeds that are three or more readings wide.
//!
//! # Law
//! A stretch of three or more readings is a spike where each of them is faster than three times the
//! speed that 97 % of the moving readings keep below, and where the speed steps to it and back by
//! more than a track can change in one reading. A fast stretch of a drive has ramps.
//!
//! Steps that lead up to the stretch belong to it: a driver that takes means over some readings
//! spreads a spike. At the ends of a run, where there is nothing to step from, one step is enough.
//!
//! # Assumes
//! At most 3 % of the moving readings are spikes.

use std::ops::Range;
use trackdyn_core::robust::quantile;

/// Fewest readings of a wide spike.
const MIN_WIDTH: usize = 3;

/// Least speed of a reading of a track that moves, m/s.
const MIN_MOVING_SPEED: f64 = 0.02;

/// Share of the moving readings that are no spikes, whatever happens.
const GOOD_SHARE: f64 = 0.97;

/// Speed of a spike in the largest speed of this share.
const MIN_SPEED_RATIO: f64 = 3.0;

/// The speed that usual readings keep below, by the speeds of both sides in all runs, m/s; infinite
/// where nothing moves.
pub(super) fn largest_usual_speed(speeds: impl Iterator<Item = f64>) -> f64 {
    let mut moving: Vec<f64> =
        speeds.map(f64::abs).filter(|size| *size > MIN_MOVING_SPEED).collect();
    quantile(&mut moving, GOOD_SHARE).unwrap_or(f64::INFINITY)
}

/// Places of the wide spikes among speeds, m/s; `least` is the least step of a spike.
pub(super) fn wide_spikes(speeds: &[f64], usual: f64, least: f64) -> Vec<Range<usize>> {
    let is_fast = |k: usize| speeds[k].abs() > MIN_SPEED_RATIO * usual;
    // Whether the speed steps from the reading before to this one.
    let steps = |k: usize| (speeds[k] - speeds[k - 1]).abs() > least;
    let mut spikes = Vec::new();
    let mut start = 0;
    while start < speeds.len() {
        let end = (start..speeds.len()).find(|&k| !is_fast(k)).unwrap_or(speeds.len());
        let width = end - start;
        let (has_start, has_end) = (start > 0, end < speeds.len());
        let is_spike = width >= MIN_WIDTH
            && (has_start || has_end)
            && (!has_start || steps(start))
            && (!has_end || steps(end));
        if is_spike {
            let first = (0..width).take_while(|by| start >= by + 2 && steps(start - by - 1));
            let last =
                (0..width).take_while(|by| end + by + 1 < speeds.len() && steps(end + by + 1));
            spikes.push(start - first.count()..end + last.count());
        }
        start = end + 1;
    }
    spikes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Speeds at 50 Hz: half a metre per second with ramps, and noise.
    fn drive() -> Vec<f64> {
        let speed = |k: u32| {
            let wave = 0.5 * (0.01 * f64::from(k)).sin();
            wave + 0.005 * (f64::from((k * 7) % 17) / 8.0 - 1.0)
        };
        (0..2000).map(speed).collect()
    }

    fn found(speeds: &[f64]) -> Vec<Range<usize>> {
        wide_spikes(speeds, largest_usual_speed(speeds.iter().copied()), 0.25)
    }

    #[test]
    fn levels_that_no_track_has_are_spikes_at_any_width() {
        for (place, width) in [(700, 3), (700, 10), (1200, 25), (0, 3), (1990, 10)] {
            for level in [3.0, -10.0, 1000.0] {
                let mut speeds = drive();
                speeds[place..place + width].fill(level);
                assert_eq!(found(&speeds), vec![place..place + width], "{level}");
            }
        }
    }

    #[test]
    fn a_spike_that_means_have_spread_is_cut_whole() {
        let mut speeds = drive();
        speeds[700..710].fill(30.0);
        let means: Vec<f64> =
            (0..1990).map(|k| speeds[k..k + 5].iter().sum::<f64>() / 5.0).collect();
        assert_eq!(found(&means), vec![696..710]);
    }

    #[test]
    fn a_fast_stretch_with_ramps_stays() {
        let mut speeds = drive();
        // Up to 3 m/s by 5 m/s², half a second there, and back.
        for k in 0..85_u8 {
            let ramp = 0.1 * f64::from(k.min(85 - k).min(30));
            speeds[700 + usize::from(k)] += ramp;
        }
        assert!(found(&speeds).is_empty());
        assert!(found(&drive()).is_empty());
    }
}
