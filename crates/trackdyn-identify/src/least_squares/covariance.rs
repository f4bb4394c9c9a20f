//! Uncertainty from the scatter between blocks of consecutive segments.

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, StudentsT};
use trackdyn_core::real;

/// Covariance of an estimate by leaving out each block: (B − 1)/B Σ δᵦ δᵦᵀ, with the change
/// δᵦ = (H − Hᵦ)⁻¹ gᵦ of one Newton step without block b, whose share of the normal equations H is Hᵦ
/// and whose score is gᵦ.
///
/// With a robust loss H is the curvature: the second derivative of the loss, and not the weight that
/// stands in for it in the iteration.
///
/// # Sources
/// M-estimates: Huber, Ronchetti, Robust Statistics, 2nd ed. 2009, chapter 7. The block jackknife: Bell, McCaffrey, Survey Methodology 28(2), 2002 (CR3). Unlike the plain sandwich
/// it does not shrink where single blocks steer the estimate, as manoeuvres do.
pub fn jackknife(curvature: &DMatrix<f64>, parts: &[(DMatrix<f64>, DVector<f64>)]) -> DMatrix<f64> {
    let count = curvature.nrows();
    let scatter = parts.iter().fold(DMatrix::zeros(count, count), |sum, (part, score)| {
        let change = super::identifiability::inverse(&(curvature - part)) * score;
        sum + &change * change.transpose()
    });
    let blocks = real(parts.len());
    scatter * ((blocks - 1.0) / blocks)
}

/// A number with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The estimate.
    pub value: f64,
    /// Its standard deviation.
    pub deviation: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// Student's interval of a number by the numbers with one block left out each; none with fewer than two.
    ///
    /// σ² = (B − 1)/B Σ (θ₋ᵦ − θ̄)²
    pub(crate) fn of_jackknife(value: f64, without: &[f64]) -> Option<Self> {
        if without.len() < 2 {
            return None;
        }
        let blocks = real(without.len());
        let mean = without.iter().sum::<f64>() / blocks;
        let scatter: f64 = without.iter().map(|value| (value - mean).powi(2)).sum();
        let deviation = (scatter * (blocks - 1.0) / blocks).sqrt();
        Some(Self::new(value, deviation, without.len(), 1)).filter(|_| deviation.is_finite())
    }

    /// Student's interval with as many degrees of freedom as blocks exceed parameters.
    pub fn new(value: f64, deviation: f64, blocks: usize, parameters: usize) -> Self {
        let freedom = real(blocks.saturating_sub(parameters).max(1));
        let quantile =
            StudentsT::new(0.0, 1.0, freedom).map_or(1.96, |student| student.inverse_cdf(0.975));
        let half = quantile * deviation;
        Self { value, deviation, low: value - half, high: value + half }
    }
}
