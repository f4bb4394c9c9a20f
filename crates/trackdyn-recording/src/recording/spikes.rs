//! Readings of the tracks that jump away from their neighbours and back: glitches of a driver, and
//! restarts or wraps of a counter, which show as one speed that no track has.
//!
//! # Law
//! d is the distance of a reading from the median of the five around it, which follows steps and
//! ramps of the speed. A reading is a spike where
//!
//! |d| > max(8 σ, 4 q, v/2, g Δt)
//!
//! with σ the robust spread of d over the run, q the size of d that 97 % of the readings keep
//! below, v the speed that 90 % keep below, and g Δt what the weight could change in the
//! median interval of the readings. At the ends of a run, where a spike has neighbours on one side
//! only, it takes four times as much. [Wide spikes](super::wide_spikes) are cut before.
//!
//! A spike of less than five readings is replaced by the line between the readings beside it. More
//! are dropped, which leaves a gap: nobody knows what the track did within.
//!
//! # Assumes
//! At most 3 % of the readings are spikes.
//!
//! # Sources
//! The filter is Hampel's: Pearson, IEEE Transactions on Control Systems Technology 10(1), 2002.

use super::finding::{Cleaning, Finding};
use super::wide_spikes::wide_spikes;
use crate::sample::{Stream, TrackSample};
use trackdyn_core::robust::{deviation_about_zero, quantile, usual_interval};
use trackdyn_core::{PerSide, Side};

/// Readings on either side of one whose median it is compared with.
const HALF_WINDOW: usize = 2;

/// Fewest readings from which the spread of a run is estimated.
const MIN_READINGS: usize = 20;

/// Distances from the median, in its robust standard deviations, that noise does not reach.
const MIN_DEVIATIONS: f64 = 8.0;

/// Share of the readings that are no spikes, whatever happens.
const GOOD_SHARE: f64 = 0.97;

/// Factor by which a spike stands out of the largest distance of that share.
const MIN_RATIO: f64 = 4.0;

/// Share of the readings at usual speeds.
const USUAL_SHARE: f64 = 0.9;

/// Distance of a spike in the largest usual speed: smaller ones do no harm.
const MIN_SPEED_SHARE: f64 = 0.5;

/// Acceleration that no track has, m/s².
pub(super) const MAX_ACCELERATION: f64 = 10.0;

/// Factor on the limit within [`HALF_WINDOW`] of the ends of a run.
const END_FACTOR: f64 = 4.0;

/// Fewest readings of a spike that leaves a gap.
const MIN_GAP_READINGS: usize = 5;

/// Replaces the spikes of either side; `usual` is the [largest usual
/// speed](super::wide_spikes::largest_usual_speed), m/s, and `cleanings` takes what was found.
/// Returns the rows that cannot be replaced, in order.
pub(super) fn mend(
    tracks: &mut [TrackSample],
    usual: f64,
    run: i64,
    cleanings: &mut Vec<Cleaning>,
) -> Vec<usize> {
    let mut dropped = Vec::new();
    if tracks.len() < MIN_READINGS {
        return dropped;
    }
    let times: Vec<f64> = tracks.iter().map(|sample| sample.t).collect();
    let possible = MAX_ACCELERATION * usual_interval(times.iter().copied());
    let (mut count, mut first, mut largest) = (0, f64::INFINITY, 0.0_f64);
    let mended = PerSide::from_fn(|side: Side| {
        let mut speeds: Vec<f64> = tracks.iter().map(|sample| sample.speeds()[side]).collect();
        let mut replace = |speeds: &mut [f64], spikes: &[usize]| {
            for &spike in spikes {
                largest = largest.max(speeds[spike].abs());
                first = first.min(times[spike]);
            }
            count += spikes.len();
            bridge(&times, speeds, spikes);
        };
        let wide = wide_spikes(&speeds, usual, Distances::of(&speeds, possible).least);
        let long = wide.iter().filter(|spike| spike.len() >= MIN_GAP_READINGS);
        dropped.extend(long.cloned().flatten());
        replace(&mut speeds, &wide.into_iter().flatten().collect::<Vec<usize>>());
        let narrow = Distances::of(&speeds, possible).spikes();
        replace(&mut speeds, &narrow);
        speeds
    });
    if count == 0 {
        return dropped;
    }
    for (k, sample) in tracks.iter_mut().enumerate() {
        (sample.v_left, sample.v_right) = (mended.left[k], mended.right[k]);
    }
    let finding = Finding::Spike { largest };
    cleanings.push(Cleaning { stream: Stream::Tracks, finding, count, runs: 1, run, t: first });
    dropped.sort_unstable();
    dropped.dedup();
    dropped
}

/// Distances of speeds from the medians of those around them, m/s.
struct Distances {
    of_readings: Vec<f64>,
    /// Least distance of a spike.
    least: f64,
}

impl Distances {
    /// `possible` is the largest change between two readings.
    fn of(speeds: &[f64], possible: f64) -> Self {
        let off = |k: usize| {
            let window =
                &speeds[k.saturating_sub(HALF_WINDOW)..speeds.len().min(k + HALF_WINDOW + 1)];
            let mut sorted = [0.0; 2 * HALF_WINDOW + 1];
            let sorted = &mut sorted[..window.len()];
            sorted.copy_from_slice(window);
            sorted.sort_by(f64::total_cmp);
            (speeds[k] - sorted[sorted.len() / 2]).abs()
        };
        let of_readings: Vec<f64> = (0..speeds.len()).map(off).collect();
        let mut sizes: Vec<f64> = speeds.iter().map(|speed| speed.abs()).collect();
        let mut sorted = of_readings.clone();
        let far = quantile(&mut sorted, GOOD_SHARE).unwrap_or(0.0);
        let spread = deviation_about_zero(&mut sorted).unwrap_or(0.0);
        let usual = quantile(&mut sizes, USUAL_SHARE).unwrap_or(0.0);
        let least = (MIN_DEVIATIONS * spread)
            .max(MIN_RATIO * far)
            .max(MIN_SPEED_SHARE * usual)
            .max(possible);
        Self { of_readings, least }
    }

    /// Places of the spikes.
    fn spikes(&self) -> Vec<usize> {
        let count = self.of_readings.len();
        let is_at_end = |k: usize| k < HALF_WINDOW || k + HALF_WINDOW >= count;
        let limit = |k: usize| if is_at_end(k) { END_FACTOR * self.least } else { self.least };
        (0..count).filter(|&k| self.of_readings[k] > limit(k)).collect()
    }
}

/// Replaces values at these places by the line between their good neighbours in time.
pub(super) fn bridge(times: &[f64], values: &mut [f64], places: &[usize]) {
    for group in places.chunk_by(|a, b| a + 1 == *b) {
        let (first, last) = (group[0], group[group.len() - 1]);
        let before = first.checked_sub(1);
        let after = (last + 1 < values.len()).then_some(last + 1);
        for &place in group {
            values[place] = match (before, after) {
                (Some(a), Some(b)) => {
                    let share = (times[place] - times[a]) / (times[b] - times[a]);
                    values[a] + share * (values[b] - values[a])
                }
                (Some(only), None) | (None, Some(only)) => values[only],
                (None, None) => values[place],
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest usual speed, m/s.
    const USUAL_SPEED: f64 = 0.9;

    /// A drive at 50 Hz that speeds up, turns, stops and reverses, with noise of 5 mm/s.
    fn drive() -> Vec<TrackSample> {
        (0_u32..3000)
            .map(|k| {
                let t = 0.02 * f64::from(k);
                let noise = |by: u32| 0.005 * (f64::from((k * by) % 17) / 8.0 - 1.0);
                let forward = match k / 250 % 3 {
                    0 => 0.6,
                    1 => 0.0,
                    _ => -0.4,
                };
                let turning = 0.3 * (0.4 * t).sin();
                let (v_left, v_right) = (forward - turning, forward + turning);
                TrackSample { t, v_left: v_left + noise(7), v_right: v_right + noise(11) }
            })
            .collect()
    }

    #[test]
    fn what_is_no_spike_stays_to_the_last_digit() {
        let (mut tracks, mut cleanings) = (drive(), Vec::new());
        mend(&mut tracks, USUAL_SPEED, 0, &mut cleanings);
        assert_eq!(tracks, drive());
        assert!(cleanings.is_empty());
        // commands that last for one reading are driving, where there are many of them
        let pulses = |k: usize| if k.is_multiple_of(10) { 0.5 } else { 0.0 };
        let pulsed: Vec<TrackSample> = drive()
            .iter()
            .enumerate()
            .map(|(k, sample)| TrackSample { v_left: pulses(k), ..*sample })
            .collect();
        let mut tracks = pulsed.clone();
        mend(&mut tracks, USUAL_SPEED, 0, &mut cleanings);
        assert_eq!(tracks, pulsed);
    }

    #[test]
    fn spikes_of_all_kinds_are_replaced_and_told() {
        let good = drive();
        // a glitch, two readings in a row, a sign flip, one at the beginning
        let bad =
            [(700, 1000.0), (1200, -30.0), (1201, 25.0), (2040, -good[2040].v_left), (1, 9.0)];
        let mut tracks = good.clone();
        for (place, value) in bad {
            tracks[place].v_left = value;
        }
        let mut cleanings = Vec::new();
        mend(&mut tracks, USUAL_SPEED, 3, &mut cleanings);
        for (found, good) in tracks.iter().zip(&good) {
            assert!((found.v_left - good.v_left).abs() < 0.02, "{found:?} {good:?}");
            assert_eq!(found.v_right, good.v_right);
        }
        let [cleaning] = cleanings[..] else { panic!("{cleanings:?}") };
        assert_eq!((cleaning.count, cleaning.run), (bad.len(), 3));
        assert_eq!(cleaning.finding, Finding::Spike { largest: 1000.0 });
        assert!((cleaning.t - 0.02).abs() < 1e-9);
    }
}
