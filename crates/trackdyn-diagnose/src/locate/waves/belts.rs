//! Waves along the way of the belts.
//!
//! # Law
//! A sprocket or an encoder that runs out of true, or a damaged belt, comes round again after a
//! certain way w of its track. To first order it changes the speed of that side by a factor:
//!
//! δV = V (A cos κ w + B sin κ w)
//!
//! so that each wave number κ has two columns for each side. The place of a belt at the beginning
//! of a run is unknown. So each run has its own A and B, and so has each stretch of a long run.

use super::{Along, Part, Resolved};
use crate::evidence::{Evidence, Origin, run_ranges};
use crate::fit::Fit;
use crate::locate::IcrColumns;
use crate::mechanics::Instruments;
use crate::weighted::Weighted;
use nalgebra::Vector3;
use std::f64::consts::TAU;
use std::ops::Range;
use trackdyn_core::{PerSide, Side, real};
use trackdyn_recording::hold::travelled;

/// Waves of the belts; none in a table of steady points.
pub fn resolved<'a>(evidence: &'a Weighted, fit: &Fit, _icrs: &IcrColumns) -> Option<Resolved<'a>> {
    if matches!(evidence.origin(), Origin::SteadyPoints(_)) {
        return None;
    }
    let settings = &evidence.settings().location;
    let ways = ways(evidence);
    let parts = stretches(evidence, &ways);
    let length = |part: &Part| Side::BOTH.map(|side| extent(&ways[part.samples.clone()], side));
    let longest = parts.iter().flat_map(length).fold(0.0, f64::max);
    let step = TAU / (settings.waves_per_length * longest);
    let largest = TAU / settings.min_belt_wavelength;
    let numbers =
        (settings.min_belt_waves..).map(|k| real(k) * step).take_while(|number| *number <= largest);
    let numbers: Vec<f64> = numbers.take(settings.max_waves).collect();
    let waves = numbers.iter().map(|number| (TAU / number, Along::Belts)).collect();
    let by_gain = by_gain(evidence, fit);
    let columns = move |wave: usize| columns(&ways, &by_gain, numbers[wave]).into();
    Some(Resolved { evidence, waves, columns: Box::new(columns), parts })
}

/// Ways of the tracks since their run began, at the start and at the end of a sample, m.
type Ways = PerSide<[f64; 2]>;

fn ways(evidence: &Evidence) -> Vec<Ways> {
    let samples = evidence.samples();
    let along_run = |range: Range<usize>| {
        let mut until = samples[range.start].start;
        let mut way = PerSide::new(0.0, 0.0);
        samples[range].iter().map(move |sample| {
            let tracks = &evidence.tracks()[sample.run];
            let since = travelled(tracks, until, sample.start, evidence.tau());
            until = sample.start;
            way = PerSide::from_fn(|side| way[side] + since[side]);
            PerSide::from_fn(|side| [way[side], way[side] + sample.speeds[side] * sample.duration])
        })
    };
    run_ranges(samples).flat_map(along_run).collect()
}

/// Whole blocks of one run, as many as the belts run their longest way in.
fn stretches(evidence: &Evidence, ways: &[Ways]) -> Vec<Part> {
    let samples = evidence.samples();
    let longest = evidence.settings().location.max_belt_way;
    let mut stretches: Vec<Part> = Vec::new();
    let mut first = 0;
    for block in samples.chunk_by(|a, b| a.block == b.block) {
        let (end, number) = (first + block.len(), block[0].block);
        let joined = stretches.last_mut().filter(|stretch| {
            let is_of_run = samples[stretch.samples.start].run == block[0].run;
            let whole = &ways[stretch.samples.start..end];
            is_of_run && Side::BOTH.into_iter().all(|side| extent(whole, side) <= longest)
        });
        match joined {
            Some(stretch) => (stretch.samples.end, stretch.blocks.end) = (end, number + 1),
            None => stretches.push(Part { samples: first..end, blocks: number..number + 1 }),
        }
        first = end;
    }
    stretches
}

/// Difference between the farthest points of a belt's way, m.
fn extent(ways: &[Ways], side: Side) -> f64 {
    let ends = ways.iter().flat_map(|ways| ways[side]);
    let [low, high] = ends
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], way| [low.min(way), high.max(way)]);
    high - low
}

/// Derivative of the prediction by a factor of each side's speed, not whitened.
fn by_gain(evidence: &Evidence, fit: &Fit) -> PerSide<Vec<Vector3<f64>>> {
    /// Step of the factor: motions are nearly linear in it.
    const STEP: f64 = 1e-3;
    let instruments = Instruments::of(&fit.hypothesis);
    let here = fit.mechanics.predict(&instruments, evidence);
    PerSide::from_fn(|side| {
        let mut faster = instruments;
        faster.drive.gain[side] *= 1.0 + STEP;
        let there = fit.mechanics.predict(&faster, evidence);
        there.iter().zip(&here).map(|(there, here)| (there - here) / STEP).collect()
    })
}

/// The two columns of each side of a wave.
fn columns(
    ways: &[Ways],
    by_gain: &PerSide<Vec<Vector3<f64>>>,
    number: f64,
) -> [Vec<Vector3<f64>>; 4] {
    let column = |side: Side, mean: fn([f64; 2]) -> f64| {
        let factors = ways.iter().map(|ways| mean(ways[side].map(|way| number * way)));
        by_gain[side].iter().zip(factors).map(|(by, factor)| by * factor).collect()
    };
    let [[a, b], [c, d]] = Side::BOTH.map(|side| [column(side, mean_cos), column(side, mean_sin)]);
    [a, b, c, d]
}

/// Mean of cos over a range: (sin b − sin a)/(b − a) = cos ((a + b)/2) sinc ((b − a)/2).
fn mean_cos([a, b]: [f64; 2]) -> f64 {
    f64::midpoint(a, b).cos() * sinc((b - a) / 2.0)
}

/// Mean of sin over a range: sin ((a + b)/2) sinc ((b − a)/2).
fn mean_sin([a, b]: [f64; 2]) -> f64 {
    f64::midpoint(a, b).sin() * sinc((b - a) / 2.0)
}

/// sin x/x.
fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.sin() / x }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::Base;
    use crate::evidence::planned::{PlannedRun, READINGS};
    use crate::locate::waves::Remainder;
    use crate::mechanics::Mechanics;
    use crate::plan::assumed_noise;
    use crate::progress::Watch;
    use crate::resampling::Resampling;
    use crate::settings::Settings;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};
    use trackdyn_core::Pose;
    use trackdyn_model::VehicleFile;
    use trackdyn_recording::TrackSample;

    /// Four runs of a minute at changing speeds, in blocks of 8 s.
    fn driven(file: &VehicleFile) -> Weighted {
        let reading = |run: usize| {
            move |k: usize| {
                let (t, phase) = (0.03 * real(k), real(run));
                let v_left = 0.4 + 0.3 * (0.5 * t + phase).sin();
                let v_right = 0.4 + 0.3 * (0.31 * t + 2.0 * phase).cos();
                TrackSample { t, v_left, v_right }
            }
        };
        let run = |run: usize| PlannedRun {
            tracks: (0..=225 * READINGS).map(reading(run)).collect(),
            pose: Pose::default(),
            blocks: (0..7).map(|block| 32 * READINGS * block).collect(),
        };
        let runs: Vec<PlannedRun> = (0..4).map(run).collect();
        let settings = Settings::default();
        let robot = crate::hypothesis::Hypothesis::filed(file, &settings.prior);
        let noise = assumed_noise(1e-3, 1e-3);
        Weighted::new(Evidence::planned(&runs, noise, 0.0, &settings, |evidence| {
            Mechanics::new(&robot, evidence).predict(&Instruments::of(&robot), evidence)
        }))
    }

    /// A wave with a phase of its own in each run is found with its length; of noise alone nothing
    /// is.
    #[test]
    fn a_wave_is_found_with_its_length_and_noise_is_none() {
        const LENGTH: f64 = 0.9;
        let file = VehicleFile::auriga_alpha();
        let evidence = driven(&file);
        let base = Base::new(&file, &evidence, &Watch::none()).expect("nobody stops it");
        let icrs = [Vec::new(), Vec::new(), Vec::new()];
        let waves = resolved(&evidence, &base.fit, &icrs).expect("a drive");
        assert_eq!(waves.parts.len(), 4, "one of each run");
        let by_gain = by_gain(&evidence, &base.fit);
        let ways = ways(&evidence);
        let shape = columns(&ways, &by_gain, TAU / LENGTH).map(|column| evidence.white(column));
        let length = shape[0].iter().map(Vector3::norm_squared).sum::<f64>().sqrt();
        let resampling = Resampling { draws: 199, seed: 1 };
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let mut false_alarms = 0;
        for _ in 0..8 {
            let noise: Vec<Vector3<f64>> = evidence
                .samples()
                .iter()
                .map(|_| Vector3::from_fn(|_, _| StandardNormal.sample(&mut random)))
                .collect();
            let found = |residual: &[Vector3<f64>]| {
                let remainder = Remainder::new(&evidence, residual, &base.fit.columns);
                waves.strongest(&remainder, resampling).expect("some are tried")
            };
            false_alarms += usize::from(found(&noise).test.p <= 0.01);
            // z = 16 in all
            let phase = |run: usize| real(run).sin_cos();
            let residual: Vec<Vector3<f64>> = noise
                .iter()
                .zip(evidence.samples())
                .enumerate()
                .map(|(k, (noise, sample))| {
                    let (sin, cos) = phase(sample.run);
                    noise + (shape[0][k] * cos + shape[1][k] * sin) * (16.0 / length)
                })
                .collect();
            let wave = found(&residual);
            assert!(wave.test.p <= 0.01, "{wave:?}");
            assert!((wave.length / LENGTH - 1.0).abs() < 0.03, "{wave:?}");
        }
        assert!(false_alarms <= 1, "{false_alarms} of 8");
    }

    #[test]
    fn means_over_a_range_are_those_of_quadrature() {
        for [a, b] in [[0.3, 0.3], [-1.0, 2.5], [4.0, -3.0], [1.0, 1.0 + 1e-9]] {
            let count = 20_000;
            let points = (0..count).map(|k| a + (b - a) * (real(k) + 0.5) / real(count));
            let sums = points.fold([0.0, 0.0], |[c, s], x: f64| [c + x.cos(), s + x.sin()]);
            let [cos, sin] = sums.map(|sum| sum / real(count));
            assert!((mean_cos([a, b]) - cos).abs() < 1e-8, "{a} {b}");
            assert!((mean_sin([a, b]) - sin).abs() < 1e-8, "{a} {b}");
        }
    }
}
