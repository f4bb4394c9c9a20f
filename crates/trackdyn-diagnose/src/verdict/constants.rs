//! Verdict on constant ICRs that differ from those of the vehicle file: a wrong number, or a class
//! of effects that act alike.

use super::{Basis, Refusal, Support, Verdict, refusal};
use crate::base::OFFSETS;
use crate::fit::Fit;
use crate::hypothesis::{Hypothesis, Unknown, active, neutral, unknowns_of, with_friction};
use crate::prior::measured;
use crate::progress::Cancelled;
use crate::search::{Found, Search};
use crate::settings;
use std::collections::BTreeMap;
use trackdyn_core::real;
use trackdyn_model::effect::Symmetry;
use trackdyn_model::{EffectId, VehicleFile};

/// Effects that act as constant ICRs in all their variants, ascending.
#[derive(Clone, Debug)]
pub struct Constants {
    /// Effects that do nothing else.
    pub only: Vec<EffectId>,
    /// Effects that mostly do; includes `only`.
    pub mostly: Vec<EffectId>,
    /// Effects that constant ICRs may stand for: `only`, and all laws that by themselves break at
    /// most the mirror symmetry. Where inertia acts at the centre of gravity, the latter show more
    /// than constants do.
    class: Vec<EffectId>,
}

impl Constants {
    /// Classifies effects by the share of their signatures that is left beside constant ICRs.
    pub fn of(search: &Search) -> Self {
        let fit = &search.base.fit;
        let entries: Vec<usize> = (0..search.catalogue.entries.len()).collect();
        let equations = search.equations(&search.nothing(), &entries);
        let offsets: Vec<usize> =
            (0..fit.unknowns.len()).filter(|&k| OFFSETS.contains(&fit.unknowns[k])).collect();
        let projected = equations.normal.projected(&offsets, &equations.priors);
        let within = |share: f64| {
            let is_within = |group: &[usize]| {
                group.iter().all(|&column| {
                    let whole = equations.normal.product(column, column);
                    whole > 0.0 && projected.product(column, column) <= share * whole
                })
            };
            let mut effects = BTreeMap::new();
            for ((variant, _), group) in search.catalogue.entries.iter().zip(&equations.groups) {
                *effects.entry(variant.effect).or_insert(true) &= is_within(group);
            }
            effects.into_iter().filter(|(_, all)| *all).map(|(effect, _)| effect).collect()
        };
        let settings = &search.settings().answer;
        let only: Vec<EffectId> = within(settings.max_constant_share);
        let keeps = |effect: &EffectId| {
            effect.card().breaks.iter().all(|symmetry| *symmetry == Symmetry::Mirror)
        };
        let seen: Vec<EffectId> = within(f64::INFINITY);
        let class =
            seen.into_iter().filter(|effect| only.contains(effect) || keeps(effect)).collect();
        Self { only, mostly: within(settings.max_mostly_constant_share), class }
    }

    /// Effects that constant ICRs may stand for, ascending.
    pub(crate) fn class(&self) -> &[EffectId] {
        &self.class
    }

    /// Whether an effect mostly acts as constant ICRs, and breaks no symmetry that they keep.
    pub(super) fn could_be_constant(&self, effect: EffectId) -> bool {
        self.mostly.contains(&effect) && self.class.contains(&effect)
    }
}

/// The best hypothesis with the vehicle as filed, zero offsets, and without unclaimed effects that
/// mostly act as constants; and its remaining unknowns.
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

/// √ of the decrease of chi-squared when constant ICRs may differ from those of the vehicle file.
pub(super) fn departure(
    search: &Search,
    best: &Found,
    constants: &Constants,
    file: &VehicleFile,
) -> f64 {
    let (filed, fixed) = as_filed(search, best, constants, file, &[]);
    let before = Some(&best.fit.mechanics);
    let dropped = Fit::new(filed, &fixed, &search.evidence, before);
    (dropped.objective - best.fit.objective).max(0.0).sqrt()
}

/// Refuses constant ICRs that differ from the vehicle file by less than `needed` gauges: contact
/// models are no more accurate.
fn as_good_as_filed(free: &Fit, needed: f64) -> Option<Refusal> {
    let Hypothesis { vehicle, offset, .. } = &free.hypothesis;
    let largest = offset.iter().fold(0.0_f64, |most, by| most.max(by.abs()));
    (largest < needed * vehicle.gauge).then_some(Refusal::ConstantsAsFiled { largest, needed })
}

/// Judges the constant ICRs against those of the vehicle file: a wrong number, or one of the class
/// of effects that act alike. Effects that are `claimed` stay in the hypothesis.
///
/// # Errors
/// [`Cancelled`], by the observer of the watch.
pub fn judge_constants(
    basis: &Basis,
    best: &Found,
    claimed: &[EffectId],
) -> Result<Option<Verdict>, Cancelled> {
    let Basis { search, constants, file, resampling, watch } = *basis;
    watch.go_on()?;
    let (filed, fixed) = as_filed(search, best, constants, file, claimed);
    let evidence = &search.evidence;
    let before = Some(&best.fit.mechanics);
    let dropped = Fit::new(filed.clone(), &fixed, evidence, before);
    let moving: Vec<Unknown> = OFFSETS.iter().chain(&fixed).copied().collect();
    let found = |fit: Fit| search.found(best.effects.clone(), fit);
    let dropped = search.with_own_starts(found(dropped));
    let free = found(Fit::new(filed.clone(), &moving, evidence, before));
    let ln_bayes_factor = free.ln_evidence - dropped.ln_evidence;
    let z = (dropped.fit.objective - free.fit.objective).max(0.0).sqrt();
    let settings::Settings { verdict: rules, answer, .. } = search.settings();
    if ln_bayes_factor < rules.min_ln_bayes_factor {
        return Ok(None);
    }
    let support = Support {
        ln_bayes_factor,
        z,
        ..Support::of_columns(search, &free, &[0, 1, 2], &free.fit.hypothesis.offset, resampling)
    };
    let refused = refusal(&support, 0.0, rules)
        .or_else(|| as_good_as_filed(&free.fit, rules.min_icr_difference));
    // A number that the owner measured may move within its uncertainty only: is that enough?
    let can = |effect: &EffectId| -> Result<bool, Cancelled> {
        if unknowns_of(*effect).all(|unknown| measured(&file.vehicle, unknown).is_none()) {
            return Ok(true);
        }
        watch.go_on()?;
        let unknowns: Vec<Unknown> = fixed.iter().copied().chain(unknowns_of(*effect)).collect();
        let none: Vec<f64> = effect.card().parameters.iter().map(neutral).collect();
        let start = filed.with_effect(active(*effect, &none));
        let fit = Fit::new(start, &unknowns, evidence, before);
        let fewer = OFFSETS.len().saturating_sub(unknowns_of(*effect).count());
        let allowed = answer.max_ln_likelihood_gap + answer.constants_allowance * real(fewer);
        Ok((fit.objective - free.fit.objective) / 2.0 < allowed)
    };
    let mut one_of: Vec<EffectId> = Vec::new();
    for effect in &constants.class {
        if can(effect)? {
            one_of.push(*effect);
        }
    }
    let first = one_of.first().copied();
    Ok(first.map(|effect| Verdict { effect, one_of, found: None, support, refused }))
}
