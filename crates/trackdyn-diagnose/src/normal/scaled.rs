//! Cholesky factor of a matrix whose rows have different units.

use nalgebra::allocator::Allocator;
use nalgebra::{Cholesky, DMatrix, DVector, DefaultAllocator, Dim, Dyn, OMatrix};

/// Cholesky factor of a positive definite matrix M, scaled to unit diagonal: L Lᵀ = S M S, S =
/// diag(M)^(−½).
pub struct Scaled {
    cholesky: Cholesky<f64, Dyn>,
    scale: DVector<f64>,
}

impl Scaled {
    /// The factor; none where the matrix is not positive definite.
    pub fn new(matrix: &DMatrix<f64>) -> Option<Self> {
        Self::with_ridge(matrix, 0.0)
    }

    /// The factor with a ridge on the scaled diagonal. Zero rows are ignored.
    pub fn with_ridge(matrix: &DMatrix<f64>, ridge: f64) -> Option<Self> {
        let scale = matrix.diagonal().map(|square| match square {
            square if square > 0.0 => square.sqrt().recip(),
            _ => 0.0,
        });
        let scaled = DMatrix::from_fn(scale.len(), scale.len(), |a, b| {
            let own = if a == b { ridge } else { 0.0 };
            matrix[(a, b)] * scale[a] * scale[b] + own
        });
        Some(Self { cholesky: scaled.cholesky()?, scale })
    }

    /// M⁻¹ times a vector or a matrix.
    pub fn solve<C: Dim>(&self, right: &OMatrix<f64, Dyn, C>) -> OMatrix<f64, Dyn, C>
    where
        DefaultAllocator: Allocator<Dyn, C>,
    {
        let mut solution = self.scaled(right.clone());
        self.cholesky.solve_mut(&mut solution);
        self.scaled(solution)
    }

    /// M⁻¹.
    pub fn inverse(&self) -> DMatrix<f64> {
        let inverse = self.cholesky.inverse();
        DMatrix::from_fn(self.scale.len(), self.scale.len(), |a, b| {
            inverse[(a, b)] * self.scale[a] * self.scale[b]
        })
    }

    /// ln det M, without a ridge.
    pub fn ln_det(&self) -> f64 {
        let diagonal = self.cholesky.l_dirty().diagonal();
        diagonal.iter().zip(self.scale.iter()).map(|(own, scale)| 2.0 * (own / scale).ln()).sum()
    }

    fn scaled<C: Dim>(&self, mut of: OMatrix<f64, Dyn, C>) -> OMatrix<f64, Dyn, C>
    where
        DefaultAllocator: Allocator<Dyn, C>,
    {
        for mut column in of.column_iter_mut() {
            column.component_mul_assign(&self.scale);
        }
        of
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows in metres, radians and parts in a thousand, whose squares differ by twelve digits.
    #[test]
    fn units_do_not_matter() {
        let units = [1e6, 1.0, 1e-6];
        let plain = DMatrix::from_row_slice(3, 3, &[4.0, 1.0, 0.5, 1.0, 3.0, -0.2, 0.5, -0.2, 2.0]);
        let matrix = DMatrix::from_fn(3, 3, |a, b| plain[(a, b)] * units[a] * units[b]);
        let factor = Scaled::new(&matrix).expect("positive");
        let solution = factor.solve(&DVector::from_fn(3, |k, _| units[k]));
        let expected = plain.clone().lu().solve(&DVector::repeat(3, 1.0)).expect("regular");
        for k in 0..3 {
            assert!((solution[k] * units[k] / expected[k] - 1.0).abs() < 1e-12, "{k}");
        }
        assert!((&factor.inverse() * &matrix - DMatrix::identity(3, 3)).norm() < 1e-3);
        assert!((factor.ln_det() - plain.determinant().ln()).abs() < 1e-12);
        assert!(Scaled::new(&DMatrix::from_element(2, 2, 1.0)).is_none());
        assert!(Scaled::with_ridge(&DMatrix::from_element(2, 2, 1.0), 1e-6).is_some());
    }
}
