//! Covariance of an estimate: inverse of a normal matrix, and scatter between blocks of consecutive
//! segments.

use faer::Mat;
use nalgebra::{DMatrix, DVector};
use trackdyn_core::real;

/// Smallest ratio of an eigenvalue to the largest: below, a direction is lost in rounding.
pub const MIN_EIGENVALUE_RATIO: f64 = 1e-13;

/// The inverse of a normal matrix, by its eigenvalues. Directions that are lost in rounding get a
/// large variance.
pub fn inverse(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let count = matrix.nrows();
    // Parameters differ in unit and size: the diagonal is scaled to 1 first.
    let scale: Vec<f64> =
        (0..count).map(|k| matrix[(k, k)].max(f64::MIN_POSITIVE).sqrt().recip()).collect();
    let scaled = Mat::from_fn(count, count, |i, k| matrix[(i, k)] * scale[i] * scale[k]);
    let Ok(decomposition) = scaled.self_adjoint_eigen(faer::Side::Lower) else {
        return DMatrix::from_element(count, count, f64::NAN);
    };
    let (values, vectors) = (decomposition.S(), decomposition.U());
    let largest = (0..count).map(|k| values[k]).fold(0.0, f64::max);
    DMatrix::from_fn(count, count, |i, k| {
        let sum: f64 = (0..count)
            .map(|m| {
                vectors[(i, m)] * vectors[(k, m)] / values[m].max(MIN_EIGENVALUE_RATIO * largest)
            })
            .sum();
        sum * scale[i] * scale[k]
    })
}

/// Covariance of an estimate by leaving out each block: (B − 1)/B Σ δᵦ δᵦᵀ, with the change δᵦ = (H
/// − Hᵦ)⁻¹ gᵦ of one Newton step without block b, whose share of the normal equations H is Hᵦ and
/// whose score is gᵦ.
///
/// With a robust loss H is the curvature: the second derivative of the loss, and not the weight
/// that stands in for it in the iteration.
///
/// # Sources
/// M-estimates: Huber, Ronchetti, Robust Statistics, 2nd ed. 2009, chapter 7. The block jackknife:
/// Bell, McCaffrey, Survey Methodology 28(2), 2002 (CR3). Unlike the plain sandwich it does not
/// shrink where single blocks steer the estimate, as manoeuvres do.
pub fn jackknife(curvature: &DMatrix<f64>, parts: &[(DMatrix<f64>, DVector<f64>)]) -> DMatrix<f64> {
    let count = curvature.nrows();
    let scatter = parts.iter().fold(DMatrix::zeros(count, count), |sum, (part, score)| {
        let change = inverse(&(curvature - part)) * score;
        sum + &change * change.transpose()
    });
    let blocks = real(parts.len());
    scatter * ((blocks - 1.0) / blocks)
}

/// The larger standard deviation of two variances; NaN where one of them is NaN.
pub fn larger_deviation([one, other]: [f64; 2]) -> f64 {
    // `max` of a number and NaN is the number
    if one.is_nan() || other.is_nan() { f64::NAN } else { one.max(other).max(0.0).sqrt() }
}

/// A covariance with these standard deviations and the correlations of another one, row by row.
pub fn with_deviations(of: &DMatrix<f64>, deviations: &[f64]) -> Vec<Vec<f64>> {
    let factor = |k: usize| {
        let variance = of[(k, k)];
        if variance > 0.0 { deviations[k] / variance.sqrt() } else { 1.0 }
    };
    let row = |i| (0..deviations.len()).map(|j| of[(i, j)] * factor(i) * factor(j)).collect();
    (0..deviations.len()).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn correlations_stay_where_deviations_are_others() {
        let of = DMatrix::from_row_slice(3, 3, &[4.0, -1.0, 7.0, -1.0, 1.0, 7.0, 7.0, 7.0, 7.0]);
        let found = with_deviations(&of, &[6.0, 2.0]);
        assert_eq!(found, [[36.0, -6.0], [-6.0, 4.0]]);
    }
}
