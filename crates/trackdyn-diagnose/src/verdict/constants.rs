//! Constant ICRs that differ from those of the vehicle file: a wrong number, or one of a class of effects.

use super::{Rules, Support, Verdict, refusal};
use crate::base::OFFSETS;
use crate::fit::Fit;
use crate::hypothesis::{Hypothesis, Unknown, active, neutral, unknowns_of, with_friction};
use crate::prior::measured;
use crate::resampling::Resampling;
use crate::search::{Found, Search};
use std::collections::BTreeMap;
use trackdyn_core::real;
use trackdyn_model::effect::Symmetry;
use trackdyn_model::{EffectId, VehicleFile};

/// Share of its own beyond constant ICRs below which an effect is of their class.
const NOTHING_ELSE: f64 = 0.03;

/// The same below which it mostly moves these.
const MOSTLY: f64 = 0.1;

/// Effects that move the constant ICRs in all their variants, by their places in the catalogue, ascending.
#[derive(Clone, Debug)]
pub struct Constants {
    /// Those that move nothing else.
    pub only: Vec<EffectId>,
    /// Those that mostly do, the former among them.
    pub mostly: Vec<EffectId>,
    /// Those that constant ICRs may stand for: what moves nothing else, and all laws that by themselves break no
    /// symmetry but that of the sides. Where inertia acts at the centre of gravity, more is seen of these.
    class: Vec<EffectId>,
}

impl Constants {
    /// The effects of whose signatures next to nothing is their own beyond constant ICRs.
    pub fn of(search: &Search) -> Self {
        let fit = &search.base.fit;
        let entries: Vec<usize> = (0..search.catalogue.entries.len()).collect();
        let (normal, known, groups) = search.normal(fit, &entries);
        let offsets: Vec<usize> =
            (0..fit.unknowns.len()).filter(|&k| OFFSETS.contains(&fit.unknowns[k])).collect();
        let projected = normal.projected(&offsets, &known);
        let within = |share: f64| {
            let is_within = |group: &[usize]| {
                group.iter().all(|&column| {
                    let whole = normal.product(column, column);
                    whole > 0.0 && projected.product(column, column) <= share * whole
                })
            };
            let mut effects = BTreeMap::new();
            for ((variant, _), group) in search.catalogue.entries.iter().zip(&groups) {
                *effects.entry(variant.effect).or_insert(true) &= is_within(group);
            }
            effects.into_iter().filter(|(_, all)| *all).map(|(effect, _)| effect).collect()
        };
        let only: Vec<EffectId> = within(NOTHING_ELSE);
        let keeps = |effect: &EffectId| {
            effect.card().breaks.iter().all(|symmetry| *symmetry == Symmetry::Mirror)
        };
        let seen: Vec<EffectId> = within(f64::INFINITY);
        let class =
            seen.into_iter().filter(|effect| only.contains(effect) || keeps(effect)).collect();
        Self { only, mostly: within(MOSTLY), class }
    }

    /// Whether an effect mostly moves constant ICRs, and breaks no symmetry that they do not.
    pub(super) fn could_be_constant(&self, effect: EffectId) -> bool {
        self.mostly.contains(&effect) && self.class.contains(&effect)
    }
}

/// The best hypothesis with the vehicle as filed, no offset, and no effect that mostly stands for one but what is claimed;
/// and what else is free in it.
fn as_filed(
    search: &Search,
    best: &Found,
    constants: &Constants,
    file: &VehicleFile,
    claimed: &[EffectId],
) -> (Hypothesis, Vec<Unknown>) {
    let base = &search.base.fit.hypothesis;
    let is_dropped =
        |effect: &EffectId| constants.mostly.contains(effect) && !claimed.contains(effect);
    let added: Vec<EffectId> = best.effects.iter().copied().filter(is_dropped).collect();
    let without = added.iter().fold(best.fit.hypothesis.clone(), |hypothesis, &effect| {
        hypothesis.with_effect_of(base, effect)
    });
    let vehicle = with_friction(&file.vehicle, without.friction_level);
    let filed = Hypothesis { vehicle, offset: [0.0; 3], cog_moved: [0.0; 2], ..without };
    let is_fixed = |unknown: &Unknown| {
        let is_constant = matches!(unknown, Unknown::Offset(_) | Unknown::Cog(_));
        !is_constant && !added.iter().any(|&effect| unknown.is_of(effect))
    };
    (filed, best.fit.unknowns.iter().copied().filter(is_fixed).collect())
}

/// √ of what the misfit falls by when constant ICRs may differ from those of the vehicle file.
pub(super) fn departure(
    search: &Search,
    best: &Found,
    constants: &Constants,
    file: &VehicleFile,
) -> f64 {
    let (filed, fixed) = as_filed(search, best, constants, file, &[]);
    let before = Some(&best.fit.mechanics);
    let dropped = Fit::new(filed, &fixed, search.evidence, before);
    (dropped.objective - best.fit.objective).max(0.0).sqrt()
}

/// Constant ICRs that are nearly those of the vehicle file: no model of the contact is better.
fn as_good_as_filed(free: &Fit) -> Option<String> {
    let Hypothesis { vehicle, offset, .. } = &free.hypothesis;
    let largest = offset.iter().fold(0.0_f64, |most, by| most.max(by.abs()));
    (largest < Rules::CONSTANT * vehicle.gauge).then(|| {
        format!(
            "ICRs differ from the vehicle file's by {:.1} mm, less than {:.0} % of the gauge",
            1e3 * largest,
            100.0 * Rules::CONSTANT
        )
    })
}

/// Judges the constant ICRs against those of the vehicle file: a wrong number, or one of the class of effects
/// that only move them. Effects that are `claimed` stay where they are.
pub fn judge_constants(
    search: &Search,
    best: &Found,
    constants: &Constants,
    file: &VehicleFile,
    claimed: &[EffectId],
    resampling: Resampling,
) -> Option<Verdict> {
    let (filed, fixed) = as_filed(search, best, constants, file, claimed);
    let evidence = search.evidence;
    let before = Some(&best.fit.mechanics);
    let dropped = Fit::new(filed.clone(), &fixed, evidence, before);
    let moving: Vec<Unknown> = OFFSETS.iter().chain(&fixed).copied().collect();
    let free = Fit::new(filed.clone(), &moving, evidence, before);
    let ln_bayes_factor = free.ln_evidence() - dropped.ln_evidence();
    let z = (dropped.objective - free.objective).max(0.0).sqrt();
    if ln_bayes_factor < Rules::LN_BAYES_FACTOR {
        return None;
    }
    let support = Support {
        ln_bayes_factor,
        z,
        ..Support::of_columns(search, &free, &[0, 1, 2], &free.hypothesis.offset, resampling)
    };
    let refused = refusal(&support, 0.0).or_else(|| as_good_as_filed(&free));
    // What the owner measured can have moved within its uncertainty only: is that enough?
    let can = |effect: &EffectId| {
        if unknowns_of(*effect).all(|unknown| measured(&file.vehicle, unknown).is_none()) {
            return true;
        }
        let unknowns: Vec<Unknown> = fixed.iter().copied().chain(unknowns_of(*effect)).collect();
        let none: Vec<f64> = effect.card().parameters.iter().map(neutral).collect();
        let start = filed.with_effect(active(*effect, &none));
        let fit = Fit::new(start, &unknowns, evidence, before);
        // Each unknown fewer than the three constants is worth two: chance alone gives one half.
        let fewer = OFFSETS.len().saturating_sub(unknowns_of(*effect).count());
        (fit.objective - free.objective) / 2.0 < Rules::SAME + 2.0 * real(fewer)
    };
    let one_of: Vec<EffectId> = constants.class.iter().copied().filter(can).collect();
    let effect = *one_of.first()?;
    Some(Verdict { effect, one_of, found: None, support, refused })
}
