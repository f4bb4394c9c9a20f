//! Normal equations, summed block by block.
//!
//! All that a linear model of the residuals can say is in the products of its columns. Kept per
//! block, they answer at once what a fit without some columns, without some blocks, or with other
//! blocks would be.

mod scaled;

pub use scaled::Scaled;

use nalgebra::{DMatrix, DVector, Vector3};
use rayon::prelude::*;
use std::ops::Range;

/// Residuals and columns, both whitened, three rows per sample.
pub struct Columns<'a> {
    /// The residuals.
    pub residual: &'a [Vector3<f64>],
    /// Derivatives of the prediction.
    pub columns: &'a [Vec<Vector3<f64>>],
    /// What each sample counts: less than one where it lies far out.
    pub weights: &'a [f64],
    /// Block of each sample.
    pub blocks: &'a [usize],
    /// Number of blocks.
    pub count: usize,
}

/// Products of columns and residual, per block and in all; the residual stands last.
#[derive(Clone, Debug)]
pub struct Normal {
    blocks: Vec<DMatrix<f64>>,
    total: DMatrix<f64>,
}

/// A linear fit: θ minimises |r − C θ|² + Σ (θ − m)²/s².
#[derive(Clone, Debug)]
pub struct Solution {
    /// θ, in the order of the columns asked for.
    pub estimate: DVector<f64>,
    /// Its covariance if noise and priors are what they are taken for.
    pub covariance: DMatrix<f64>,
    /// The minimum.
    pub misfit: f64,
    /// By how much it lies below θ = 0.
    pub gain: f64,
    /// ln det(1 + S J S), twice the logarithm of Occam's factor: what it costs that the factors
    /// were not known before.
    pub occam: f64,
    /// −½ minimum − ½ ln det(1 + S J S): the logarithm of the evidence up to what all models share.
    pub ln_evidence: f64,
}

/// What is known of a column's factor beforehand: normal with this mean and standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prior {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub deviation: f64,
    /// Logarithm of the part of it that lies where the factor can be: the density is larger by
    /// that.
    pub ln_mass: f64,
}

impl Prior {
    /// A normal prior wherever the factor is.
    pub fn normal(mean: f64, deviation: f64) -> Self {
        Self { mean, deviation, ln_mass: 0.0 }
    }

    /// Nothing is known: of no unknown is the scale anywhere near as large.
    pub fn flat() -> Self {
        Self::normal(0.0, 1e9)
    }

    /// This prior within a range.
    pub fn within(self, [low, high]: [f64; 2]) -> Self {
        let below = |end: f64| {
            0.5 * statrs::function::erf::erfc(
                (self.mean - end) / self.deviation / std::f64::consts::SQRT_2,
            )
        };
        Self { ln_mass: (below(high) - below(low)).ln(), ..self }
    }

    /// An even density over a width, whose standard deviation is left as wide as that.
    pub fn even(mean: f64, width: f64) -> Self {
        // a normal density of this deviation is 1/√(2π) of the even one at its middle
        let ln_mass = -0.5 * std::f64::consts::TAU.ln();
        Self { mean, deviation: width, ln_mass }
    }
}

/// Part of its own square by which a column may differ from others and still be taken for them.
const RIDGE: f64 = 1e-10;

/// Part of its own square that a column must have beyond others not to be a combination of them.
const DEPENDENT: f64 = 1e-8;

/// Part of its own square that is left of a column where others explain all of it but rounding.
const EXPLAINED: f64 = 1e-10;

impl Normal {
    /// The products of these columns.
    pub fn new(of: &Columns) -> Self {
        let size = of.columns.len() + 1;
        let mut samples = vec![Vec::new(); of.count];
        for (sample, &block) in of.blocks.iter().enumerate() {
            if of.weights[sample] != 0.0 {
                samples[block].push(sample);
            }
        }
        let blocks: Vec<DMatrix<f64>> = samples
            .par_iter()
            .map(|samples| {
                // √W (C, r), a column of the matrix for each column and the residual
                let mut rows = DMatrix::zeros(3 * samples.len(), size);
                for (k, column) in
                    of.columns.iter().map(Vec::as_slice).chain([of.residual]).enumerate()
                {
                    let mut places = rows.column_mut(k);
                    for (place, &sample) in samples.iter().enumerate() {
                        let value = column[sample] * of.weights[sample].sqrt();
                        places.fixed_rows_mut::<3>(3 * place).copy_from(&value);
                    }
                }
                rows.transpose() * rows
            })
            .collect();
        let total = sum(&blocks, size);
        Self { blocks, total }
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.total.nrows() - 1
    }

    /// Number of blocks.
    pub fn blocks(&self) -> usize {
        self.blocks.len()
    }

    /// Products of all blocks; the residual stands last.
    pub fn total(&self) -> &DMatrix<f64> {
        &self.total
    }

    /// Products of a block; the residual stands last.
    pub fn block(&self, block: usize) -> &DMatrix<f64> {
        &self.blocks[block]
    }

    /// Sum of the squared residuals.
    pub fn squares(&self) -> f64 {
        self.total[(self.columns(), self.columns())]
    }

    /// These equations with each block counted this many times.
    pub fn counted(&self, times: &[f64]) -> Self {
        let blocks: Vec<DMatrix<f64>> =
            self.blocks.iter().zip(times).map(|(block, times)| block * *times).collect();
        let total = sum(&blocks, self.total.nrows());
        Self { blocks, total }
    }

    /// These equations without some blocks: what is fitted on the others is judged on these.
    pub fn without(&self, held_out: &Range<usize>) -> Self {
        let times: Vec<f64> = (0..self.blocks.len())
            .map(|block| if held_out.contains(&block) { 0.0 } else { 1.0 })
            .collect();
        self.counted(&times)
    }

    /// The fit of some columns.
    pub fn fit(&self, columns: &[usize], priors: &[Prior]) -> Solution {
        let count = columns.len();
        let last = self.columns();
        let mut matrix = DMatrix::zeros(count, count);
        let mut gradient = DVector::zeros(count);
        let mut penalty = 0.0;
        for (a, &i) in columns.iter().enumerate() {
            for (b, &j) in columns.iter().enumerate() {
                matrix[(a, b)] = self.total[(i, j)];
            }
            let Prior { mean, deviation, .. } = priors[i];
            let precision = deviation.powi(-2);
            matrix[(a, a)] += precision;
            gradient[a] = self.total[(i, last)] + precision * mean;
            penalty += precision * mean * mean;
        }
        let (estimate, covariance, ln_det) = match Scaled::new(&matrix) {
            Some(factor) => (factor.solve(&gradient), factor.inverse(), factor.ln_det()),
            None => (
                DVector::zeros(count),
                DMatrix::from_diagonal_element(count, count, f64::INFINITY),
                f64::INFINITY,
            ),
        };
        let gain = gradient.dot(&estimate);
        let misfit = self.squares() + penalty - gain;
        // det(1 + S J S) = det(J + S⁻²) · Π s²; densities that end where a factor cannot be are
        // larger by what they leave out
        let occam: f64 = ln_det
            + columns
                .iter()
                .map(|&i| 2.0 * (priors[i].deviation.ln() + priors[i].ln_mass))
                .sum::<f64>();
        let ln_evidence = -0.5 * (misfit + occam);
        Solution { estimate, covariance, misfit, gain, occam, ln_evidence }
    }

    /// Squared residuals of a block at given factors of some columns.
    pub fn squares_at(&self, block: usize, columns: &[usize], factors: &DVector<f64>) -> f64 {
        let (products, last) = (&self.blocks[block], self.columns());
        let crossed: f64 =
            columns.iter().zip(factors.iter()).map(|(&i, by)| by * products[(i, last)]).sum();
        products[(last, last)] - 2.0 * crossed + self.change_at(block, columns, factors)
    }

    /// Squared change of a block's prediction by factors of some columns.
    pub fn change_at(&self, block: usize, columns: &[usize], factors: &DVector<f64>) -> f64 {
        let products = &self.blocks[block];
        let mut squares = 0.0;
        for (a, &i) in columns.iter().enumerate() {
            for (b, &j) in columns.iter().enumerate() {
                squares += factors[a] * factors[b] * products[(i, j)];
            }
        }
        squares
    }

    /// Square of what is left of a column beside `others`, whose factors are known to their priors,
    /// with what these cost: min over θ of |c − C θ|² + Σ (θ/s)².
    pub fn beside(&self, column: usize, others: &[usize], priors: &[Prior]) -> f64 {
        let square = self.product(column, column);
        let precisions: Vec<f64> = others.iter().map(|&k| priors[k].deviation.powi(-2)).collect();
        let Some(factor) = self.factored(others, &precisions) else { return square };
        let right = DVector::from_fn(others.len(), |k, _| self.product(others[k], column));
        (square - right.dot(&factor.solve(&right))).max(0.0)
    }

    /// Removes from columns and residual what `base` columns explain (with their priors), block by
    /// block with the factors of the whole.
    pub fn projected(&self, base: &[usize], priors: &[Prior]) -> Self {
        let precisions: Vec<f64> = base.iter().map(|&i| priors[i].deviation.powi(-2)).collect();
        let others: Vec<usize> = (0..=self.columns()).filter(|j| !base.contains(j)).collect();
        self.without_what(base, &precisions, &others)
    }

    /// Removes from these columns, and not from the residual, what `others` explain.
    pub fn cleared(&self, columns: &[usize], others: &[usize]) -> Self {
        self.without_what(others, &vec![0.0; others.len()], columns)
    }

    /// The factor of columns' information with these precisions. Columns that stand for each other
    /// count as one.
    fn factored(&self, columns: &[usize], precisions: &[f64]) -> Option<Scaled> {
        let mut matrix = self.information(columns);
        for (k, precision) in precisions.iter().enumerate() {
            matrix[(k, k)] += precision;
        }
        Scaled::with_ridge(&matrix, RIDGE)
    }

    fn without_what(&self, base: &[usize], precisions: &[f64], of: &[usize]) -> Self {
        let size = self.total.nrows();
        let Some(factor) = self.factored(base, precisions) else { return self.clone() };
        let right = DMatrix::from_fn(base.len(), of.len(), |a, j| self.total[(base[a], of[j])]);
        let solved = factor.solve(&right);
        // T = 1 − P with P the factors of the base columns in every other column
        let mut transform = DMatrix::identity(size, size);
        for (a, &i) in base.iter().enumerate() {
            for (b, &j) in of.iter().enumerate() {
                transform[(i, j)] -= solved[(a, b)];
            }
        }
        let mut blocks: Vec<DMatrix<f64>> =
            self.blocks.iter().map(|block| transform.tr_mul(block) * &transform).collect();
        let total = sum(&blocks, size);
        // What is explained but for rounding is nothing: it has no sign, and no inverse.
        let is_gone =
            |&&k: &&usize| k < size - 1 && total[(k, k)] <= EXPLAINED * self.total[(k, k)];
        for &gone in of.iter().filter(is_gone) {
            for block in &mut blocks {
                block.row_mut(gone).fill(0.0);
                block.column_mut(gone).fill(0.0);
            }
        }
        let total = sum(&blocks, size);
        Self { blocks, total }
    }

    /// The columns that are no combination of those before them.
    pub fn independent(&self) -> Vec<usize> {
        let mut kept: Vec<usize> = Vec::new();
        // Rows of the Cholesky factor of what is kept.
        let mut rows: Vec<Vec<f64>> = Vec::new();
        for column in 0..self.columns() {
            let mut row: Vec<f64> = Vec::with_capacity(kept.len() + 1);
            for (&other, of_other) in kept.iter().zip(&rows) {
                let known: f64 = row.iter().zip(of_other).map(|(a, b)| a * b).sum();
                row.push((self.product(column, other) - known) / of_other[row.len()]);
            }
            let square = self.product(column, column);
            let own = square - row.iter().map(|part| part * part).sum::<f64>();
            if own > DEPENDENT * square {
                row.push(own.sqrt());
                rows.push(row);
                kept.push(column);
            }
        }
        kept
    }

    /// Takes out of a residual what these columns, by their places, explain of it. They must be
    /// [`independent`](Self::independent).
    pub fn take(
        &self,
        places: &[usize],
        columns: &[Vec<Vector3<f64>>],
        residual: &mut [Vector3<f64>],
    ) {
        let Some((factors, _)) = self.least_squares(places) else { return };
        for (&place, by) in places.iter().zip(factors.iter()) {
            for (left, value) in residual.iter_mut().zip(&columns[place]) {
                *left -= value * *by;
            }
        }
    }

    /// The factors of columns that leave least of the residual, and ln det of the columns'
    /// products. The columns must be [`independent`](Self::independent); none where rounding shows
    /// that they are not.
    pub fn least_squares(&self, columns: &[usize]) -> Option<(DVector<f64>, f64)> {
        let factor = Scaled::new(&self.information(columns))?;
        let last = self.columns();
        let right = DVector::from_fn(columns.len(), |a, _| self.product(columns[a], last));
        Some((factor.solve(&right), factor.ln_det()))
    }

    /// Products of columns among each other.
    pub fn information(&self, columns: &[usize]) -> DMatrix<f64> {
        DMatrix::from_fn(columns.len(), columns.len(), |a, b| self.total[(columns[a], columns[b])])
    }

    /// Product of two columns.
    pub fn product(&self, a: usize, b: usize) -> f64 {
        self.total[(a, b)]
    }
}

fn sum(blocks: &[DMatrix<f64>], size: usize) -> DMatrix<f64> {
    blocks.iter().fold(DMatrix::zeros(size, size), |sum, block| sum + block)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three columns, of which the last is the sum of the others, and one of nothing.
    #[test]
    fn what_columns_explain_hangs_on_the_independent_ones_alone() {
        const SAMPLES: usize = 40;
        let value = |sample: usize, k: usize| trackdyn_core::real((7 * sample + 3 * k) % 11);
        let column = |k: usize| -> Vec<Vector3<f64>> {
            (0..SAMPLES).map(|sample| Vector3::from_fn(|c, _| value(sample, 3 * k + c))).collect()
        };
        let [first, second, other] = [0, 1, 2].map(column);
        let both: Vec<_> = first.iter().zip(&second).map(|(a, b)| a + b).collect();
        let residual: Vec<_> = both.iter().zip(&other).map(|(a, b)| 2.0 * a + 0.1 * b).collect();
        let columns = vec![first, second, both, vec![Vector3::zeros(); SAMPLES]];
        let normal = Normal::new(&Columns {
            residual: &residual,
            columns: &columns,
            weights: &[1.0; SAMPLES],
            blocks: &[0; SAMPLES],
            count: 1,
        });
        let independent = normal.independent();
        assert_eq!(independent, [0, 1]);
        let (factors, ln_det) = normal.least_squares(&independent).expect("independent");
        let [a, b, c] = [(0, 0), (0, 1), (1, 1)].map(|(i, j)| normal.product(i, j));
        assert!((ln_det - (a * c - b * b).ln()).abs() < 1e-9, "{ln_det}");
        assert_eq!(factors.len(), 2);
        // what all of a column is explained by leaves nothing at all of it, in no block and no
        // product
        let flat = [Prior::flat(); 4];
        let projected = normal.projected(&[0, 1], &flat);
        assert_eq!((0..=4).map(|k| projected.product(2, k).abs()).fold(0.0, f64::max), 0.0);
        // min over θ of |c − C θ|² + (θ/s)² = |c|² − (c·C)²/(|C|² + 1/s²)
        let known = [Prior::normal(0.0, 0.1); 4];
        let expected = a - b * b / (c + 100.0);
        assert!((normal.beside(0, &[1], &known) / expected - 1.0).abs() < 1e-8);
        // a column of nothing takes nothing away
        assert!(
            (normal.beside(0, &[1, 3], &flat) / normal.beside(0, &[1], &flat) - 1.0).abs() < 1e-8
        );
        let mut left = residual.clone();
        normal.take(&independent, &columns, &mut left);
        for column in &columns {
            let product: f64 = left.iter().zip(column).map(|(left, value)| left.dot(value)).sum();
            assert!(product.abs() < 1e-6, "{product}");
        }
    }

    /// Half of a normal density about none is twice as large; an even one over a turn is what ∫
    /// exp(-θ²/2σ²) dθ/360 says.
    #[test]
    fn priors_end_where_a_factor_cannot_be() {
        let size = Prior::normal(0.0, 0.3);
        assert!((size.within([0.0, 100.0]).ln_mass - 0.5_f64.ln()).abs() < 1e-12);
        assert!(size.within([-100.0, 100.0]).ln_mass.abs() < 1e-12);
        assert!(
            (Prior::normal(20.0, 20.0).within([1.0, 20.0]).ln_mass.exp() - 0.328_94).abs() < 1e-4
        );
        // one column of information J: ln E rises by ln(√(2π/J)/360)
        let column = vec![Vector3::new(1.0, 0.0, 0.0); 100];
        let normal = Normal::new(&Columns {
            residual: &vec![Vector3::zeros(); 100],
            columns: &[column],
            weights: &[1.0; 100],
            blocks: &[0; 100],
            count: 1,
        });
        let solution = normal.fit(&[0], &[Prior::even(0.0, 360.0)]);
        let expected = (std::f64::consts::TAU / 100.0).sqrt() / 360.0;
        assert!((solution.ln_evidence - expected.ln()).abs() < 1e-6, "{}", solution.ln_evidence);
    }
}
