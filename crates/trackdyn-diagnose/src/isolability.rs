//! Detectability and isolability: what this evidence could show, and tell apart.

use crate::hypothesis::{Unknown, largest_size, neutral};
use crate::search::{Found, Screened, Search};
use nalgebra::DMatrix;
use trackdyn_model::EffectId;

/// Signatures of all effects compared, with all that is free projected out.
#[derive(Clone, Debug)]
pub struct Isolability {
    /// The effects, ascending.
    pub effects: Vec<EffectId>,
    /// z of each effect at its typical size: norm of its signature.
    pub detection: Vec<f64>,
    /// |cosine| between two signatures: one where the effects cannot be told apart.
    pub cosines: DMatrix<f64>,
    /// z of each effect at its typical size, with the other one's signature projected out.
    pub separation: DMatrix<f64>,
    /// Least z of a detectable effect.
    pub min_detected_z: f64,
    /// Each size parameter with its z per unit.
    sizes: Vec<(Unknown, f64)>,
}

/// Smallest detectable change of an effect's size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detectable {
    /// The effect.
    pub effect: EffectId,
    /// Index of the size among its parameters.
    pub parameter: usize,
    /// Detectable distance, in the parameter's unit: from the neutral size, from the filed size
    /// where the vehicle file has the effect, or from the fitted size where the best hypothesis
    /// adds it. None where no physical size is detectable.
    pub size: Option<f64>,
}

impl Isolability {
    /// Compares the best variant of each screened effect, beside the best hypothesis.
    pub fn new(search: &Search, best: &Found, screened: &[Screened]) -> Self {
        let mut order: Vec<&Screened> =
            screened.iter().filter(|one| !best.effects.contains(&one.effect)).collect();
        order.sort_by_key(|one| one.effect);
        let entries: Vec<usize> = order.iter().map(|one| one.entry).collect();
        let equations = search.equations(best, &entries);
        let (projected, groups) = (equations.projected(), &equations.groups);
        // Signature at typical sizes, as one column.
        let typical = |place: usize| -> Vec<f64> {
            let parameters = order[place].effect.card().parameters;
            let sizes = crate::candidate::sizes(order[place].effect);
            sizes.iter().map(|&k| parameters[k].typical - neutral(&parameters[k])).collect()
        };
        let product = |a: usize, b: usize| -> f64 {
            let (sizes_a, sizes_b) = (typical(a), typical(b));
            let pairs = groups[a].iter().zip(&sizes_a);
            pairs
                .flat_map(|(&i, x)| {
                    groups[b].iter().zip(&sizes_b).map(move |(&j, y)| (i, j, x * y))
                })
                .map(|(i, j, factor)| factor * projected.product(i, j))
                .sum()
        };
        let count = order.len();
        let products = DMatrix::from_fn(count, count, product);
        let detection: Vec<f64> = (0..count).map(|k| products[(k, k)].max(0.0).sqrt()).collect();
        let cosines = DMatrix::from_fn(count, count, |a, b| {
            let lengths = detection[a] * detection[b];
            if lengths > 0.0 { (products[(a, b)] / lengths).abs().min(1.0) } else { 0.0 }
        });
        let separation = DMatrix::from_fn(count, count, |a, b| {
            if a == b {
                detection[a]
            } else {
                detection[a] * (1.0 - cosines[(a, b)].powi(2)).max(0.0).sqrt()
            }
        });
        let mut sizes = Vec::new();
        for (place, group) in groups.iter().enumerate() {
            let (_, signatures) = &search.catalogue.entries[order[place].entry];
            for (signature, &column) in signatures.iter().zip(group) {
                sizes.push((signature.unknown, projected.product(column, column).max(0.0).sqrt()));
            }
        }
        // Sizes fitted in the best hypothesis: by their standard deviation.
        for (k, &unknown) in best.fit.unknowns.iter().enumerate() {
            let Unknown::Effect(_, _) = unknown else { continue };
            let is_size = unknown.parameter().is_some_and(|parameter| {
                matches!(parameter.role, trackdyn_model::effect::Role::Size { .. })
            });
            if is_size {
                sizes.push((unknown, best.fit.solution.covariance[(k, k)].sqrt().recip()));
            }
        }
        sizes.sort_by_key(|(unknown, _)| *unknown);
        let effects = order.iter().map(|one| one.effect).collect();
        let min_detected_z = search.settings().limits.min_detected_z;
        Self { effects, detection, cosines, separation, min_detected_z, sizes }
    }

    /// Smallest detectable size of every effect.
    pub fn detectable(&self) -> Vec<Detectable> {
        self.sizes
            .iter()
            .filter_map(|&(unknown, per_unit)| {
                let Unknown::Effect(effect, parameter) = unknown else { return None };
                let card = &effect.card().parameters[parameter];
                let size = self.min_detected_z / per_unit;
                let is_physical = size <= largest_size(card);
                Some(Detectable { effect, parameter, size: is_physical.then_some(size) })
            })
            .collect()
    }
}
