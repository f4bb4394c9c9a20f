//! Noise of segments by restricted likelihood: that which makes their residuals most likely.
//!
//! # Law
//! White noise R of each pose, errors of its stamp, a random walk q within each segment, and a
//! wandering heading ([`SegmentNoise`]): eight variances that maximise a restricted likelihood with
//! heavy tails, so that outliers count little:
//!
//! maximise Σ ln det L⁻¹ − (ν + d)/2 ln(1 + |z|²/ν) + ½ taken·ln variances,  z = L⁻¹ r,
//!
//! L the Cholesky factor of the covariance, d = 3, or 1 where only yaw was measured. The last term
//! corrects for the degrees of freedom that a fit took from each variance. The level is then set by
//! the median of |z|², that of a χ² with three degrees of freedom, corrected for the fit.
//!
//! # Sources
//! Patterson, Thompson, Biometrika 58(3), 1971 (restricted likelihood);
//! [`variances`](crate::variances) (steps and tails).

use crate::variances::{Climb, LN_ZERO, MIN_GAIN, heavy_tailed};
use crate::weighting::{Seen, SegmentNoise, Weighting, Whitener};
use nalgebra::{DMatrix, SVector, Vector3};
use rayon::prelude::*;
use trackdyn_core::real;
use trackdyn_core::robust::{MEDIAN_OF_CHI_SQUARE, MEDIAN_OF_CHI_SQUARE_3, median};

/// Place of the variance of the stamps.
const STAMP: usize = 7;

/// Logarithms of the variances.
pub type Variances = SVector<f64, { SegmentNoise::COUNT }>;

/// How the noise is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Steps of the logarithms.
    pub climb: Climb,
    /// Degrees of freedom of the tails.
    pub tails: f64,
    /// Walk variance per second to start from, as share of the white one, 1/s.
    pub start_walk: f64,
    /// Heading variance to start from, as share of the walk in yaw.
    pub start_heading: f64,
    /// Variance of the stamps to start from, as its share of the white one at the mean speed.
    pub start_stamp: f64,
    /// Gain of the log-likelihood from which stamps have errors.
    pub min_stamp_gain: f64,
    /// Smallest walk variance per second, as share of the white one, 1/s.
    pub min_walk: f64,
}

impl Default for Search {
    fn default() -> Self {
        Self {
            climb: Climb { max_steps: 60, min_gain: 0.005, max_step: 1.5, difference: 1e-3 },
            tails: 5.0,
            start_walk: 0.03,
            start_heading: 0.5,
            start_stamp: 0.3,
            min_stamp_gain: MIN_GAIN,
            min_walk: 1e-5,
        }
    }
}

impl Search {
    /// Logarithms of the variances of a noise to start from. A negligible variance has no gradient,
    /// neither in the likelihood nor in the correction, so a walk starts at a share of the white
    /// noise at least.
    fn start(&self, noise: &SegmentNoise) -> Variances {
        let SegmentNoise { pose, mut walk, heading, .. } = *noise;
        for (walk, pose) in walk.iter_mut().zip(pose) {
            *walk = walk.max(self.start_walk * pose);
        }
        let heading = heading.max(self.start_heading * walk[2]);
        variances_of(&SegmentNoise { pose, walk, heading, ..*noise })
    }

    /// A noise from which the search can start.
    pub fn regular(&self, noise: &SegmentNoise) -> SegmentNoise {
        self.noise_of(&self.start(noise))
    }

    /// The noise with these logarithms of its variances.
    pub fn noise_of(&self, variances: &Variances) -> SegmentNoise {
        let pose = std::array::from_fn(|k| variances[k].exp());
        let walk = std::array::from_fn(|k| variances[3 + k].exp().max(self.min_walk * pose[k]));
        let stamp = if variances[STAMP] > LN_ZERO { variances[STAMP].exp() } else { 0.0 };
        SegmentNoise { pose, walk, heading: variances[6].exp(), stamp }
    }

    /// Most likely noise of the residuals of these motions, starting from `measured`. `taken` are
    /// the degrees of freedom that a fit took from each variance.
    ///
    /// A negligible variance has no gradient in its logarithm and would stay. So the search starts
    /// twice: from the measured noise, and from white noise alone.
    pub fn most_likely(
        &self,
        motions: &[Seen],
        residual: &[Vector3<f64>],
        measured: SegmentNoise,
        taken: &Variances,
    ) -> SegmentNoise {
        let likelihood = Likelihood { by: self, motions, residual };
        let climb = |start: Variances| self.climb.from(start, taken, |at| likelihood.terms(at));
        let from = |noise: SegmentNoise| {
            let mut here = self.start(&noise);
            here[STAMP] = LN_ZERO;
            climb(here)
        };
        let (first, second) = rayon::join(|| from(measured), || from(likelihood.white_alone()));
        let without = if second.1 > first.1 + self.climb.min_gain { second } else { first };
        // Errors of the stamps, where the likelihood asks for them clearly.
        let with = climb(likelihood.with_stamps(without.0, measured.stamp));
        let (here, _) = if with.1 > without.1 + self.min_stamp_gain { with } else { without };
        let noise = self.noise_of(&here);
        let (_, white) = likelihood.white(&noise);
        let seen = motions.iter().zip(&white).filter(|(_, white)| white.norm_squared() > 0.0);
        let numbers = real(seen.clone().map(|(motion, _)| motion.numbers()).sum());
        let all = seen.filter(|(motion, _)| motion.numbers() == 3);
        let mut squares: Vec<f64> = all.map(|(_, white)| white.norm_squared()).collect();
        let free = (numbers - taken.sum()).max(1.0);
        let level = median(&mut squares)
            .map_or(1.0, |median| median / MEDIAN_OF_CHI_SQUARE_3 * numbers / free);
        SegmentNoise {
            pose: noise.pose.map(|v| v * level),
            walk: noise.walk.map(|v| v * level),
            heading: noise.heading * level,
            stamp: noise.stamp * level,
        }
    }
}

/// Logarithms of the variances of a noise.
pub fn variances_of(noise: &SegmentNoise) -> Variances {
    Variances::from(noise.variances()).map(|variance| variance.max(f64::MIN_POSITIVE).ln())
}

/// Mean square of the twist at the last poses of motions: forward ((m/s)²), left ((m/s)²), yaw
/// ((rad/s)²).
pub fn mean_squares(motions: &[Seen]) -> [f64; 3] {
    let square =
        |axis: usize| -> f64 { motions.iter().map(|motion| motion.twists[1][(axis, axis)]).sum() };
    [0, 1, 2].map(|axis| square(axis) / real(motions.len().max(1)))
}

/// Degrees of freedom that a fit of columns X takes from each variance v of a noise; zero where the
/// columns are not independent. `white` are the columns L⁻¹ X, and `transposed` multiplies a column
/// by L⁻ᵀ in place: V = L Lᵀ is the covariance, zero columns of L⁻¹ those of lost motions.
///
/// # Law
/// −∂ ln det(Xᵀ V⁻¹ X)/∂ ln v = v Σ uᵀ ∂V/∂v u, summed over u = L⁻ᵀ q, with q an orthonormal basis
/// of the columns of L⁻¹ X.
pub fn taken(
    noise: &SegmentNoise,
    motions: &[Seen],
    white: &[Vec<Vector3<f64>>],
    transposed: impl Fn(&mut [Vector3<f64>]) + Sync,
) -> Variances {
    let basis = orthonormal(white);
    let squares = basis.into_par_iter().map(|mut column| {
        transposed(&mut column);
        Variances::from(SegmentNoise::squares(motions, &column))
    });
    let squares: Vec<Variances> = squares.collect();
    let sum: Variances = squares.iter().sum();
    sum.component_mul(&Variances::from(noise.variances()))
}

/// An orthonormal basis of some columns; none where they are not independent.
fn orthonormal(columns: &[Vec<Vector3<f64>>]) -> Vec<Vec<Vector3<f64>>> {
    let norm = |column: &[Vector3<f64>]| -> f64 {
        column.iter().map(Vector3::norm_squared).sum::<f64>().sqrt()
    };
    let rows = columns.first().map_or(0, Vec::len);
    let mut all = DMatrix::zeros(3 * rows, columns.len());
    for (mut place, column) in all.column_iter_mut().zip(columns) {
        let inverse = norm(column).recip();
        for (k, value) in column.iter().enumerate() {
            place.fixed_rows_mut::<3>(3 * k).copy_from(&(value * inverse));
        }
    }
    // Xᵀ X = R Rᵀ, Q = X R⁻ᵀ
    let Some(factor) = (all.transpose() * &all).cholesky() else { return Vec::new() };
    let Some(inverse) = factor.l().try_inverse() else { return Vec::new() };
    let basis = all * inverse.transpose();
    let column = |k: usize| -> Vec<Vector3<f64>> {
        let column = basis.column(k);
        (0..rows).map(|row| column.fixed_rows::<3>(3 * row).into_owned()).collect()
    };
    (0..columns.len()).map(column).collect()
}

/// A column with zeros where motions are lost.
fn without_lost(column: &[Vector3<f64>], motions: &[Seen]) -> Vec<Vector3<f64>> {
    let values = column.iter().zip(motions);
    values.map(|(v, motion)| if motion.is_lost { Vector3::zeros() } else { *v }).collect()
}

/// Likelihood of the noise of residuals.
struct Likelihood<'a> {
    by: &'a Search,
    motions: &'a [Seen],
    residual: &'a [Vector3<f64>],
}

impl Likelihood<'_> {
    /// White pose noise that would explain all residuals: two poses meet in a segment.
    fn white_alone(&self) -> SegmentNoise {
        let pose = [0, 1, 2].map(|axis| {
            let pairs = self.motions.iter().zip(self.residual);
            let seen = pairs.filter(|(motion, _)| axis == 2 || motion.has_place[1]);
            let squares = seen.map(|(_, residual)| residual[axis].powi(2));
            let median = median(&mut squares.collect::<Vec<_>>()).unwrap_or_default();
            (median / MEDIAN_OF_CHI_SQUARE / 2.0).max(f64::MIN_POSITIVE)
        });
        SegmentNoise { pose, walk: [0.0; 3], heading: 0.0, stamp: 0.0 }
    }

    /// Where to start with errors of the stamps, from a maximum without: at `stamp` (s²), or where
    /// they would be a share of the white noise forward.
    fn with_stamps(&self, mut here: Variances, stamp: f64) -> Variances {
        let [forward, ..] = mean_squares(self.motions);
        let share = self.by.start_stamp * here[0].exp() / forward.max(f64::MIN_POSITIVE);
        here[STAMP] = if stamp > 0.0 { stamp } else { share }.max(f64::MIN_POSITIVE).ln();
        here
    }

    fn white(&self, noise: &SegmentNoise) -> (Whitener, Vec<Vector3<f64>>) {
        let motions = self.motions.iter().copied();
        let whitener = Whitener::of_motions(&Weighting::Noise(*noise), motions);
        let mut white = without_lost(self.residual, self.motions);
        whitener.whiten(&mut white);
        (whitener, white)
    }

    /// Log-likelihood of each segment.
    fn terms(&self, variances: &Variances) -> Vec<f64> {
        let (whitener, white) = self.white(&self.by.noise_of(variances));
        let segments = self.motions.iter().zip(white).zip(whitener.ln_determinants());
        segments
            .map(|((motion, z), ln_determinant)| {
                let is_nothing = motion.is_lost || z == Vector3::zeros();
                let (square, tails) = (z.norm_squared(), self.by.tails);
                let likelihood = || heavy_tailed(ln_determinant, square, motion.numbers(), tails);
                if is_nothing { 0.0 } else { likelihood() }
            })
            .collect()
    }
}
