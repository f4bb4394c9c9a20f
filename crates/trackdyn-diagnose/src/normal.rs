//! Normal equations, summed block by block.
//!
//! A linear model of the residuals depends on the products of its columns only. Kept per block,
//! they give the fit without some columns, without some blocks, or with resampled blocks at once.

mod scaled;

pub use scaled::Scaled;

use nalgebra::{DMatrix, DVector, Vector3};
use rayon::prelude::*;
use std::ops::Range;
use trackdyn_core::real;

/// Residual and columns of a linear fit, whitened, three rows per sample.
pub struct Columns<'a> {
    /// The residual.
    pub residual: &'a [Vector3<f64>],
    /// Columns of the Jacobian of the prediction.
    pub columns: &'a [Vec<Vector3<f64>>],
    /// Weight of each sample: below one for outliers.
    pub weights: &'a [f64],
    /// Block of each sample.
    pub blocks: &'a [usize],
    /// Number of blocks.
    pub count: usize,
}

/// Products of columns and residual, per block and in total; the residual comes last.
#[derive(Clone, Debug)]
pub struct Normal {
    blocks: Vec<DMatrix<f64>>,
    total: DMatrix<f64>,
}

/// Solution of a linear fit: θ minimises |r − C θ|² + Σ (θ − m)²/s².
#[derive(Clone, Debug)]
pub struct Solution {
    /// θ, in the order of the columns asked for.
    pub estimate: DVector<f64>,
    /// Covariance of θ, if noise and priors are right.
    pub covariance: DMatrix<f64>,
    /// Value of the minimum.
    pub misfit: f64,
    /// Decrease from θ = 0 to the minimum.
    pub gain: f64,
    /// ln det(1 + S J S) = −2 ln Occam's factor, the cost of prior uncertainty; J is the
    /// information, S = diag(s).
    pub occam: f64,
    /// Log evidence up to a constant shared by all models: −½ minimum − ½ ln det(1 + S J S).
    pub ln_evidence: f64,
}

impl Solution {
    /// Rise of the minimum where these columns are moved by `by` while all others follow; ∞ where
    /// they have no covariance.
    ///
    /// dᵀ Σ⁻¹ d, Σ their covariance
    pub fn rise(&self, columns: &[usize], by: &DVector<f64>) -> f64 {
        let covariance = self.covariance.select_rows(columns).select_columns(columns);
        let solved = covariance.cholesky().map(|factor| factor.solve(by));
        solved.map_or(f64::INFINITY, |solved| by.dot(&solved))
    }
}

/// Normal prior of a column's factor, possibly truncated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prior {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub deviation: f64,
    /// Log probability of the normal within the allowed range: the truncated density is larger by
    /// the inverse.
    pub ln_mass: f64,
}

impl Prior {
    /// A normal prior without limits.
    pub fn normal(mean: f64, deviation: f64) -> Self {
        Self { mean, deviation, ln_mass: 0.0 }
    }

    /// A flat prior: wider than the scale of any unknown.
    pub fn flat() -> Self {
        Self::normal(0.0, 1e9)
    }

    /// This prior, truncated to a range.
    pub fn within(self, [low, high]: [f64; 2]) -> Self {
        let below = |end: f64| {
            0.5 * statrs::function::erf::erfc(
                (self.mean - end) / self.deviation / std::f64::consts::SQRT_2,
            )
        };
        Self { ln_mass: (below(high) - below(low)).ln(), ..self }
    }

    /// A uniform density over a width, with that width as its standard deviation.
    pub fn even(mean: f64, width: f64) -> Self {
        // at its mean, such a normal density is 1/√(2π) of the uniform one
        let ln_mass = -0.5 * std::f64::consts::TAU.ln();
        Self { mean, deviation: width, ln_mass }
    }
}

/// Effective number of parts that make up a sum of squares.
///
/// # Law
/// (Σ q)²/Σ q²: one where a single part has all of it, n where n parts are equal.
pub fn effective(squares: impl Iterator<Item = f64>) -> f64 {
    let (sum, of_squares) =
        squares.fold((0.0, 0.0), |(sum, squares), one| (sum + one, squares + one * one));
    if of_squares > 0.0 { sum * sum / of_squares } else { 0.0 }
}

/// ln of the mean of probabilities that are given by their ln; an ln that is not finite counts as
/// probability 0.
pub fn ln_mean(ln: impl Iterator<Item = f64> + Clone) -> f64 {
    let numbers = ln.clone().filter(|ln| ln.is_finite());
    let most = numbers.clone().fold(f64::MIN, f64::max);
    let sum: f64 = numbers.map(|ln| (ln - most).exp()).sum();
    most + (sum / real(ln.count())).ln()
}

/// Ridge on the scaled diagonal: columns that differ by less, relative to their square, count as
/// equal.
const RIDGE: f64 = 1e-10;

/// Least share of a column's square that must be independent of the columns before it.
const MIN_INDEPENDENT_SHARE: f64 = 1e-8;

/// Largest share of a column's square left by projection that counts as rounding.
const MAX_ROUNDING_SHARE: f64 = 1e-10;

impl Normal {
    /// Products of columns and residual.
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
                // √W (C, r): a matrix column for each column and for the residual
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

    /// Products summed over all blocks; the residual comes last.
    pub fn total(&self) -> &DMatrix<f64> {
        &self.total
    }

    /// Products of one block; the residual comes last.
    pub fn block(&self, block: usize) -> &DMatrix<f64> {
        &self.blocks[block]
    }

    /// Sum of the squared residuals.
    pub fn squares(&self) -> f64 {
        self.total[(self.columns(), self.columns())]
    }

    /// The equations with each block counted this many times.
    pub fn counted(&self, times: &[f64]) -> Self {
        let blocks: Vec<DMatrix<f64>> =
            self.blocks.iter().zip(times).map(|(block, times)| block * *times).collect();
        let total = sum(&blocks, self.total.nrows());
        Self { blocks, total }
    }

    /// The equations without some blocks, for cross-validation.
    pub fn without(&self, held_out: &Range<usize>) -> Self {
        let times: Vec<f64> = (0..self.blocks.len())
            .map(|block| if held_out.contains(&block) { 0.0 } else { 1.0 })
            .collect();
        self.counted(&times)
    }

    /// Fits the factors of some columns; all others are zero.
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
        // det(1 + S J S) = det(J + S⁻²) · Π s²; truncated priors are denser by 1/mass
        let occam: f64 = ln_det
            + columns
                .iter()
                .map(|&i| 2.0 * (priors[i].deviation.ln() + priors[i].ln_mass))
                .sum::<f64>();
        let ln_evidence = -0.5 * (misfit + occam);
        Solution { estimate, covariance, misfit, gain, occam, ln_evidence }
    }

    /// Sum of squared residuals of a block at given factors of some columns.
    pub fn squares_at(&self, block: usize, columns: &[usize], factors: &DVector<f64>) -> f64 {
        let (products, last) = (&self.blocks[block], self.columns());
        let crossed: f64 =
            columns.iter().zip(factors.iter()).map(|(&i, by)| by * products[(i, last)]).sum();
        products[(last, last)] - 2.0 * crossed + self.change_at(block, columns, factors)
    }

    /// Squared norm of the change of a block's prediction at given factors of some columns.
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

    /// Squared norm of a column beside `others`, whose factors are free within their priors: min
    /// over θ of |c − C θ|² + Σ (θ/s)².
    pub fn beside(&self, column: usize, others: &[usize], priors: &[Prior]) -> f64 {
        let square = self.product(column, column);
        let precisions: Vec<f64> = others.iter().map(|&k| priors[k].deviation.powi(-2)).collect();
        let Some(factor) = self.factored(others, &precisions) else { return square };
        let right = DVector::from_fn(others.len(), |k, _| self.product(others[k], column));
        (square - right.dot(&factor.solve(&right))).max(0.0)
    }

    /// Projects `base` columns (with their priors) out of all others and the residual; the factors
    /// are those of the total, applied to each block.
    pub fn projected(&self, base: &[usize], priors: &[Prior]) -> Self {
        let precisions: Vec<f64> = base.iter().map(|&i| priors[i].deviation.powi(-2)).collect();
        let others: Vec<usize> = (0..=self.columns()).filter(|j| !base.contains(j)).collect();
        self.projected_out(base, &precisions, &others)
    }

    /// Projects `others` out of these columns, but not out of the residual.
    pub fn cleared(&self, columns: &[usize], others: &[usize]) -> Self {
        self.projected_out(others, &vec![0.0; others.len()], columns)
    }

    /// Cholesky factor of the information of columns plus precisions. Collinear columns count once.
    fn factored(&self, columns: &[usize], precisions: &[f64]) -> Option<Scaled> {
        let mut matrix = self.information(columns);
        for (k, precision) in precisions.iter().enumerate() {
            matrix[(k, k)] += precision;
        }
        Scaled::with_ridge(&matrix, RIDGE)
    }

    fn projected_out(&self, base: &[usize], precisions: &[f64], of: &[usize]) -> Self {
        let size = self.total.nrows();
        let Some(factor) = self.factored(base, precisions) else { return self.clone() };
        let right = DMatrix::from_fn(base.len(), of.len(), |a, j| self.total[(base[a], of[j])]);
        // P, the factors of the base columns in every other column
        let factors = factor.solve(&right);
        let transposed = factors.transpose();
        let project = |block: &DMatrix<f64>| {
            // T = 1 − P: B T = B − B P, then Tᵀ (B T) = B T − Pᵀ (B T)
            let mut projected = block.clone();
            let taken = block.select_columns(base) * &factors;
            for (&k, taken) in of.iter().zip(taken.column_iter()) {
                let mut column = projected.column_mut(k);
                column -= taken;
            }
            let taken = &transposed * projected.select_rows(base);
            for (&k, taken) in of.iter().zip(taken.row_iter()) {
                let mut row = projected.row_mut(k);
                row -= taken;
            }
            projected
        };
        let mut blocks: Vec<DMatrix<f64>> = self.blocks.par_iter().map(project).collect();
        let total = sum(&blocks, size);
        // A column explained up to rounding is set to zero: its rest has no sign and no inverse.
        let is_gone =
            |&&k: &&usize| k < size - 1 && total[(k, k)] <= MAX_ROUNDING_SHARE * self.total[(k, k)];
        for &gone in of.iter().filter(is_gone) {
            for block in &mut blocks {
                block.row_mut(gone).fill(0.0);
                block.column_mut(gone).fill(0.0);
            }
        }
        let total = sum(&blocks, size);
        Self { blocks, total }
    }

    /// Columns that are not a linear combination of those before them.
    pub fn independent(&self) -> Vec<usize> {
        let mut kept: Vec<usize> = Vec::new();
        // Rows of the Cholesky factor of the kept columns.
        let mut rows: Vec<Vec<f64>> = Vec::new();
        for column in 0..self.columns() {
            let mut row: Vec<f64> = Vec::with_capacity(kept.len() + 1);
            for (&other, of_other) in kept.iter().zip(&rows) {
                let known: f64 = row.iter().zip(of_other).map(|(a, b)| a * b).sum();
                row.push((self.product(column, other) - known) / of_other[row.len()]);
            }
            let square = self.product(column, column);
            let own = square - row.iter().map(|part| part * part).sum::<f64>();
            if own > MIN_INDEPENDENT_SHARE * square {
                row.push(own.sqrt());
                rows.push(row);
                kept.push(column);
            }
        }
        kept
    }

    /// Subtracts the least-squares fit of these columns, by their indices, from a residual. They
    /// must be [`independent`](Self::independent).
    pub fn take(
        &self,
        places: &[usize],
        columns: &[Vec<Vector3<f64>>],
        residual: &mut [Vector3<f64>],
    ) {
        let Some(factors) = self.least_squares(places) else { return };
        for (&place, by) in places.iter().zip(factors.iter()) {
            for (left, value) in residual.iter_mut().zip(&columns[place]) {
                *left -= value * *by;
            }
        }
    }

    /// Least-squares factors of columns. The columns must be [`independent`](Self::independent);
    /// none where rounding shows that they are not.
    pub fn least_squares(&self, columns: &[usize]) -> Option<DVector<f64>> {
        let factor = Scaled::new(&self.information(columns))?;
        let last = self.columns();
        let right = DVector::from_fn(columns.len(), |a, _| self.product(columns[a], last));
        Some(factor.solve(&right))
    }

    /// Products of these columns with each other: their information.
    pub fn information(&self, columns: &[usize]) -> DMatrix<f64> {
        DMatrix::from_fn(columns.len(), columns.len(), |a, b| self.total[(columns[a], columns[b])])
    }

    /// Product of two columns, summed over all samples.
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

    /// Columns are those of the solution, in whatever order they are asked for.
    #[test]
    fn moved_columns_raise_the_minimum_by_their_covariance() {
        let covariance =
            DMatrix::from_row_slice(3, 3, &[4.0, 0.0, 1.0, 0.0, 9.0, 0.0, 1.0, 0.0, 1.0]);
        let solution = Solution {
            estimate: DVector::zeros(3),
            covariance,
            misfit: 0.0,
            gain: 0.0,
            occam: 0.0,
            ln_evidence: 0.0,
        };
        let rise =
            |columns: &[usize], by: &[f64]| solution.rise(columns, &DVector::from_column_slice(by));
        assert!((rise(&[1], &[6.0]) - 4.0).abs() < 1e-12);
        // (1/3) [1 -1; -1 4]
        assert!((rise(&[0, 2], &[2.0, 1.0]) - 4.0 / 3.0).abs() < 1e-12);
        assert!((rise(&[2, 0], &[1.0, 2.0]) - 4.0 / 3.0).abs() < 1e-12);
    }

    /// Three columns, the last of which is the sum of the others, and a zero column.
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
        let factors = normal.least_squares(&independent).expect("independent");
        let [a, b, c] = [(0, 0), (0, 1), (1, 1)].map(|(i, j)| normal.product(i, j));
        assert_eq!(factors.len(), 2);
        // a column that is explained completely leaves exactly zero, in every block and product
        let flat = [Prior::flat(); 4];
        let projected = normal.projected(&[0, 1], &flat);
        assert_eq!((0..=4).map(|k| projected.product(2, k).abs()).fold(0.0, f64::max), 0.0);
        // min over θ of |c − C θ|² + (θ/s)² = |c|² − (c·C)²/(|C|² + 1/s²)
        let known = [Prior::normal(0.0, 0.1); 4];
        let expected = a - b * b / (c + 100.0);
        assert!((normal.beside(0, &[1], &known) / expected - 1.0).abs() < 1e-8);
        // a zero column changes nothing
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

    /// Half of a normal density about zero is twice as large; a uniform one over a turn gives ∫
    /// exp(-θ²/2σ²) dθ/360.
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
