//! Separation of two rivals by driving.
//!
//! # Law
//! z² = min over θ of |W (p_A − p_B − C θ)|² + Σ (θ/s)²: p the predicted motions, C the Jacobian of
//! p_B by all that is free and by B's own parameters, W the whitening, s the prior standard
//! deviations.

use super::rivals::Rival;
use crate::evidence::Evidence;
use crate::fit::columns;
use crate::mechanics::Instruments;
use crate::normal::{Columns, Normal, Scaled};
use crate::prior::prior;
use crate::weighted::Weighted;
use nalgebra::{DMatrix, DVector, Vector3};
use rayon::prelude::*;

/// Two rivals, and the information on their nuisance parameters before the plan is driven.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Indices of both; the second is the one that is refitted.
    pub of: [usize; 2],
    /// Prior information (inverse covariance) of the second one's unknowns.
    pub prior: DMatrix<f64>,
    /// Information from typical driving.
    pub driven: DMatrix<f64>,
    /// z over typical driving: all manoeuvres of the menu.
    pub typical: f64,
}

impl Pair {
    /// Compares two rivals on typical driving.
    pub fn new(of: [usize; 2], rivals: &[Rival], driving: &Evidence, products: &Normal) -> Self {
        let second = &rivals[of[1]];
        let precision = second
            .unknowns
            .iter()
            .map(|&unknown| prior(&second.hypothesis, unknown, driving).deviation.powi(-2));
        let precision: Vec<f64> = precision.collect();
        let prior = DMatrix::from_diagonal(&DVector::from_vec(precision));
        let all: Vec<usize> = (0..products.columns()).collect();
        let driven = products.information(&all);
        let typical = squared(products.total(), &prior).sqrt();
        Self { of, prior, driven, typical }
    }
}

/// Predicted motion of a rival.
struct Predicted {
    moves: Vec<Vector3<f64>>,
    /// Whitened Jacobian by its unknowns; empty for a rival that is never second.
    derivatives: Vec<Vec<Vector3<f64>>>,
}

/// Products of difference and Jacobian of each pair, block by block.
pub fn products(pairs: &[[usize; 2]], rivals: &[Rival], evidence: &Weighted) -> Vec<Normal> {
    let is_second = |k: usize| pairs.iter().any(|pair| pair[1] == k);
    let seen: Vec<Predicted> = rivals
        .par_iter()
        .enumerate()
        .map(|(k, rival)| {
            let mechanics = rival.mechanics(evidence);
            let moves = mechanics.predict(&Instruments::of(&rival.hypothesis), evidence);
            let derivatives = if is_second(k) {
                let Rival { hypothesis, unknowns, .. } = rival;
                columns(hypothesis, &mechanics, &moves, unknowns, evidence)
            } else {
                Vec::new()
            };
            Predicted { moves, derivatives }
        })
        .collect();
    let blocks: Vec<usize> = evidence.samples().iter().map(|sample| sample.block).collect();
    pairs
        .par_iter()
        .map(|&[first, second]| {
            let Predicted { moves, derivatives } = &seen[second];
            let difference = seen[first].moves.iter().zip(moves).map(|(a, b)| a - b).collect();
            Normal::new(&Columns {
                residual: &evidence.white(difference),
                columns: derivatives,
                weights: &vec![1.0; blocks.len()],
                blocks: &blocks,
                count: evidence.blocks(),
            })
        })
        .collect()
}

/// z² by products, where `known` is the prior information of the unknowns.
pub fn squared(products: &DMatrix<f64>, known: &DMatrix<f64>) -> f64 {
    let (_, remaining) = fitted(products, known);
    remaining
}

/// Share of each block in z², at the joint estimate of the unknowns.
pub fn shares(products: &Normal, known: &DMatrix<f64>) -> Vec<f64> {
    let (estimate, _) = fitted(products.total(), known);
    // (−θ, 1) on the products of a block
    let mut factors = -estimate;
    factors = factors.push(1.0);
    (0..products.blocks())
        .map(|block| factors.dot(&(products.block(block) * &factors)).max(0.0))
        .collect()
}

/// θ and z².
fn fitted(products: &DMatrix<f64>, known: &DMatrix<f64>) -> (DVector<f64>, f64) {
    let count = known.nrows();
    let matrix = products.view((0, 0), (count, count)) + known;
    let gradient: DVector<f64> = products.view((0, count), (count, 1)).column(0).into_owned();
    let Some(factor) = Scaled::new(&matrix) else { return (DVector::zeros(count), 0.0) };
    let estimate = factor.solve(&gradient);
    let remaining = (products[(count, count)] - gradient.dot(&estimate)).max(0.0);
    (estimate, remaining)
}
