//! A random walk seen in white noise.
//!
//! # Law
//! y_k = x_k + e_k, Var e = R, Var(x_k − x_j) = q (t_k − t_j), and nothing is known of the first x.
//!
//! # Sources
//! Harvey, Forecasting, structural time series models and the Kalman filter, 1989 (local level).

use trackdyn_core::real;
use trackdyn_core::robust::{MEDIAN_OF_CHI_SQUARE, median};

/// Smallest variance of a pose, rad²: less is rounding.
const MIN_WHITE: f64 = 1e-12;

/// Smallest variance of the walk, rad²/s.
const MIN_WALK: f64 = 1e-16;

/// Fewest differences for a variance.
const MIN_DIFFERENCES: usize = 20;

/// Longest difference, in poses.
const MAX_STEPS: usize = 64;

/// Its variances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Level {
    /// R, rad².
    pub(super) white: f64,
    /// q, rad²/s.
    pub(super) walk: f64,
}

/// One step of the Kalman filter: gain K, inverse standard deviation of the innovation, and the
/// variances of the level before and after.
struct Step {
    gain: f64,
    inverse: f64,
    before: f64,
    after: f64,
}

impl Level {
    /// Variances that whiten a column to its differences.
    pub(super) const DIFFERENCES: Self = Self { white: MIN_WHITE, walk: 1.0 };

    /// Variance of the change of y over a time, s.
    pub(super) fn of_change(&self, time: f64) -> f64 {
        2.0 * self.white + self.walk * time
    }

    /// The filter, from the second time on.
    fn steps(&self, times: &[f64]) -> impl Iterator<Item = Step> {
        let mut known = self.white;
        let intervals = times.windows(2).map(|pair| pair[1] - pair[0]).collect::<Vec<_>>();
        let Self { white, walk } = *self;
        intervals.into_iter().map(move |interval| {
            let before = known + walk * interval;
            let total = before + white;
            let gain = before / total;
            known = white * gain;
            Step { gain, inverse: total.sqrt().recip(), before, after: known }
        })
    }

    /// What is new in each value but the first, in standard deviations.
    pub(super) fn whitened(&self, times: &[f64], values: &[f64]) -> Vec<f64> {
        let mut level = values.first().copied().unwrap_or_default();
        let later = values.iter().skip(1).zip(self.steps(times));
        later
            .map(|(value, step)| {
                let innovation = value - level;
                level += step.gain * innovation;
                step.inverse * innovation
            })
            .collect()
    }

    /// The level at each time by all values, and its variance.
    pub(super) fn smoothed(&self, times: &[f64], values: &[f64]) -> Vec<(f64, f64)> {
        let Some(&first) = values.first() else { return Vec::new() };
        let mut filtered = vec![(first, self.white)];
        let steps: Vec<Step> = self.steps(times).collect();
        for (value, step) in values.iter().skip(1).zip(&steps) {
            let (level, _) = filtered[filtered.len() - 1];
            filtered.push((level + step.gain * (value - level), step.after));
        }
        for k in (0..steps.len()).rev() {
            let ((level, known), (next, of_next)) = (filtered[k], filtered[k + 1]);
            // C = P/P⁻: back from the next level
            let back = known / steps[k].before;
            let variance = known + back * back * (of_next - steps[k].before);
            filtered[k] = (level + back * (next - level), variance);
        }
        filtered
    }

    /// The variances that the differences of some rows of times and values show: 2R + q T over T
    /// is fitted to their median squares. None of too few.
    pub(super) fn of(rows: &[(&[f64], Vec<f64>)]) -> Option<Self> {
        let doubled = std::iter::successors(Some(1), |steps| Some(2 * steps));
        // Weight, T and variance of the differences over so many poses.
        let of_steps = |steps: usize| -> Option<[f64; 3]> {
            let (mut squares, mut time) = (Vec::new(), 0.0);
            for (times, values) in rows {
                for k in steps..values.len() {
                    squares.push((values[k] - values[k - steps]).powi(2));
                    time += times[k] - times[k - steps];
                }
            }
            let count = squares.len();
            if count < MIN_DIFFERENCES * steps.min(4) {
                return None;
            }
            let variance = (median(&mut squares)? / MEDIAN_OF_CHI_SQUARE).max(MIN_WHITE);
            // Differences overlap: about one in `steps` is independent of the others.
            let weight = real(count) / real(steps) / variance.powi(2);
            Some([weight, time / real(count), variance])
        };
        let rows: Vec<[f64; 3]> =
            doubled.take_while(|steps| *steps <= MAX_STEPS).map_while(of_steps).collect();
        let [&[_, time, variance], ..] = rows.iter().collect::<Vec<_>>()[..] else { return None };
        let sum = |of: &dyn Fn(f64, f64) -> f64| -> f64 {
            rows.iter().map(|[weight, time, variance]| weight * of(*time, *variance)).sum()
        };
        let [w, wt, wtt] = [sum(&|_, _| 1.0), sum(&|t, _| t), sum(&|t, _| t * t)];
        let [wv, wtv] = [sum(&|_, v| v), sum(&|t, v| t * v)];
        let determinant = w * wtt - wt * wt;
        let (white, walk) = if determinant > 1e-12 * w * wtt {
            ((wv * wtt - wtv * wt) / (2.0 * determinant), (wtv * w - wv * wt) / determinant)
        } else {
            (variance / 2.0, 0.0)
        };
        let (white, walk) = if walk < 0.0 {
            (wv / w / 2.0, 0.0)
        } else if white < 0.0 {
            (0.0, wtv / wtt)
        } else {
            (white, walk)
        };
        debug_assert!(time > 0.0);
        Some(Self { white: white.max(MIN_WHITE), walk: walk.max(MIN_WALK) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    const LEVEL: Level = Level { white: 4e-6, walk: 1e-6 };

    fn times(count: u32) -> Vec<f64> {
        (0..count).map(|k| 0.1 * f64::from(k) + if k % 3 == 0 { 0.02 } else { 0.0 }).collect()
    }

    /// A walk in white noise.
    fn values(times: &[f64], seed: u64) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let (mut level, mut before) = (0.3, times[0]);
        let value = times.iter().map(|&t| {
            level += (LEVEL.walk * (t - before)).sqrt() * normal();
            before = t;
            level + LEVEL.white.sqrt() * normal()
        });
        value.collect()
    }

    /// The level by the normal equations of all values at once.
    #[test]
    fn the_smoother_solves_the_normal_equations() {
        let times = times(12);
        let values = values(&times, 1);
        let count = times.len();
        let mut normal = DMatrix::identity(count, count) / LEVEL.white;
        for k in 1..count {
            let weight = 1.0 / (LEVEL.walk * (times[k] - times[k - 1]));
            for (a, b, sign) in
                [(k, k, 1.0), (k - 1, k - 1, 1.0), (k, k - 1, -1.0), (k - 1, k, -1.0)]
            {
                normal[(a, b)] += sign * weight;
            }
        }
        let inverse = normal.try_inverse().expect("positive definite");
        let expected = &inverse * DVector::from(values.clone()) / LEVEL.white;
        for (k, (level, variance)) in LEVEL.smoothed(&times, &values).into_iter().enumerate() {
            assert!((level - expected[k]).abs() < 1e-12, "{k}: {level} {}", expected[k]);
            assert!((variance / inverse[(k, k)] - 1.0).abs() < 1e-9, "{k}: {variance}");
        }
    }

    #[test]
    fn innovations_are_white_and_differences_show_the_variances() {
        let times = times(4000);
        let values = values(&times, 2);
        let white = LEVEL.whitened(&times, &values);
        let count = f64::from(u32::try_from(white.len()).expect("small"));
        let variance = white.iter().map(|z| z * z).sum::<f64>() / count;
        let correlation = white.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>() / count;
        assert!(
            (variance - 1.0).abs() < 0.1 && correlation.abs() < 0.06,
            "{variance} {correlation}"
        );
        let found = Level::of(&[(&times, values)]).expect("enough");
        assert!((found.white / LEVEL.white).ln().abs() < 0.15, "{found:?}");
        assert!((found.walk / LEVEL.walk).ln().abs() < 0.5, "{found:?}");
    }
}
