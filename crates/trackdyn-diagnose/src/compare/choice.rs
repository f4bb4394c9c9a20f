//! The effects of both sets: one hypothesis that either has, fitted to each.
//!
//! Instruments, constants and sizes are free in each set, so the likelihood of both is the product
//! of two likelihoods. What couples them is which effects there are, and whether a size is the same
//! in both: a rival that makes the sets equal needs one size where another needs two.

use super::bayes::shared_gain;
use crate::diagnosis::Examination;
use crate::diagnosis::Kind;
use crate::fit::{Fit, Point};
use crate::hypothesis::{Hypothesis, Unknown, beyond_none};
use crate::mechanics::is_instrument;
use crate::prior::prior;
use crate::progress::{Cancelled, Watch};
use crate::search::Found;
use std::collections::BTreeSet;
use trackdyn_model::effect::Role;
use trackdyn_model::{ActiveEffect, EffectId};

/// A claim of one diagnosis: the effect, and all that explain it as well.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Claimed {
    pub effect: EffectId,
    pub one_of: Vec<EffectId>,
}

/// The effects that either set has, with the fit of each set.
pub(super) struct Choice {
    /// The effects, ascending.
    pub effects: Vec<EffectId>,
    /// Effects that are compared by their sizes. Effects for which constant ICRs may stand are
    /// compared by the ICRs, so that one cause does not count as two differences.
    pub compared: Vec<EffectId>,
    /// The fit of each set: without the effects that it cannot show.
    pub fits: [Found; 2],
}

/// Physics that a diagnosis claims.
pub(super) fn claimed(set: &Examination) -> Vec<Claimed> {
    let missing = set.diagnosis.answer.missing.iter();
    let physics = missing.filter(|missing| missing.kind == Kind::Physics);
    physics
        .map(|missing| Claimed {
            effect: missing.verdict.effect,
            one_of: missing.verdict.one_of.clone(),
        })
        .collect()
}

impl Choice {
    /// The choice with the highest evidence of both sets together.
    pub fn best(sets: [&Examination; 2], watch: &Watch) -> Result<Self, Cancelled> {
        let mut best: Option<(f64, Self)> = None;
        for effects in candidates(sets.map(claimed), &filed(sets)) {
            let choice = Self::of(sets, effects, watch)?;
            let evidence = choice.evidence(sets);
            if best.as_ref().is_none_or(|(most, _)| evidence > *most) {
                best = Some((evidence, choice));
            }
        }
        let best = best.expect("the union of the claims is a choice").1;
        best.polished(sets, watch)
    }

    /// The choice with each fit started once more from all numbers of the other one. One of them
    /// may be in a worse minimum, and what both have in common is a good start.
    fn polished(self, sets: [&Examination; 2], watch: &Watch) -> Result<Self, Cancelled> {
        let again = |k: usize| -> Result<Found, Cancelled> {
            watch.go_on()?;
            let [own, other] = [&self.fits[k], &self.fits[1 - k]];
            let search = &sets[k].search;
            let is_free = |unknown| own.fit.unknowns.contains(&unknown);
            let of_vehicle = [Unknown::FrictionLevel, Unknown::Cog(0), Unknown::Cog(1)];
            let is_alike = |unknown| is_free(unknown) == other.fit.unknowns.contains(&unknown);
            if !of_vehicle.into_iter().all(is_alike) {
                return Ok(own.clone());
            }
            let start = with_physics_of(&other.fit.hypothesis, &own.fit.hypothesis);
            let before = Some(&own.fit.mechanics);
            let start = Point::new(start, &own.fit.unknowns, &search.evidence, before);
            if start.objective.is_infinite() {
                return Ok(own.clone());
            }
            let fit = Fit::from_point(start, &own.fit.unknowns, &search.evidence);
            Ok(better(own.clone(), search.recalibrated(own.effects.clone(), fit)))
        };
        let fits = [again(0)?, again(1)?];
        Ok(Self { fits, ..self })
    }

    /// Fits these effects to both sets. Each fit starts once more from the sizes of the other.
    fn of(
        sets: [&Examination; 2],
        effects: Vec<EffectId>,
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let own =
            [fitted(sets[0], &effects, None, watch)?, fitted(sets[1], &effects, None, watch)?];
        let again = [
            fitted(sets[0], &effects, Some(&own[1]), watch)?,
            fitted(sets[1], &effects, Some(&own[0]), watch)?,
        ];
        let [[a, b], [c, d]] = [own, again];
        let compared = effects.iter().copied().filter(|one| !is_constant(sets, *one)).collect();
        Ok(Self { effects, compared, fits: [better(a, c), better(b, d)] })
    }

    /// ln evidence of both sets, where each effect has either one size or two.
    fn evidence(&self, sets: [&Examination; 2]) -> f64 {
        let of_fits: f64 = self.fits.iter().map(|fit| fit.ln_evidence).sum();
        let gains = self.effects.iter().map(|&effect| {
            let gain: f64 = sizes(effect)
                .map(|unknown| {
                    let [Some(a), Some(b)] = self.fits.each_ref().map(|fit| normal(fit, unknown))
                    else {
                        return 0.0;
                    };
                    let hypothesis = &self.fits[0].fit.hypothesis;
                    let known = prior(hypothesis, unknown, &sets[0].search.evidence);
                    shared_gain([a, b], &known)
                })
                .sum();
            gain.max(0.0)
        });
        of_fits + gains.sum::<f64>()
    }
}

/// The one with the higher evidence.
fn better(own: Found, again: Found) -> Found {
    if again.ln_evidence > own.ln_evidence { again } else { own }
}

/// A hypothesis with the numbers of another one: those of its effects and of its vehicle, but not
/// of encoders and pose sensor, nor what stands in the world.
fn with_physics_of(other: &Hypothesis, own: &Hypothesis) -> Hypothesis {
    let (offset, vehicle) = (other.offset, other.vehicle.clone());
    let (friction_level, cog_moved) = (other.friction_level, other.cog_moved);
    let moved = Hypothesis { vehicle, offset, friction_level, cog_moved, ..own.clone() };
    let is_taken = |active: &&ActiveEffect| {
        !is_instrument(&own.vehicle, active) && !is_of_the_world(active.effect())
    };
    own.effects
        .iter()
        .filter(is_taken)
        .filter_map(|active| other.effect(active.effect()))
        .fold(moved, |moved, there| moved.with_effect(there.clone()))
}

/// Whether an effect belongs to the world: each set has a world of its own.
fn is_of_the_world(effect: EffectId) -> bool {
    let of_the_world =
        |role: Role| matches!(role, Role::Place { .. } | Role::Direction | Role::Time);
    effect.card().parameters.iter().any(|parameter| of_the_world(parameter.role))
}

/// Whether constant ICRs may stand for an effect in either set.
pub(super) fn is_constant(sets: [&Examination; 2], effect: EffectId) -> bool {
    sets.iter().any(|set| set.constants.class().contains(&effect))
}

/// Sizes of an effect, as unknowns.
pub(super) fn sizes(effect: EffectId) -> impl Iterator<Item = Unknown> {
    crate::candidate::sizes(effect).into_iter().map(move |place| Unknown::Effect(effect, place))
}

/// Posterior mean and variance of a fitted unknown; none where it is not free.
fn normal(found: &Found, unknown: Unknown) -> Option<[f64; 2]> {
    let place = found.fit.unknowns.iter().position(|one| *one == unknown)?;
    let variance = found.fit.solution.covariance[(place, place)];
    Some([found.fit.hypothesis.get(unknown), variance])
}

/// Effects of the vehicle file whose sizes may differ: physics, but what constant ICRs stand for,
/// and inertia, whose level is free beside it.
fn filed(sets: [&Examination; 2]) -> BTreeSet<EffectId> {
    let filed = &sets[0].search.base.as_filed.hypothesis;
    let is_compared = |active: &&ActiveEffect| {
        let effect = active.effect();
        !effect.card().is_inertia()
            && !is_instrument(&filed.vehicle, active)
            && !is_constant(sets, effect)
            && sizes(effect).next().is_some()
    };
    filed.effects.iter().filter(is_compared).map(ActiveEffect::effect).collect()
}

/// Sets of effects that are tried: all claims of both, those of one alone, and all claims with one
/// effect in place of two that may be the same; each with the effects of the vehicle file.
fn candidates(
    [first, second]: [Vec<Claimed>; 2],
    filed: &BTreeSet<EffectId>,
) -> Vec<Vec<EffectId>> {
    let effects = |claims: &[Claimed]| -> BTreeSet<EffectId> {
        claims.iter().map(|claim| claim.effect).chain(filed.iter().copied()).collect()
    };
    let [of_first, of_second] = [effects(&first), effects(&second)];
    let all: BTreeSet<EffectId> = of_first.union(&of_second).copied().collect();
    let mut tried = vec![all.clone(), of_first, of_second];
    for a in &first {
        for b in second.iter().filter(|b| b.effect != a.effect) {
            for &member in a.one_of.iter().filter(|member| b.one_of.contains(member)) {
                let mut merged = all.clone();
                merged.remove(&a.effect);
                merged.remove(&b.effect);
                merged.insert(member);
                tried.push(merged);
            }
        }
    }
    let mut distinct: Vec<Vec<EffectId>> = Vec::new();
    for one in tried.into_iter().map(Vec::from_iter) {
        if !distinct.contains(&one) {
            distinct.push(one);
        }
    }
    distinct
}

/// The best hypothesis of a diagnosis with these effects in place of its claims. An effect that the
/// set cannot show is left out. Effects that are added start from `other`, where given.
fn fitted(
    set: &Examination,
    effects: &[EffectId],
    other: Option<&Found>,
    watch: &Watch,
) -> Result<Found, Cancelled> {
    let search = &set.search;
    let mut found = set.diagnosis.models.best.clone();
    for claim in claimed(set).iter().filter(|claim| !effects.contains(&claim.effect)) {
        watch.go_on()?;
        found = search.without(&found, claim.effect);
    }
    let lacking: Vec<EffectId> =
        effects.iter().copied().filter(|effect| !found.effects.contains(effect)).collect();
    for effect in lacking {
        watch.go_on()?;
        let screened = search.screen(&found);
        let shown = screened.iter().find(|one| one.effect == effect && one.gain.is_finite());
        let Some(shown) = shown else { continue };
        found = match other.and_then(|other| from_other(set, &found, other, effect)) {
            Some(found) => found,
            None => search.refit(&found, std::slice::from_ref(shown)),
        };
    }
    Ok(found)
}

/// Adds an effect, starting from its fit to the other set: its shapes are fixed there, its sizes
/// are free. None where the other set lacks the effect, or where it has a place, direction or time:
/// each set has a world of its own.
fn from_other(set: &Examination, beside: &Found, other: &Found, effect: EffectId) -> Option<Found> {
    let there = other.fit.hypothesis.effect(effect)?;
    if is_of_the_world(effect) {
        return None;
    }
    let (search, evidence) = (&set.search, &set.search.evidence);
    let mut unknowns = beside.fit.unknowns.clone();
    unknowns.extend(sizes(effect));
    let starts = [1.0, search.settings().search.near_start].map(|share| {
        let hypothesis = beside.fit.hypothesis.with_effect(there.clone());
        let hypothesis = sizes(effect).fold(hypothesis.clone(), |moved, unknown| {
            let Unknown::Effect(_, place) = unknown else { return moved };
            let away = (share - 1.0) * beyond_none(there, place);
            moved.with(unknown, hypothesis.get(unknown) + away)
        });
        Point::new(hypothesis, &unknowns, evidence, Some(&beside.fit.mechanics))
    });
    let mut effects = [&beside.effects[..], &[effect]].concat();
    effects.sort_unstable();
    let fits = starts.into_iter().filter(|start| start.objective.is_finite());
    let fits = fits.map(|start| {
        let fit = Fit::from_point(start, &unknowns, evidence);
        search.recalibrated(effects.clone(), fit)
    });
    fits.max_by(|a, b| a.ln_evidence.total_cmp(&b.ln_evidence))
}
