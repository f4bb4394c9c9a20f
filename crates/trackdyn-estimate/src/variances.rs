//! Most likely variances, by steps in their logarithms.
//!
//! # Sources
//! Berndt, Hall, Hall, Hausman, Annals of Economic and Social Measurement 3(4), 1974 (steps);
//! Lange, Little, Taylor, Journal of the American Statistical Association 84(408), 1989 (t
//! likelihood).

use nalgebra::{Cholesky, SMatrix, SVector};
use rayon::prelude::*;
use trackdyn_core::real;

/// How to look for the maximum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Climb {
    /// Most steps.
    pub max_steps: usize,
    /// Gain of the log-likelihood at which to stop.
    pub min_gain: f64,
    /// Largest step of a logarithm.
    pub max_step: f64,
    /// Difference for derivatives by a logarithm.
    pub difference: f64,
}

/// Logarithm of a variance that is none: far below anything seen, and without a slope.
pub const LN_ZERO: f64 = -80.0;

/// Smallest and largest logarithm.
const LIMITS: [f64; 2] = [LN_ZERO, 20.0];

/// Gain of the log-likelihood that one more variance has by chance once in ten thousand times.
pub const MIN_GAIN: f64 = 7.6;

impl Climb {
    /// Local maximum of Σ terms + ½ taken·here from a start: log variances, and the value there.
    ///
    /// `terms` gives the log-likelihood of each independent part; `taken` are the degrees of
    /// freedom that a fit took from each variance.
    pub fn from<const N: usize>(
        &self,
        start: SVector<f64, N>,
        taken: &SVector<f64, N>,
        terms: impl Fn(&SVector<f64, N>) -> Vec<f64> + Sync,
    ) -> (SVector<f64, N>, f64) {
        let sum = |terms: &[f64], here: &SVector<f64, N>| {
            terms.iter().sum::<f64>() + 0.5 * taken.dot(here)
        };
        let mut here = start;
        let mut found = terms(&here);
        let mut value = sum(&found, &here);
        for _ in 0..self.max_steps {
            let step = self.step(&here, &found, taken, &terms);
            let next = [1.0, 0.4, 0.1].into_iter().find_map(|share| {
                let there = (here + step * share).map(|v| v.clamp(LIMITS[0], LIMITS[1]));
                let terms = terms(&there);
                let reached = sum(&terms, &there);
                (reached > value).then_some((there, terms, reached))
            });
            let Some((there, terms, reached)) = next else { break };
            let gain = reached - value;
            (here, found, value) = (there, terms, reached);
            if gain < self.min_gain {
                break;
            }
        }
        (here, value)
    }

    /// Step of Berndt et al.: (Σ g gᵀ)⁻¹ Σ g, with g the gradient of each term.
    fn step<const N: usize>(
        &self,
        here: &SVector<f64, N>,
        terms: &[f64],
        taken: &SVector<f64, N>,
        of: &(impl Fn(&SVector<f64, N>) -> Vec<f64> + Sync),
    ) -> SVector<f64, N> {
        let there = (0..N).into_par_iter().map(|k| {
            let mut moved = *here;
            moved[k] += self.difference;
            of(&moved)
        });
        let there: Vec<Vec<f64>> = there.collect();
        let mut information = SMatrix::<f64, N, N>::identity() * 1e-3;
        let mut gradient = taken * 0.5;
        for (index, term) in terms.iter().enumerate() {
            let by = |k: usize, _| (there[k][index] - term) / self.difference;
            let g = SVector::<f64, N>::from_fn(by);
            gradient += g;
            information += g * g.transpose();
        }
        let step = Cholesky::new(information).map_or(gradient, |factor| factor.solve(&gradient));
        step.map(|value| value.clamp(-self.max_step, self.max_step))
    }
}

/// Log-likelihood of a whitened residual z of d numbers with ln det L⁻¹, by a t distribution of d
/// dimensions with ν degrees of freedom, up to a constant: ln det L⁻¹ − (ν + d)/2 ln(1 + |z|²/ν).
pub fn heavy_tailed(ln_determinant: f64, square: f64, numbers: usize, degrees: f64) -> f64 {
    ln_determinant - 0.5 * (degrees + real(numbers)) * (square / degrees).ln_1p()
}
