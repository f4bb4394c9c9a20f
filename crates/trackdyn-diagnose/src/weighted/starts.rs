//! Motion with which runs begin, as noise that the samples of a run share.
//!
//! # Law
//! The samples of a run have the covariance L Lᵀ + B Bᵀ, with L of the noise and B their change by
//! the twist at the beginning, each column times its prior deviation. With b = L⁻¹ B and
//! bᵀ b = V Λ Vᵀ, the directions Q = b V Λ^−½ are made smaller, and all others stay:
//!
//! ```text
//! (1 + b bᵀ)^−½ = 1 − Q (1 − (1 + Λ)^−½) Qᵀ
//! ```

use crate::equations::Column;
use crate::evidence::{Sample, run_ranges};
use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use std::ops::Range;

/// Least eigenvalue Λ of a direction that the beginnings of the runs change.
const MIN_EIGENVALUE: f64 = 1e-9;

/// What unknown beginnings of the runs do to whitened residuals.
pub struct Starts {
    runs: Vec<Run>,
}

/// Directions in which one run may depart, whitened by the noise alone.
struct Run {
    samples: Range<usize>,
    directions: Vec<Direction>,
}

/// An orthonormal direction.
struct Direction {
    /// Column of Q.
    along: Column,
    /// √(1 + λ).
    stretched: f64,
}

impl Starts {
    /// From the columns b of all runs, whitened by the noise alone; each row belongs to the run of
    /// its sample.
    pub fn new(samples: &[Sample], columns: &[Column; 3]) -> Self {
        let runs = run_ranges(samples)
            .map(|samples| Run { directions: directions(&samples, columns), samples });
        Self { runs: runs.collect() }
    }

    /// Multiplies a column that the noise alone has whitened by (1 + b bᵀ)^−½, in place.
    pub fn whiten(&self, column: &mut [Vector3<f64>]) {
        self.scale(column, f64::recip);
    }

    /// The inverse of [`Starts::whiten`], in place.
    pub fn colour(&self, column: &mut [Vector3<f64>]) {
        self.scale(column, |stretched| stretched);
    }

    fn scale(&self, column: &mut [Vector3<f64>], by: impl Fn(f64) -> f64) {
        for Run { samples, directions } in &self.runs {
            let column = &mut column[samples.clone()];
            for Direction { along, stretched } in directions {
                let part: f64 = along.iter().zip(&*column).map(|(q, value)| q.dot(value)).sum();
                let change = part * (by(*stretched) - 1.0);
                for (value, q) in column.iter_mut().zip(along) {
                    *value += q * change;
                }
            }
        }
    }

    /// −½ ln det(1 + b bᵀ), summed over the runs: what it costs that their beginnings are unknown.
    pub fn ln_determinant(&self) -> f64 {
        let all = self.runs.iter().flat_map(|run| &run.directions);
        -all.map(|direction| direction.stretched.ln()).sum::<f64>()
    }
}

fn directions(samples: &Range<usize>, columns: &[Column; 3]) -> Vec<Direction> {
    let b: [&[Vector3<f64>]; 3] = columns.each_ref().map(|column| &column[samples.clone()]);
    let product =
        |i: usize, k: usize| -> f64 { b[i].iter().zip(b[k]).map(|(x, y)| x.dot(y)).sum() };
    // bᵀ b = V Λ Vᵀ
    let SymmetricEigen { eigenvalues, eigenvectors } = Matrix3::from_fn(product).symmetric_eigen();
    let felt = (0..3).filter(|&k| eigenvalues[k] > MIN_EIGENVALUE);
    felt.map(|k| {
        // q = b v λ^−½
        let turned = eigenvectors.column(k) / eigenvalues[k].sqrt();
        let along = (0..samples.len()).map(|row| (0..3).map(|i| b[i][row] * turned[i]).sum());
        Direction { along: along.collect(), stretched: (1.0 + eigenvalues[k]).sqrt() }
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use trackdyn_core::{PerSide, Pose, real};

    fn sample(run: usize) -> Sample {
        Sample {
            run,
            block: 0,
            start: 0.0,
            duration: 1.0,
            motion: Vector3::zeros(),
            pose: Pose::default(),
            speeds: PerSide::default(),
            acceleration: PerSide::default(),
            follows: false,
            has_place: [true; 2],
        }
    }

    /// Against dense matrices: both whitenings give the same squares, and the same determinant.
    #[test]
    fn squares_and_determinant_are_those_of_the_whole_covariance() {
        let samples: Vec<Sample> = [0, 0, 0, 2, 2].map(sample).into();
        let column = |k: usize| -> Column {
            let value = |row: usize, c: usize| (real(7 * row + 3 * c + 5 * k)).sin();
            (0..5).map(|row| Vector3::from_fn(|c, _| value(row, c))).collect()
        };
        let columns = [column(1), column(2), column(3)];
        let starts = Starts::new(&samples, &columns);
        let residual = column(9);
        let mut white = residual.clone();
        starts.whiten(&mut white);
        let (mut square, mut ln_det) = (0.0, 0.0);
        for run in [0..3, 3..5] {
            let flat = |column: &Column| -> Vec<f64> {
                column[run.clone()].iter().flat_map(|row| row.iter().copied()).collect()
            };
            let b = columns.each_ref().map(|column| DVector::from(flat(column)));
            let b = DMatrix::from_columns(&b);
            let whole = DMatrix::identity(b.nrows(), b.nrows()) + &b * b.transpose();
            let r = DVector::from(flat(&residual));
            ln_det -= 0.5 * whole.determinant().ln();
            square += r.dot(&whole.cholesky().expect("positive").solve(&r));
        }
        let found: f64 = white.iter().map(Vector3::norm_squared).sum();
        assert!((found - square).abs() < 1e-12 * square, "{found} {square}");
        assert!((starts.ln_determinant() - ln_det).abs() < 1e-12, "{ln_det}");
        starts.colour(&mut white);
        let off = white.iter().zip(&residual).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        assert!(off < 1e-12, "{off}");
    }
}
