//! Smoothing of encoder readings that count coarse ticks.
//!
//! Travel is known to a tick q, with an error variance of q²/12. Its differences are speeds that
//! jump by q/T though the belt runs evenly; a fitted drive lag would smooth them. Whittaker
//! smoothing (1923) keeps changes of acceleration small: travel S minimises Σ (S_k − S̃_k)² + λ Σ
//! (Δ³S_k)². It delays nothing and leaves constant acceleration unchanged. As the variance is
//! known, λ minimises the expected error (Mallows' C_p).

use super::with_speeds;
use crate::settings::{self, Settings};
use std::f64::consts::PI;
use trackdyn_core::{PerSide, Side, real};
use trackdyn_estimate::regular::stretches;
use trackdyn_recording::TrackSample;

/// Order of the penalised differences.
const ORDER: usize = 3;

/// Coefficients of the third difference.
const DIFFERENCE: [f64; ORDER + 1] = [-1.0, 3.0, -3.0, 1.0];

/// Quantisation step of the speeds of each track, q/T, m/s; zero where all are equal.
pub(super) fn steps(runs: &[Vec<TrackSample>], settings: &settings::Evidence) -> PerSide<f64> {
    let speeds = |side| runs.iter().flatten().map(move |track| speed(track, side));
    PerSide::from_fn(|side| step(speeds(side), settings.min_speed_step))
}

/// Readings of all runs with speeds smoothed between ticks; `step` is the quantisation step (m/s).
pub(super) fn smoothed(
    runs: &[Vec<TrackSample>],
    step: PerSide<f64>,
    settings: &Settings,
) -> Vec<Vec<TrackSample>> {
    let by = &settings.evidence;
    let smooth = |run: &Vec<TrackSample>| {
        let stamps: Vec<f64> = run.iter().map(|reading| reading.t).collect();
        let stretches = stretches(&stamps, &settings.stamps).into_iter();
        stretches
            .flat_map(|(stretch, interval)| between_ticks(&run[stretch], interval, step, by))
            .collect()
    };
    runs.iter().map(smooth).collect()
}

/// Smallest difference of two speeds of one track above rounding, m/s.
fn step(speeds: impl Iterator<Item = f64>, rounding: f64) -> f64 {
    let mut shown: Vec<f64> = speeds.collect();
    shown.sort_by(f64::total_cmp);
    let steps = shown.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step > rounding);
    steps.reduce(f64::min).unwrap_or(0.0)
}

fn speed(reading: &TrackSample, side: Side) -> f64 {
    reading.speeds()[side]
}

/// Smoothed readings of a stretch with regular `interval` (s) and quantisation step `step` (m/s).
fn between_ticks(
    stretch: &[TrackSample],
    interval: f64,
    step: PerSide<f64>,
    settings: &settings::Evidence,
) -> Vec<TrackSample> {
    if interval <= 0.0 {
        return stretch.to_vec(); // single reading of a steady point
    }
    let of = |side: Side| {
        let travel = stretch.iter().scan(0.0, |travel, reading| {
            *travel += speed(reading, side) * interval;
            Some(*travel)
        });
        let travel: Vec<f64> = std::iter::once(0.0).chain(travel).collect();
        smoothed_travel(&travel, step[side] * interval, settings)
    };
    let travel = PerSide::from_fn(of);
    let speed = |side: Side, k: usize| (travel[side][k + 1] - travel[side][k]) / interval;
    let speeds = |side: Side| (0..stretch.len()).map(|k| speed(side, k)).collect();
    with_speeds(stretch, &PerSide::from_fn(speeds))
}

/// Smoothed travel with the least expected error, from travel counted in ticks, m.
fn smoothed_travel(counted: &[f64], tick: f64, settings: &settings::Evidence) -> Vec<f64> {
    if counted.len() <= 2 * ORDER || tick <= 0.0 {
        return counted.to_vec();
    }
    let variance = tick * tick / 12.0;
    // C_p = Σ (S − S̃)²/n + 2 σ² tr(H)/n; without smoothing S = S̃ and H = 1
    let mut best = (2.0 * variance, counted.to_vec());
    let [first, last] = settings.smoothing_powers;
    let powers = (0..).map(|k| first + real(k)).take_while(|power| *power <= last);
    for power in powers {
        let lambda = 10_f64.powf(0.5 * power);
        let smooth = whittaker(counted, lambda);
        let apart = smooth.iter().zip(counted).map(|(a, b)| (a - b) * (a - b));
        let freedom = freedom(lambda, settings.smoothing_frequencies);
        let expected = apart.sum::<f64>() / real(counted.len()) + 2.0 * variance * freedom;
        if expected < best.0 {
            best = (expected, smooth);
        }
    }
    best.1
}

/// Degrees of freedom per sample, tr(H)/n for large n: mean over `frequencies` of the filter's
/// response 1/(1 + λ (2 − 2 cos ω)³).
fn freedom(lambda: f64, frequencies: usize) -> f64 {
    let passes = |k: usize| {
        let omega = PI * (real(k) + 0.5) / real(frequencies);
        (1.0 + lambda * (2.0 - 2.0 * omega.cos()).powi(3)).recip()
    };
    (0..frequencies).map(passes).sum::<f64>() / real(frequencies)
}

/// Solves (1 + λ D'D) S = S̃, with D the third differences, by banded LDL'.
fn whittaker(counted: &[f64], lambda: f64) -> Vec<f64> {
    let count = counted.len();
    // row k of the matrix: elements (k, k), (k, k − 1), ...
    let mut band = vec![[0.0; ORDER + 1]; count];
    for first in 0..count - ORDER {
        for (a, weight) in DIFFERENCE.iter().enumerate() {
            for (b, other) in DIFFERENCE[..=a].iter().enumerate() {
                band[first + a][a - b] += lambda * weight * other;
            }
        }
    }
    for row in &mut band {
        row[0] += 1.0;
    }
    let mut solution = counted.to_vec();
    for k in 0..count {
        // L_kj = (A_kj − Σ L_ki D_i L_ji)/D_j, D_k = A_kk − Σ L_ki² D_i
        for back in (1..=ORDER.min(k)).rev() {
            let j = k - back;
            let deeper = (back + 1..=ORDER.min(k)).filter(|deep| deep - back <= ORDER);
            let sum: f64 =
                deeper.map(|deep| band[k][deep] * band[k - deep][0] * band[j][deep - back]).sum();
            band[k][back] = (band[k][back] - sum) / band[j][0];
        }
        for back in 1..=ORDER.min(k) {
            band[k][0] -= band[k][back] * band[k][back] * band[k - back][0];
            solution[k] -= band[k][back] * solution[k - back];
        }
    }
    for k in (0..count).rev() {
        solution[k] /= band[k][0];
        for ahead in 1..=ORDER.min(count - 1 - k) {
            solution[k] -= band[k + ahead][ahead] * solution[k + ahead];
        }
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frequencies over which the response is averaged.
    const FREQUENCIES: usize = 512;

    const INTERVAL: f64 = 0.05;

    #[test]
    fn a_steady_point_stays_as_it_is() {
        let point = vec![TrackSample { t: 0.0, v_left: 0.3, v_right: -0.1 }];
        let (steps, settings) = (PerSide::new(0.01, 0.01), Settings::default());
        assert_eq!(smoothed(std::slice::from_ref(&point), steps, &settings), [point]);
    }

    /// Travel up to reading k with varying acceleration, m.
    fn travel(k: i32) -> f64 {
        // v = 0.4 sin t³ᐟ² has accelerations up to 3 m/s²
        let steps = 40;
        let speed = |t: f64| 0.4 * t.powf(1.5).sin();
        let dt = INTERVAL / f64::from(steps);
        (0..k * steps).map(|step| dt * speed(dt * (f64::from(step) + 0.5))).sum()
    }

    /// Readings of travel counted in ticks.
    fn counted(tick: f64) -> Vec<TrackSample> {
        let shown = |k: i32| tick * (travel(k) / tick + 0.3).floor();
        let reading = |k: i32| {
            let speed = (shown(k + 1) - shown(k)) / INTERVAL;
            TrackSample { t: INTERVAL * f64::from(k), v_left: speed, v_right: -speed }
        };
        (0..400).map(reading).collect()
    }

    /// Root mean square errors of speed (m/s) and of travel about its mean error (m).
    fn errors(run: &[TrackSample]) -> [f64; 2] {
        let rms = |of: &[f64]| (of.iter().map(|e| e * e).sum::<f64>() / real(of.len())).sqrt();
        let truth = |k: i32| travel(k + 1) - travel(k);
        let speed: Vec<f64> =
            (0..).zip(run).map(|(k, reading)| reading.v_left - truth(k) / INTERVAL).collect();
        let way = speed.iter().scan(0.0, |way, error| {
            *way += error * INTERVAL;
            Some(*way)
        });
        let way: Vec<f64> = way.collect();
        let mean = way.iter().sum::<f64>() / real(way.len());
        [rms(&speed), rms(&way.iter().map(|error| error - mean).collect::<Vec<_>>())]
    }

    fn even(runs: &[Vec<TrackSample>]) -> Vec<Vec<TrackSample>> {
        let settings = Settings::default();
        smoothed(runs, steps(runs, &settings.evidence), &settings)
    }

    #[test]
    fn speeds_and_travel_come_nearer_to_the_truth() {
        for tick in [5e-4, 2e-3, 5e-3] {
            let run = counted(tick);
            let smooth = &even(std::slice::from_ref(&run))[0];
            let ([before, far], [after, near]) = (errors(&run), errors(smooth));
            assert!(after < 0.7 * before, "{tick} m: {after} of {before} m/s");
            assert!(near < 0.95 * far, "{tick} m: {near} of {far} m");
            assert!(smooth.iter().zip(&run).all(|(a, b)| a.t == b.t && a.v_left == -a.v_right));
        }
    }

    /// A smoother that bent constant acceleration would act like a drive lag.
    #[test]
    fn even_accelerations_stay_as_they_are() {
        let ramp: Vec<f64> = (0..60).map(|k| 1e-4 * f64::from(k * k)).collect();
        for (a, b) in ramp.iter().zip(whittaker(&ramp, 1e3)) {
            assert!((a - b).abs() < 1e-9);
        }
    }

    #[test]
    fn the_freedom_left_is_the_trace_of_the_filter() {
        let count = 120;
        for lambda in [0.1, 10.0, 1e3] {
            let diagonal = |k: usize| {
                let mut unit = vec![0.0; count];
                unit[k] = 1.0;
                whittaker(&unit, lambda)[k]
            };
            let trace = (0..count).map(diagonal).sum::<f64>() / real(count);
            // the ends have more freedom
            let far = freedom(lambda, FREQUENCIES);
            let near = far + 0.03;
            assert!((far..near).contains(&trace), "{lambda}: {trace}, {far}");
        }
    }

    #[test]
    fn readings_without_ticks_stay_and_gaps_part_them() {
        let mut run = counted(1e-9);
        for (a, b) in even(std::slice::from_ref(&run))[0].iter().zip(&run) {
            assert!((a.v_left - b.v_left).abs() < 1e-6);
        }
        run = counted(2e-3);
        run.iter_mut().skip(200).for_each(|reading| reading.t += 1.0);
        let whole = &even(std::slice::from_ref(&run))[0];
        let halves = even(&[run[..200].to_vec(), run[200..].to_vec()]).concat();
        assert_eq!(whole.len(), halves.len());
        assert!(whole.iter().zip(&halves).all(|(a, b)| (a.v_left - b.v_left).abs() < 1e-9));
    }
}
