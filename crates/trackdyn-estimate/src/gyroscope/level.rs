//! A random walk seen in white noise and in an error that wanders about zero.
//!
//! # Law
//! y_k = x_k + o_k + e_k with Var e = R, Var(x_k − x_j) = q (t_k − t_j), of whose first value
//! nothing is known, and Cov(o_k, o_j) = W exp(−|t_k − t_j|/T). So
//!
//! Var(y_k − y_j) = 2R + 2W (1 − exp(−|t_k − t_j|/T)) + q |t_k − t_j|
//!
//! # Sources
//! Harvey, Forecasting, structural time series models and the Kalman filter, 1989; Rauch, Tung,
//! Striebel, AIAA Journal 3(8), 1965 (smoother).

use super::Settings;
use nalgebra::{Matrix2, Matrix3, RowVector2, Vector2, Vector3};
use trackdyn_core::real;
use trackdyn_core::robust::{MEDIAN_OF_CHI_SQUARE, median};

/// Smallest variance of a value, rad²: less is rounding.
const MIN_WHITE: f64 = 1e-12;

/// Smallest variance of the walk, rad²/s.
const MIN_WALK: f64 = 1e-14;

/// Relative variance of a variance that is estimated by the median of n squares, times n.
const VARIANCE_OF_MEDIAN: f64 = 5.4;

/// Its variances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Level {
    /// R, rad².
    pub(super) white: f64,
    /// W, rad².
    pub(super) wander: f64,
    /// T, s.
    pub(super) time: f64,
    /// q, rad²/s.
    pub(super) walk: f64,
}

/// What is known of walk and wandering error: mean and covariance.
#[derive(Clone, Copy)]
struct Known {
    mean: Vector2<f64>,
    covariance: Matrix2<f64>,
}

/// One step of the Kalman filter.
struct Step {
    /// What both states become of those before.
    forward: Matrix2<f64>,
    /// Covariance before the value is seen.
    before: Matrix2<f64>,
    gain: Vector2<f64>,
    /// Inverse standard deviation of the innovation.
    inverse: f64,
    /// Covariance after it.
    after: Matrix2<f64>,
}

/// How a value shows both states.
const OBSERVATION_ROW: RowVector2<f64> = RowVector2::new(1.0, 1.0);

impl Level {
    /// Variances that whiten a column to its differences.
    pub(super) const DIFFERENCES: Self =
        Self { white: MIN_WHITE, wander: 0.0, time: 1.0, walk: 1.0 };

    /// Variance of the change of y over a time, s.
    pub(super) fn of_change(&self, time: f64) -> f64 {
        let wandered = 1.0 - (-time / self.time).exp();
        2.0 * self.white + 2.0 * self.wander * wandered + self.walk * time
    }

    /// What is known at the first value y: x = y − o − e.
    fn first(&self, value: f64) -> Known {
        let Self { white, wander, .. } = *self;
        let covariance = Matrix2::new(white + wander, -wander, -wander, wander);
        Known { mean: Vector2::new(value, 0.0), covariance }
    }

    /// The filter, from the second time on. It is the same for all values at these times.
    fn steps(&self, times: &[f64]) -> Vec<Step> {
        let mut known = self.first(0.0).covariance;
        let step = |pair: &[f64]| {
            let interval = pair[1] - pair[0];
            let left = (-interval / self.time).exp();
            let forward = Matrix2::new(1.0, 0.0, 0.0, left);
            let added = Vector2::new(self.walk * interval, self.wander * (1.0 - left * left));
            let before = forward * known * forward + Matrix2::from_diagonal(&added);
            let total = (OBSERVATION_ROW * before * OBSERVATION_ROW.transpose())[0] + self.white;
            let gain = before * OBSERVATION_ROW.transpose() / total;
            known = before - gain * total * gain.transpose();
            Step { forward, before, gain, inverse: total.sqrt().recip(), after: known }
        };
        times.windows(2).map(step).collect()
    }

    /// The innovation of each value but the first, in standard deviations.
    pub(super) fn whitened(&self, times: &[f64], values: &[f64]) -> Vec<f64> {
        let Some(&first) = values.first() else { return Vec::new() };
        let mut mean = self.first(first).mean;
        let steps = self.steps(times);
        let later = values.iter().skip(1).zip(steps);
        later
            .map(|(value, step)| {
                mean = step.forward * mean;
                let innovation = value - mean.sum();
                mean += step.gain * innovation;
                step.inverse * innovation
            })
            .collect()
    }

    /// The walk at each time by all values. An innovation counts as `most` standard deviations at
    /// most.
    pub(super) fn smoothed(&self, times: &[f64], values: &[f64], most: f64) -> Vec<f64> {
        let Some(&first) = values.first() else { return Vec::new() };
        let mut all = vec![self.first(first)];
        let steps = self.steps(times);
        for (value, step) in values.iter().skip(1).zip(&steps) {
            let mean = step.forward * all[all.len() - 1].mean;
            let largest = most / step.inverse;
            let mean = mean + step.gain * (value - mean.sum()).clamp(-largest, largest);
            all.push(Known { mean, covariance: step.after });
        }
        for k in (0..steps.len()).rev() {
            let Step { forward, before, .. } = &steps[k];
            let (here, next) = (all[k], all[k + 1]);
            // C = P Fᵀ (P⁻)⁻¹
            let inverse = before.try_inverse().unwrap_or(Matrix2::zeros());
            let back = here.covariance * forward * inverse;
            all[k].mean = here.mean + back * (next.mean - forward * here.mean);
        }
        all.into_iter().map(|known| known.mean[0]).collect()
    }

    /// The variances that the differences of some rows of times and values show: the law is fitted
    /// to their median squares. None of too few.
    pub(super) fn of(rows: &[(&[f64], Vec<f64>)], settings: &Settings) -> Option<Self> {
        let doubled = std::iter::successors(Some(1), |steps| Some(2 * steps));
        let tried = doubled.take_while(|steps| *steps <= settings.max_difference_steps);
        let seen: Vec<Spread> =
            tried.map_while(|steps| Spread::of(rows, steps, settings)).collect();
        let (misfit, plain) = fitted(&seen, None)?;
        let times = settings.correlation_times.iter();
        let fits = times.filter_map(|&time| fitted(&seen, Some(time)));
        let best = fits.min_by(|a, b| a.0.total_cmp(&b.0));
        let best =
            best.filter(|best| best.0 < misfit - settings.min_fall).map_or(plain, |best| best.1);
        Some(Self { white: best.white.max(MIN_WHITE), walk: best.walk.max(MIN_WALK), ..best })
    }
}

/// Differences over so many values.
struct Spread {
    /// 1 over the variance of the variance.
    weight: f64,
    /// Mean time, s.
    time: f64,
    variance: f64,
}

impl Spread {
    fn of(rows: &[(&[f64], Vec<f64>)], steps: usize, settings: &Settings) -> Option<Self> {
        let &Settings { max_difference_share, min_differences, .. } = settings;
        let (mut squares, mut time) = (Vec::new(), 0.0);
        for (times, values) in rows {
            let [Some(first), Some(last)] = [times.first(), times.last()] else { continue };
            let usual = (last - first) / real(times.len());
            if real(steps) * usual > max_difference_share * (last - first) {
                continue;
            }
            for k in steps..values.len() {
                squares.push((values[k] - values[k - steps]).powi(2));
                time += times[k] - times[k - steps];
            }
        }
        let count = squares.len();
        if count < min_differences * steps.min(8) {
            return None;
        }
        let variance = (median(&mut squares)? / MEDIAN_OF_CHI_SQUARE).max(MIN_WHITE);
        // Differences overlap: about one in `steps` is independent of the others.
        let weight = real(count) / real(steps) / VARIANCE_OF_MEDIAN / variance.powi(2);
        Some(Self { weight, time: time / real(count), variance })
    }
}

/// The non-negative variances that fit best at this time of correlation, s, or without an error
/// that wanders; and the chi-squared of their misfit. All choices of variances that are not zero
/// are tried.
fn fitted(seen: &[Spread], time: Option<f64>) -> Option<(f64, Level)> {
    let row = |of: &Spread| {
        let wandered = time.map_or(0.0, |time| 1.0 - (-of.time / time).exp());
        Vector3::new(2.0, 2.0 * wandered, of.time) * of.weight.sqrt()
    };
    let (mut matrix, mut right, mut square) = (Matrix3::zeros(), Vector3::zeros(), 0.0);
    for of in seen {
        let (row, value) = (row(of), of.variance * of.weight.sqrt());
        matrix += row * row.transpose();
        right += row * value;
        square += value * value;
    }
    let choices = (1_u8..8).filter_map(|choice| {
        let is_free = |k: usize| choice & (1 << k) != 0 && matrix[(k, k)] > 0.0;
        let (mut system, mut free) = (matrix, right);
        for k in (0..3).filter(|&k| !is_free(k)) {
            system.fill_row(k, 0.0);
            system.fill_column(k, 0.0);
            system[(k, k)] = 1.0;
            free[k] = 0.0;
        }
        let found = system.cholesky()?.solve(&free);
        let misfit = square - 2.0 * right.dot(&found) + (matrix * found).dot(&found);
        let [white, wander, walk] = found.into();
        let is_possible = white >= 0.0 && wander >= 0.0 && walk >= 0.0;
        let time = time.unwrap_or(1.0);
        is_possible.then_some((misfit, Level { white, wander, time, walk }))
    });
    choices.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|_| seen.len() >= 2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    const LEVEL: Level = Level { white: 4e-6, wander: 9e-6, time: 1.0, walk: 1e-7 };

    fn times(count: u32) -> Vec<f64> {
        (0..count).map(|k| 0.1 * f64::from(k) + if k % 3 == 0 { 0.02 } else { 0.0 }).collect()
    }

    /// A walk with both errors.
    fn values(times: &[f64], seed: u64) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let (mut walk, mut wander, mut before) = (0.3, LEVEL.wander.sqrt() * normal(), times[0]);
        let value = times.iter().map(|&t| {
            let left = (-(t - before) / LEVEL.time).exp();
            walk += (LEVEL.walk * (t - before)).sqrt() * normal();
            wander = left * wander + (LEVEL.wander * (1.0 - left * left)).sqrt() * normal();
            before = t;
            walk + wander + LEVEL.white.sqrt() * normal()
        });
        value.collect()
    }

    /// The walk by generalised least squares from the covariance of all values at once.
    #[test]
    fn the_smoother_is_the_best_linear_estimate() {
        let times = times(14);
        let values = values(&times, 1);
        let count = times.len();
        let far = 1e3; // variance of the first walk: nothing is known of it
        let walk = DMatrix::from_fn(count, count, |a, b| {
            far + LEVEL.walk * (times[a].min(times[b]) - times[0])
        });
        let errors = DMatrix::from_fn(count, count, |a, b| {
            let wander = LEVEL.wander * (-(times[a] - times[b]).abs() / LEVEL.time).exp();
            wander + if a == b { LEVEL.white } else { 0.0 }
        });
        // From the first value, so that the large variance leaves the digits that count.
        let from_first = DMatrix::from_fn(count - 1, count, |a, b| {
            f64::from(u8::from(b == a + 1)) - f64::from(u8::from(b == 0))
        });
        let total = &from_first * (&errors + &walk.map(|v| v - far)) * from_first.transpose();
        let inverse = total.try_inverse().expect("positive definite");
        let seen = &from_first * DVector::from(values.clone());
        // The errors given the differences; the walk is what they leave of the values.
        let expected =
            DVector::from(values.clone()) - &errors * from_first.transpose() * &inverse * &seen;
        for (k, level) in LEVEL.smoothed(&times, &values, 3.4).into_iter().enumerate() {
            assert!((level - expected[k]).abs() < 1e-10, "{k}: {level} {}", expected[k]);
        }
    }

    #[test]
    fn innovations_are_white_and_differences_show_the_variances() {
        let times = times(20_000);
        let values = values(&times, 2);
        let white = LEVEL.whitened(&times, &values);
        let count = f64::from(u32::try_from(white.len()).expect("small"));
        let variance = white.iter().map(|z| z * z).sum::<f64>() / count;
        let correlation = white.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>() / count;
        assert!(
            (variance - 1.0).abs() < 0.05 && correlation.abs() < 0.03,
            "{variance} {correlation}"
        );
        let found = Level::of(&[(&times, values)], &Settings::default()).expect("enough");
        assert!((found.white / LEVEL.white).ln().abs() < 0.2, "{found:?}");
        assert!((found.wander / LEVEL.wander).ln().abs() < 0.3, "{found:?}");
        assert!((found.walk / LEVEL.walk).ln().abs() < 0.7, "{found:?}");
    }
}
