//! Residuals that come and go in waves: of the ground, and of the belts.

mod belts;
mod ground;

use super::IcrColumns;
use crate::fit::Fit;
use crate::resampling::Resampling;
use crate::settings;
use crate::significance::{Group, Test, test_family};
use crate::weighted::Weighted;
use faer::Mat;
use nalgebra::{DMatrix, DVector, Vector3};
use rayon::prelude::*;
use std::ops::Range;
use trackdyn_model::effect::Symmetry;

/// A wave, with its test, family-wise over all waves of its kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Wavelength, m.
    pub length: f64,
    /// What it runs along.
    pub along: Along,
    /// Its test.
    pub test: Test,
}

/// What a wave runs along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Along {
    /// The ground.
    Ground {
        /// Direction of the wave vector in the frame of the poses, rad, from −π/2 to π/2.
        direction: f64,
    },
    /// The way of the belts, as the encoders show it.
    Belts,
}

impl Along {
    /// The symmetry that such waves break.
    pub fn symmetry(self) -> Symmetry {
        match self {
            Self::Ground { .. } => Symmetry::Place,
            Self::Belts => Symmetry::Transient,
        }
    }
}

/// A kind of waves: those that evidence can resolve, beside a fit and its Jacobian by the ICRs;
/// none where it shows no such waves.
type Kind = for<'a> fn(&'a Weighted, &Fit, &IcrColumns) -> Option<Resolved<'a>>;

/// All kinds of waves.
pub const KINDS: [Kind; 2] = [ground::resolved, belts::resolved];

/// Waves that evidence can resolve.
pub struct Resolved<'a> {
    evidence: &'a Weighted,
    /// Their lengths, m, and what they run along.
    waves: Vec<(f64, Along)>,
    /// Columns of a wave, not whitened.
    columns: Box<dyn Fn(usize) -> Vec<Vec<Vector3<f64>>> + Sync + 'a>,
    /// Parts of the evidence in which a wave has sizes of its own.
    parts: Vec<Part>,
}

/// Neighbouring samples, and the blocks that they make up.
struct Part {
    samples: Range<usize>,
    blocks: Range<usize>,
}

impl Resolved<'_> {
    /// The most significant wave in what is left of a residual.
    pub fn strongest(&self, remainder: &Remainder, resampling: Resampling) -> Option<Wave> {
        let evidence = self.evidence;
        let groups: Vec<Group> = (0..self.waves.len())
            .into_par_iter()
            .map(|wave| {
                let columns = (self.columns)(wave).into_iter();
                let columns: Vec<_> = columns.map(|column| evidence.white(column)).collect();
                remainder.group(&columns, &self.parts, &evidence.settings().location)
            })
            .collect();
        let tests = self.waves.iter().zip(test_family(&groups, resampling));
        let waves = tests.map(|(&(length, along), test)| Wave { length, along, test });
        waves.reduce(|best, wave| if wave.test.is_stronger(&best.test) { wave } else { best })
    }
}

/// A residual with the other columns projected out, and the square roots of the sample weights.
pub struct Remainder {
    roots: Vec<f64>,
    blocks: Vec<Range<usize>>,
    /// Orthonormal basis of the other columns.
    beside: DMatrix<f64>,
    residual: DVector<f64>,
}

impl Remainder {
    /// What columns leave of a residual that they may explain; both are whitened.
    pub fn new(
        evidence: &Weighted,
        residual: &[Vector3<f64>],
        beside: &[Vec<Vector3<f64>>],
    ) -> Self {
        let weights = evidence.weights(residual);
        let roots: Vec<f64> = weights.into_iter().map(f64::sqrt).collect();
        let flat = |column: &[Vector3<f64>]| {
            let values = column.iter().zip(&roots).flat_map(|(value, root)| {
                let value = value * *root;
                [value.x, value.y, value.z]
            });
            DVector::from_iterator(3 * column.len(), values)
        };
        let columns: Vec<DVector<f64>> = beside.iter().map(|column| flat(column)).collect();
        let mut residual = flat(residual);
        let beside = orthonormal_basis(&columns, residual.len());
        residual -= &beside * beside.tr_mul(&residual);
        let mut blocks = vec![Range { start: usize::MAX, end: 0 }; evidence.blocks()];
        for (k, sample) in evidence.samples().iter().enumerate() {
            let block: &mut Range<usize> = &mut blocks[sample.block];
            *block = block.start.min(3 * k)..3 * k + 3;
        }
        Self { roots, blocks, beside, residual }
    }

    /// Scores of columns, each part of the samples with sizes of its own.
    fn group(
        &self,
        columns: &[Vec<Vector3<f64>>],
        parts: &[Part],
        settings: &settings::Location,
    ) -> Group {
        let scores = |part: &Part| {
            let Range { start, end } = part.samples;
            let mut matrix = DMatrix::zeros(3 * (end - start), columns.len());
            for (c, column) in columns.iter().enumerate() {
                let weighted = column[start..end].iter().zip(&self.roots[start..end]);
                for (k, (value, root)) in weighted.enumerate() {
                    matrix.fixed_view_mut::<3, 1>(3 * k, c).copy_from(&(value * *root));
                }
            }
            let beside = self.beside.rows(3 * start, 3 * (end - start));
            matrix -= beside * beside.tr_mul(&matrix);
            let blocks = self.blocks[part.blocks.clone()].iter().map(|rows| {
                let (first, count) = (rows.start.min(rows.end), rows.len());
                let of = matrix.rows(first.saturating_sub(3 * start), count);
                (of.tr_mul(&self.residual.rows(first, count)), of.tr_mul(&of))
            });
            (part.blocks.start, blocks.collect())
        };
        Group::of_parts(&parts.iter().map(scores).collect::<Vec<_>>(), settings)
    }
}

/// An orthonormal basis of what columns of this length span, by QR decomposition with pivots.
fn orthonormal_basis(columns: &[DVector<f64>], length: usize) -> DMatrix<f64> {
    /// Part of a column's length that must stand out of those before it.
    const MIN_INDEPENDENT: f64 = 1e-6;
    let lengths: Vec<f64> = columns.iter().map(DVector::norm).collect();
    let unit: Vec<usize> = (0..columns.len()).filter(|&k| lengths[k] > 0.0).collect();
    let matrix =
        Mat::from_fn(length, unit.len(), |row, k| columns[unit[k]][row] / lengths[unit[k]]);
    let decomposition = matrix.col_piv_qr();
    let (basis, triangle) = (decomposition.compute_thin_Q(), decomposition.thin_R());
    let sizes = (0..length.min(unit.len())).map(|k| triangle[(k, k)].abs());
    let rank = sizes.take_while(|size| *size > MIN_INDEPENDENT).count();
    DMatrix::from_fn(length, rank, |row, k| basis[(row, k)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_core::real;

    #[test]
    fn a_basis_spans_its_columns_and_no_more() {
        let value = |row: usize, k: usize| real((7 * row + 3 * k * k) % 11) - 5.0;
        let column = |k: usize| DVector::from_fn(60, |row, _| value(row, k));
        let [first, second] = [column(0), column(1)];
        let columns =
            [1e-3 * &first, 1e4 * &second, &first - 2.0 * &second, DVector::zeros(60), column(2)];
        let basis = orthonormal_basis(&columns, 60);
        assert_eq!(basis.ncols(), 3);
        assert!((basis.tr_mul(&basis) - DMatrix::identity(3, 3)).amax() < 1e-12);
        for column in &columns {
            let left = column - &basis * basis.tr_mul(column);
            assert!(left.norm() <= 1e-12 * column.norm());
        }
        assert_eq!(orthonormal_basis(&[], 60).ncols(), 0);
    }
}
