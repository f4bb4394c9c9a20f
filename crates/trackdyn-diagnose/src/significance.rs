//! Significance without a noise model: wild bootstrap with random signs of blocks.
//!
//! # Law
//! Without an effect, the score of a block (its residuals along some columns) has either sign with
//! equal probability. Signs are drawn for each block, all tests are repeated, and the largest
//! statistic of each draw is kept (max-T): a family-wise p is the share of draws that reach the
//! observed statistic.
//!
//! An effect must not inflate its own null distribution. Signs are therefore given to the
//! jackknifed score: what the score u_b of a block leaves beside the estimate of the other blocks.
//! With I_b the information of the block, Σ I_b = 1:
//!
//! ũ_b = u_b − I_b (1 − I_b + λ)⁻¹ (θ − u_b),  θ = Σ u_b
//!
//! The ridge λ keeps the estimate at zero where the other blocks have no information: what one
//! block alone shows stays in its score, and may be chance. Such a group would hide all others of
//! its family. Statistics are therefore divided by the dispersion c = Σ |ũ_b|²/k, k the degrees of
//! freedom, where c > 1.
//!
//! # Sources
//! Wu, Annals of Statistics 14(4), 1986; Cameron, Gelbach, Miller, Review of Economics and
//! Statistics 90(3), 2008; MacKinnon, Nielsen, Webb, Journal of Applied Econometrics 38(5), 2023
//! (jackknifed scores); Westfall, Young, Resampling-based multiple testing, 1993.

use crate::normal::Normal;
use crate::resampling::Resampling;
use crate::settings;
use nalgebra::{DMatrix, DVector};
use rand::RngExt;
use rayon::prelude::*;
use trackdyn_core::real;

/// A family-wise test of one group of columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Test {
    /// Squared norm of the score in its own metric: χ² with `degrees` degrees of freedom if there
    /// is no effect and the noise model is right.
    pub statistic: f64,
    /// Number of independent columns in the group.
    pub degrees: usize,
    /// Family-wise p: probability that the largest statistic of all groups is as large by chance.
    pub p: f64,
}

impl Test {
    /// Whether it is more significant than another test.
    pub fn is_stronger(&self, other: &Self) -> bool {
        let beyond = |test: &Self| test.statistic - real(test.degrees);
        self.p < other.p || (self.p == other.p && beyond(self) > beyond(other))
    }
}

/// Least eigenvalue, relative to the largest, of an independent combination of unit columns.
const MIN_EIGENVALUE_RATIO: f64 = 1e-6;

/// Tests groups of columns, with the base projected out, as one family.
pub fn test(
    projected: &Normal,
    groups: &[Vec<usize>],
    resampling: Resampling,
    settings: &settings::Location,
) -> Vec<Test> {
    let group = |columns: &Vec<usize>| Group::new(projected, columns, settings);
    let groups: Vec<Group> = groups.iter().map(group).collect();
    test_family(&groups, resampling)
}

/// Tests groups as one family.
pub fn test_family(groups: &[Group], resampling: Resampling) -> Vec<Test> {
    let blocks = groups.iter().map(Group::blocks).max().unwrap_or_default();
    let drawn: Vec<f64> = (0..resampling.draws)
        .into_par_iter()
        .flat_map_iter(|draw| {
            let mut random = resampling.random(draw);
            (0..blocks).map(move |_| if random.random::<bool>() { 1.0 } else { -1.0 })
        })
        .collect();
    // a column for each draw
    let signs = DMatrix::from_vec(blocks, resampling.draws, drawn);
    let none = || vec![f64::NEG_INFINITY; resampling.draws];
    let larger = |a: Vec<f64>, b: Vec<f64>| a.iter().zip(b).map(|(a, b)| a.max(b)).collect();
    let largest = groups
        .par_iter()
        .map(|group| {
            let statistics = group.statistics(&signs);
            statistics.into_iter().map(|statistic| group.normal_score(statistic)).collect()
        })
        .reduce(none, larger);
    groups
        .iter()
        .map(|group| {
            let statistic = group.observed();
            let score = group.normal_score(statistic);
            // Draws equal to the observed statistic within rounding count as reaching it.
            let exceeding = largest.iter().filter(|other| **other >= score - 1e-9).count();
            let share = real(exceeding + 1) / real(resampling.draws + 1);
            let p = if group.degrees == 0 { 1.0 } else { share };
            Test { statistic, degrees: group.degrees, p }
        })
        .collect()
}

/// Scores of a group of columns, in parts of the evidence that have sizes of their own.
pub struct Group {
    parts: Vec<Part>,
    /// Dispersion c ≥ 1.
    dispersion: f64,
    degrees: usize,
}

/// Products of columns with the residual, and with each other, in a block.
pub type Products = (DVector<f64>, DMatrix<f64>);

impl Group {
    /// Scores of columns with the base projected out.
    pub fn new(projected: &Normal, columns: &[usize], settings: &settings::Location) -> Self {
        let last = projected.columns();
        let blocks = (0..projected.blocks()).map(|block| {
            let products = projected.block(block);
            let score = DVector::from_fn(columns.len(), |c, _| products[(columns[c], last)]);
            let information = DMatrix::from_fn(columns.len(), columns.len(), |a, b| {
                products[(columns[a], columns[b])]
            });
            (score, information)
        });
        Self::of_parts(&[(0, blocks.collect())], settings)
    }

    /// Scores from parts: their first block, and the products of each of their blocks.
    pub fn of_parts(parts: &[(usize, Vec<Products>)], settings: &settings::Location) -> Self {
        let part = |(first, blocks): &(usize, Vec<Products>)| Part::of(*first, blocks, settings);
        let parts: Vec<Part> = parts.iter().map(part).collect();
        let degrees: usize = parts.iter().map(|part| part.score.len()).sum();
        // c = Σ |ũ_b|²/k
        let squares: f64 = parts.iter().map(|part| part.remainders.norm_squared()).sum();
        let dispersion = (squares / real(degrees.max(1))).max(1.0);
        Self { parts, dispersion, degrees }
    }

    /// Number of blocks.
    fn blocks(&self) -> usize {
        self.parts.last().map_or(0, |part| part.first + part.remainders.ncols())
    }

    fn observed(&self) -> f64 {
        self.parts.iter().map(|part| part.score.norm_squared()).sum()
    }

    /// Statistics of draws, whose signs of all blocks are columns.
    fn statistics(&self, signs: &DMatrix<f64>) -> Vec<f64> {
        let mut sums = vec![0.0; signs.ncols()];
        for part in &self.parts {
            let scores = &part.remainders * signs.rows(part.first, part.remainders.ncols());
            for (sum, score) in sums.iter_mut().zip(scores.column_iter()) {
                *sum += score.norm_squared();
            }
        }
        sums
    }

    /// Transforms χ² over the dispersion to an approximately standard normal score.
    ///
    /// # Sources
    /// Wilson, Hilferty, Proceedings of the National Academy of Sciences 17(12), 1931.
    fn normal_score(&self, statistic: f64) -> f64 {
        if self.degrees == 0 {
            return f64::NEG_INFINITY;
        }
        let variance = 2.0 / (9.0 * real(self.degrees));
        ((statistic / self.dispersion / real(self.degrees)).cbrt() - (1.0 - variance))
            / variance.sqrt()
    }
}

/// Scores in neighbouring blocks, in orthonormal axes of the columns' information there.
struct Part {
    /// Index of the first block.
    first: usize,
    /// Sum over the blocks.
    score: DVector<f64>,
    /// Jackknifed score of each block, one column per block.
    remainders: DMatrix<f64>,
}

impl Part {
    fn of(first: usize, blocks: &[Products], settings: &settings::Location) -> Self {
        let count = blocks.first().map_or(0, |(score, _)| score.len());
        if count == 0 {
            let remainders = DMatrix::zeros(0, blocks.len());
            return Self { first, score: DVector::zeros(0), remainders };
        }
        let information =
            blocks.iter().fold(DMatrix::zeros(count, count), |sum, (_, one)| sum + one);
        let length: Vec<f64> = (0..count).map(|k| information[(k, k)].max(0.0).sqrt()).collect();
        let scaled = DMatrix::from_fn(count, count, |a, b| {
            let product = length[a] * length[b];
            if product > 0.0 { information[(a, b)] / product } else { 0.0 }
        });
        let eigen = scaled.symmetric_eigen();
        let largest = eigen.eigenvalues.max();
        let kept: Vec<usize> = (0..count)
            .filter(|&k| eigen.eigenvalues[k] > MIN_EIGENVALUE_RATIO * largest && largest > 0.0)
            .collect();
        // Orthonormal axes as combinations of the columns; zero columns do not take part.
        let axes = DMatrix::from_fn(count, kept.len(), |c, k| {
            let scale = length[c] * eigen.eigenvalues[kept[k]].sqrt();
            if scale > 0.0 { eigen.eigenvectors[(c, kept[k])] / scale } else { 0.0 }
        });
        let scores: Vec<DVector<f64>> =
            blocks.iter().map(|(score, _)| axes.tr_mul(score)).collect();
        let score = scores.iter().fold(DVector::zeros(kept.len()), |sum, score| sum + score);
        let mut remainders = DMatrix::zeros(kept.len(), blocks.len());
        for (block, (own, (_, information))) in scores.iter().zip(blocks).enumerate() {
            let information = axes.tr_mul(information) * &axes;
            let left = left_beside(own, &information, &score, settings.score_ridge);
            remainders.set_column(block, &left);
        }
        Self { first, score, remainders }
    }
}

/// ũ = u − I (1 − I + λ)⁻¹ (θ − u)
fn left_beside(
    own: &DVector<f64>,
    information: &DMatrix<f64>,
    whole: &DVector<f64>,
    ridge: f64,
) -> DVector<f64> {
    let count = own.len();
    let known = DMatrix::from_diagonal_element(count, count, 1.0 + ridge) - information;
    // positive definite: no block has more information than all together
    let size = known.cholesky().map(|known| known.solve(&(whole - own)));
    size.map_or_else(|| own.clone(), |size| own - information * size)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::normal::Columns;
    use nalgebra::Vector3;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    const BLOCKS: usize = 36;
    const SAMPLES_PER_BLOCK: usize = 30;
    const RESAMPLING: Resampling = Resampling { draws: 999, seed: 1 };

    /// White noise, and three columns: the first two show in all blocks, the last in one. `sizes`
    /// are the first and the last effect in the residual, in standard deviations.
    fn evidence(seed: u64, sizes: [f64; 2]) -> Normal {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
        let count = BLOCKS * SAMPLES_PER_BLOCK;
        let mut columns: Vec<Vec<Vector3<f64>>> = (0..3)
            .map(|_| (0..count).map(|_| Vector3::new(normal(), 0.0, 0.0)).collect())
            .collect();
        for value in &mut columns[2][SAMPLES_PER_BLOCK..] {
            *value = Vector3::zeros();
        }
        let mut residual: Vec<Vector3<f64>> =
            (0..count).map(|_| Vector3::new(normal(), 0.0, 0.0)).collect();
        for (column, size) in [(0, sizes[0]), (2, sizes[1])] {
            let length = crate::equations::square(&columns[column]).sqrt();
            for (value, by) in residual.iter_mut().zip(&columns[column]) {
                *value += by * (size / length);
            }
        }
        let blocks: Vec<usize> = (0..count).map(|index| index / SAMPLES_PER_BLOCK).collect();
        Normal::new(&Columns {
            residual: &residual,
            columns: &columns,
            weights: &vec![1.0; count],
            blocks: &blocks,
            count: BLOCKS,
        })
    }

    fn tests_of(normal: &Normal) -> Vec<Test> {
        let settings = settings::Location::default();
        test(normal, &[vec![0], vec![1], vec![2]], RESAMPLING, &settings)
    }

    /// A column explained by others leaves rounding of either sign: that is no evidence.
    #[test]
    fn rounding_is_no_evidence() {
        let settings = &settings::Location::default();
        let information =
            DMatrix::from_row_slice(3, 3, &[1.0, 0.0, 0.5, 0.0, -1e-13, 0.0, 0.5, 0.0, 1.0]);
        let block = (DVector::from_vec(vec![0.5, 1e-13, 0.2]), information);
        let group = Group::of_parts(&[(0, vec![block; 4])], settings);
        assert_eq!(group.degrees, 2);
        assert!(group.observed() < 10.0, "{}", group.observed());
        let empty = (DVector::zeros(0), DMatrix::zeros(0, 0));
        let none = Group::of_parts(&[(0, vec![empty; 4])], settings);
        assert_eq!((none.degrees, none.observed()), (0, 0.0));
    }

    #[test]
    fn noise_is_chance_as_often_as_p_says() {
        let trials = 300;
        let small = (0..trials)
            .filter(|&seed| tests_of(&evidence(seed, [0.0; 2])).iter().any(|test| test.p < 0.05))
            .count();
        // Binomial with 0.05: 15 of 300, standard deviation 3.8.
        assert!((4..=29).contains(&small), "{small} of {trials}");
    }

    #[test]
    fn an_effect_is_not_its_own_chance() {
        // Six standard deviations, p = 1e-9 by the noise, in all of 20 recordings. Signs of plain
        // scores u_b of 36 blocks would double their statistic, and miss the effect in one
        // recording of four.
        for seed in 0..20 {
            let tests = tests_of(&evidence(seed, [8.0, 0.0]));
            assert!(tests[0].p < 0.002, "{seed}: {:?}", tests[0]);
            assert!(tests[1].p > 0.001, "{seed}: {:?}", tests[1]);
        }
    }

    #[test]
    fn what_one_block_knows_is_not_claimed_and_hides_nothing() {
        for seed in 0..20 {
            let tests = tests_of(&evidence(seed, [8.0, 12.0]));
            assert!(tests[0].p < 0.01, "{seed}: {:?}", tests[0]);
            assert!(tests[2].p > 0.01, "{seed}: {:?}", tests[2]);
        }
    }
}
