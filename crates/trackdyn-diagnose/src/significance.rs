//! Significance without a noise model: random signs for whole blocks.
//!
//! # Law
//! If nothing is missing, the score of a block (its residuals along some columns) is as likely to point one
//! way as the other. Signs are drawn anew for each block (wild bootstrap), all tests are repeated with
//! them, and the largest statistic of each draw is kept: a test is significant as part of the family if it
//! exceeds nearly all of these.
//!
//! # Sources
//! Wu, Annals of Statistics 14(4), 1986; Cameron, Gelbach, Miller, Review of Economics and Statistics
//! 90(3), 2008; Westfall, Young, Resampling-based multiple testing, 1993.

use crate::normal::Normal;
use nalgebra::{DMatrix, DVector};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use trackdyn_core::real;

/// A family-wise test of one group of columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Test {
    /// Squared length of the score in its own metric: χ² with `degrees` degrees of freedom if nothing is
    /// missing and the noise is what it is taken for.
    pub statistic: f64,
    /// Independent columns in the group.
    pub degrees: usize,
    /// Probability that the largest statistic of all groups is as large by chance.
    pub p: f64,
}

/// Largest part of its own length at which a column counts as explained by others.
const DEPENDENT: f64 = 1e-9;

/// Tests groups of columns of which the base was projected out, all as one family.
pub fn test(projected: &Normal, groups: &[Vec<usize>], draws: usize, seed: u64) -> Vec<Test> {
    let groups: Vec<Group> = groups.iter().map(|columns| Group::new(projected, columns)).collect();
    let observed: Vec<f64> =
        groups.iter().map(|group| group.statistic(&vec![1.0; projected.blocks()])).collect();
    let largest: Vec<f64> = (0..draws)
        .into_par_iter()
        .map(|draw| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            random.set_stream(draw as u64);
            let signs: Vec<f64> = (0..projected.blocks())
                .map(|_| if random.random::<bool>() { 1.0 } else { -1.0 })
                .collect();
            let statistics = groups.iter().map(|group| group.normal_score(group.statistic(&signs)));
            statistics.fold(f64::NEG_INFINITY, f64::max)
        })
        .collect();
    groups
        .iter()
        .zip(observed)
        .map(|(group, statistic)| {
            let score = group.normal_score(statistic);
            // As large as the observed arrangement within rounding counts as large.
            let exceeding = largest.iter().filter(|other| **other >= score - 1e-9).count();
            let p = if group.degrees == 0 { 1.0 } else { real(exceeding + 1) / real(draws + 1) };
            Test { statistic, degrees: group.degrees, p }
        })
        .collect()
}

/// Scores of a group, in axes in which they are independent and of unit size.
struct Group {
    /// Per block.
    scores: Vec<DVector<f64>>,
    degrees: usize,
}

impl Group {
    fn new(projected: &Normal, columns: &[usize]) -> Self {
        let information = projected.information(columns);
        let length: Vec<f64> = (0..columns.len()).map(|k| information[(k, k)].sqrt()).collect();
        let scaled = DMatrix::from_fn(columns.len(), columns.len(), |a, b| {
            let product = length[a] * length[b];
            if product > 0.0 { information[(a, b)] / product } else { 0.0 }
        });
        let eigen = scaled.symmetric_eigen();
        let largest = eigen.eigenvalues.max();
        let kept: Vec<usize> = (0..columns.len())
            .filter(|&k| eigen.eigenvalues[k] > 1e-6 * largest && largest > DEPENDENT)
            .collect();
        let per_column: Vec<Vec<f64>> =
            columns.iter().map(|&column| projected.scores(column)).collect();
        let scores = (0..projected.blocks())
            .map(|block| {
                DVector::from_fn(kept.len(), |k, _| {
                    let axis = eigen.eigenvectors.column(kept[k]);
                    let along: f64 = (0..columns.len())
                        .map(|c| axis[c] * per_column[c][block] / length[c].max(f64::MIN_POSITIVE))
                        .sum();
                    along / eigen.eigenvalues[kept[k]].sqrt()
                })
            })
            .collect();
        Self { scores, degrees: kept.len() }
    }

    fn statistic(&self, signs: &[f64]) -> f64 {
        let mut sum = DVector::zeros(self.degrees);
        for (score, sign) in self.scores.iter().zip(signs) {
            sum.axpy(*sign, score, 1.0);
        }
        sum.norm_squared()
    }

    /// A χ² as nearly a standard normal number, whatever its degrees of freedom.
    ///
    /// # Sources
    /// Wilson, Hilferty, Proceedings of the National Academy of Sciences 17(12), 1931.
    fn normal_score(&self, statistic: f64) -> f64 {
        if self.degrees == 0 {
            return f64::NEG_INFINITY;
        }
        let variance = 2.0 / (9.0 * real(self.degrees));
        ((statistic / real(self.degrees)).cbrt() - (1.0 - variance)) / variance.sqrt()
    }
}
