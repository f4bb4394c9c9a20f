//! What this evidence could show, and could tell apart.

use crate::hypothesis::{Unknown, neutral};
use crate::search::{Found, Screened, Search};
use nalgebra::DMatrix;
use trackdyn_model::EffectId;

/// The effects' signatures against each other, with all that is free projected out.
#[derive(Clone, Debug)]
pub struct Isolability {
    /// Places of the effects in the catalogue, ascending.
    pub effects: Vec<EffectId>,
    /// z of each effect at its typical size.
    pub detection: Vec<f64>,
    /// |cosine| between the signatures of two effects: one where they cannot be told apart.
    pub cosines: DMatrix<f64>,
    /// z of each effect at its typical size beside the other one.
    pub separation: DMatrix<f64>,
    /// z from which on an effect is detectable.
    pub min_detected_z: f64,
    /// Each size parameter, with z per unit of it.
    sizes: Vec<(Unknown, f64)>,
}

/// The smallest change of an effect's size that this evidence could have shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detectable {
    /// Place of the effect in the catalogue.
    pub effect: EffectId,
    /// Place of the size among its parameters.
    pub parameter: usize,
    /// How far the size would have to be off to stand out five standard deviations: from none, from
    /// the filed one where the vehicle file has the effect, from the fitted one where the best
    /// hypothesis adds it. None where no physical size would.
    pub size: Option<f64>,
}

impl Isolability {
    /// Of the best variant of each screened effect, beside the best hypothesis.
    pub fn new(search: &Search, best: &Found, screened: &[Screened]) -> Self {
        let mut order: Vec<&Screened> =
            screened.iter().filter(|one| !best.effects.contains(&one.effect)).collect();
        order.sort_by_key(|one| one.effect);
        let entries: Vec<usize> = order.iter().map(|one| one.entry).collect();
        let equations = search.equations(&best.fit, &entries);
        let (projected, groups) = (equations.projected(), &equations.groups);
        // The signature at typical sizes, as one column.
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
        // Those that are in the best hypothesis already: by how well they are known.
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

    /// The smallest size of every effect that would have stood out.
    pub fn detectable(&self) -> Vec<Detectable> {
        self.sizes
            .iter()
            .filter_map(|&(unknown, per_unit)| {
                let Unknown::Effect(effect, parameter) = unknown else { return None };
                let card = &effect.card().parameters[parameter];
                let most = (card.range[1] - neutral(card)).max(neutral(card) - card.range[0]);
                let size = self.min_detected_z / per_unit;
                Some(Detectable { effect, parameter, size: (size <= most).then_some(size) })
            })
            .collect()
    }
}
