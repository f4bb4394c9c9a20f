//! A space of whitened columns, by an orthonormal basis.

use nalgebra::{DMatrix, DVector};

/// Largest share of a column outside a space that counts as rounding: such a column adds nothing.
const MAX_DEPENDENT_SHARE: f64 = 1e-6;

/// What is spanned by some columns.
#[derive(Clone, Debug)]
pub(crate) struct Subspace {
    /// Orthonormal columns; none where nothing is spanned.
    basis: Option<DMatrix<f64>>,
}

impl Subspace {
    /// The space of these columns.
    pub(crate) fn spanned_by<'a>(columns: impl IntoIterator<Item = &'a [f64]>) -> Self {
        Self { basis: None }.with(columns)
    }

    /// The space with these columns as well, by a thin QR decomposition with pivots of what they
    /// have outside it. Columns count by their direction, whatever their length.
    pub(crate) fn with<'a>(&self, columns: impl IntoIterator<Item = &'a [f64]>) -> Self {
        let new: Vec<DVector<f64>> = columns
            .into_iter()
            .filter_map(|column| {
                let column = DVector::from_column_slice(column);
                let length = column.norm();
                let is_usable = length > 0.0 && length.is_finite();
                is_usable.then(|| self.left_of(column) / length)
            })
            .collect();
        if new.is_empty() {
            return self.clone();
        }
        let decomposition = DMatrix::from_columns(&new).col_piv_qr();
        let shares = decomposition.r().diagonal();
        // pivots make the shares fall
        let rank = shares.iter().take_while(|share| share.abs() > MAX_DEPENDENT_SHARE).count();
        let axes = decomposition.q();
        let old = self.basis.iter().flat_map(DMatrix::column_iter);
        let all: Vec<_> = old.chain(axes.column_iter().take(rank)).collect();
        Self { basis: (!all.is_empty()).then(|| DMatrix::from_columns(&all)) }
    }

    /// What is left of a column outside the space; taken away twice, for rounding.
    fn left_of(&self, mut column: DVector<f64>) -> DVector<f64> {
        if let Some(basis) = &self.basis {
            for _ in 0..2 {
                let shares = basis.tr_mul(&column);
                column.gemv(-1.0, basis, &shares, 1.0);
            }
        }
        column
    }

    /// Length of what is left of a column outside the space.
    pub(crate) fn outside(&self, column: &[f64]) -> f64 {
        self.left_of(DVector::from_column_slice(column)).norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_is_perpendicular_and_what_is_spanned_is_gone() {
        let columns = [[1.0, 1.0, 0.0, 0.0], [2.0, 1.0, 1.0, 0.0], [1e-9, 0.0, 1e-9, 0.0]];
        let in_turn = columns
            .iter()
            .fold(Subspace::spanned_by([]), |space, column| space.with([column.as_slice()]));
        let at_once = Subspace::spanned_by(columns.iter().map(<[f64; 4]>::as_slice));
        for space in [in_turn, at_once] {
            assert_eq!(space.basis.as_ref().map(DMatrix::ncols), Some(2));
            assert!(space.outside(&[5.0, 3.0, 2.0, 0.0]) < 1e-14);
            // (1, 0, 0, 2) leaves (1, −1, −1, 6)/3
            let left = space.outside(&[1.0, 0.0, 0.0, 2.0]);
            assert!((left - 39.0_f64.sqrt() / 3.0).abs() < 1e-14);
        }
        assert!((Subspace::spanned_by([]).outside(&[3.0, 4.0]) - 5.0).abs() < 1e-14);
    }
}
