//! The verdict on each effect of the best hypothesis: claimed, or why not, and what it cannot be told from.

mod constants;
mod instruments;
mod support;

pub use constants::{Statics, judge_constants, statics};
pub use instruments::judge_instruments;
pub use support::{Support, cross_validated};

use crate::base::Base;
use crate::candidate::{Signature, Variant, sizes};
use crate::evidence::Evidence;
use crate::fit::Fit;
use crate::hypothesis::{Unknown, beyond_none, neutral, typical};
use crate::mechanics::is_instrument;
use crate::search::{AS_FILED, Found, Screened, Search};
use crate::uncertainty::Interval;
use std::cell::LazyCell;
use std::slice;
use support::Change;
use trackdyn_core::real;
use trackdyn_physics::effect::Role;
use trackdyn_physics::{CATALOGUE, VehicleFile};

/// What a claim must reach.
pub struct Rules;

impl Rules {
    /// Family-wise probability of chance.
    pub const P: f64 = 0.01;
    /// Logarithm of the Bayes factor against the best hypothesis without the effect.
    pub const LN_BAYES_FACTOR: f64 = 5.0;
    /// Gain on blocks that were held out, in its standard errors.
    pub const GAIN: f64 = 2.0;
    /// Share of resampled recordings that name the same.
    pub const STABLE: f64 = 0.9;
    /// Log-likelihood within which two hypotheses are one answer.
    pub const SAME: f64 = 3.0;
    /// Separation, in standard deviations, below which two effects are one answer.
    pub const ISOLATED: f64 = 3.0;
    /// Part of the whole departure that an effect must explain beside others: a law is known to about a tenth
    /// of what it does, and what it leaves is not another effect.
    pub const FORM: f64 = 0.1;
    /// Part of the gauge by which constant ICRs must differ from those of the vehicle file to be a wrong number:
    /// shoes, tyres and their pressure are known no better.
    pub const CONSTANT: f64 = 0.01;
    /// Part of the noise that may be left in one symmetry, in squares: no simulator equals the ground to all digits.
    pub const LEFT: f64 = 0.01;
    /// Part of the whole departure that the forms of the named laws may leave in one symmetry.
    pub const FORM_LEFT: f64 = 0.2;

    /// χ² that may be left in one symmetry beside a hypothesis: a part of what its laws took away, and of the noise.
    pub fn tolerated(evidence: &Evidence, base: &Base, best: &Found) -> f64 {
        let whole = (base.fit.objective - best.fit.objective).max(0.0);
        Self::FORM_LEFT * Self::FORM_LEFT * whole + Self::LEFT * real(evidence.measured())
    }
}

/// Effects that are named together at most because resampled recordings name now this one, now that.
const UNSTABLE: usize = 3;

/// Rivals of an effect that are refitted, and as many more that may be among those that move constant ICRs.
const RIVALS: usize = 3;

/// Something that was left out, or why it is not claimed.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// Place of the effect in the catalogue.
    pub effect: usize,
    /// All effects that explain it as well, ascending, itself among them.
    pub one_of: Vec<usize>,
    /// What speaks for it.
    pub support: Support,
    /// Why it is not claimed; none where it is.
    pub refused: Option<String>,
}

/// Judges every effect that the best hypothesis adds.
///
/// `file` is the vehicle's.
pub fn judge(
    search: &Search,
    best: &Found,
    statics: &Statics,
    file: &VehicleFile,
    draws: usize,
    seed: u64,
) -> Vec<Verdict> {
    let departure = (search.base.fit.objective - best.fit.objective).max(0.0).sqrt();
    // What mostly moves constant ICRs is known to a part of all that moved them. What a law beyond their class breaks none of
    // them does.
    let could_be_constant = |effect: &usize| statics.could_be_constant(*effect);
    let by_constants = LazyCell::new(|| constants::departure(search, best, statics, file));
    best.effects
        .iter()
        .map(|&effect| {
            let without = search.without(best, effect);
            let screened = search.screen(&without);
            let mut one_of = vec![effect];
            let mut exchanges = Vec::new();
            let own = screened.iter().find(|one| one.effect == effect);
            let own_gain = own.map_or(0.0, |one| one.gain);
            let changed = support::change(effect, &without, best);
            let is_close = |one: &&Screened| one.effect != effect && is_rival(one, own_gain, best);
            let close: Vec<&Screened> = screened.iter().filter(is_close).collect();
            // Where constant ICRs moved far the linear screen is blind to what else such a law does.
            let could_be = |(place, one): &(usize, &&Screened)| {
                *place < RIVALS || could_be_constant(&one.effect)
            };
            let rivals = close.iter().enumerate().filter(could_be).take(2 * RIVALS);
            for (_, rival) in rivals {
                let exchanged = search.refit(&without, std::slice::from_ref(rival));
                let behind = (exchanged.fit.objective - best.fit.objective) / 2.0;
                let apart = changed.as_ref().map_or(f64::INFINITY, |changed| {
                    let (_, rival) = &search.catalogue.entries[rival.entry];
                    separation(search, &without, changed, &[rival], |_| None)
                });
                let less = best.ln_evidence - exchanged.ln_evidence;
                if behind < Rules::SAME || less < Rules::LN_BAYES_FACTOR || apart < Rules::ISOLATED
                {
                    one_of.push(rival.effect);
                }
                exchanges.push((rival.effect, exchanged));
            }
            // Where all that were asked explain it as well, those that were not may.
            let too_many = (exchanges.len() < close.len() && one_of.len() > exchanges.len())
                .then(|| format!("{} effects explain it as well", close.len()));
            // What other recordings of the same robot would name instead is one answer with it.
            let rivals = exchanges.iter().map(|(rival, exchanged)| (*rival, exchanged));
            let refitted: Vec<(usize, &Found)> =
                std::iter::once((effect, best)).chain(rivals).collect();
            let named = support::named(search, &without, &screened, &refitted, seed);
            let share = |one_of: &[usize]| -> f64 {
                one_of.iter().filter_map(|effect| named.get(effect)).sum()
            };
            while one_of.len() < UNSTABLE && share(&one_of) < Rules::STABLE {
                let next = named.iter().filter(|(effect, _)| !one_of.contains(effect));
                let Some((&next, _)) = next.max_by(|a, b| a.1.total_cmp(b.1)) else { break };
                one_of.push(next);
            }
            let stable = share(&one_of);
            let rivals = refitted.iter().filter(|(effect, _)| !one_of.contains(effect));
            let strongest =
                rivals.fold(without.ln_evidence, |most, (_, one)| most.max(one.ln_evidence));
            one_of.sort_unstable();
            let z = (without.fit.objective - best.fit.objective).max(0.0).sqrt();
            let whole = if one_of.iter().any(could_be_constant) {
                departure.hypot(*by_constants)
            } else {
                departure
            };
            let support = own.map_or(Support::none(), |own| Support {
                ln_bayes_factor: best.ln_evidence - strongest,
                z,
                stable,
                ..Support::of_effect(search, &without, best, own, draws, seed)
            });
            let unfit =
                best.fit.unknowns.iter().find_map(|&unknown| at_limit(&best.fit, unknown, effect));
            let refused = refusal(&support, z, whole)
                .or(unfit)
                .or(too_many)
                .or_else(|| {
                    let mut members = refitted.iter().filter(|(effect, _)| one_of.contains(effect));
                    members.find_map(|(effect, one)| nearly_as_filed(search, &one.fit, *effect))
                })
                .or_else(|| within_filed(search, &without, changed.as_ref()?));
            Verdict { effect, one_of, support, refused }
        })
        .collect()
}

/// Whether the linear screen leaves it open that a candidate does as well as what gains `own`.
///
/// Signatures of encoders and pose sensor are taken far from where they are needed; they promise less than they keep.
fn is_rival(one: &Screened, own: f64, best: &Found) -> bool {
    let hypothesis = &best.fit.hypothesis;
    let is_instrument = is_instrument(&hypothesis.vehicle, &typical(one.effect));
    let share = if is_instrument { 0.5 } else { 0.85 };
    one.gain.is_finite()
        && one.gain > share * own - 2.0 * Rules::SAME
        && !best.effects.contains(&one.effect)
}

/// Why a claim is refused by the rules; none where it is not.
fn refusal(support: &Support, z: f64, whole: f64) -> Option<String> {
    if let Some(reason) = support.falls_short() {
        return Some(reason);
    }
    if support.stable < Rules::STABLE {
        return Some(format!(
            "named in {:.0} % of resampled recordings only",
            100.0 * support.stable
        ));
    }
    if z < Rules::FORM * whole {
        return Some("no larger than what the form of the other laws may leave".to_owned());
    }
    None
}

/// An effect that the vehicle file knows, at nearly the sizes that it gives: no law is known better.
fn nearly_as_filed(search: &Search, found: &Fit, effect: usize) -> Option<String> {
    let filed = search.base.as_filed.hypothesis.effect(effect)?;
    let found = found.hypothesis.effect(effect)?;
    let near = sizes(effect).into_iter().all(|place| {
        let [filed, found] = [filed, found].map(|effect| beyond_none(effect, place));
        (found - filed).abs() <= AS_FILED * filed.abs()
    });
    let id = CATALOGUE[effect].id;
    near.then(|| format!("the vehicle file knows {id}, which explains it at nearly the filed size"))
}

/// A size of the effect that ended at the limit of its physical range.
fn at_limit(fit: &Fit, unknown: Unknown, effect: usize) -> Option<String> {
    let parameter = unknown.parameter()?;
    let is_size = matches!(parameter.role, Role::Size { .. });
    let value = fit.hypothesis.get(unknown);
    let [low, high] = parameter.range;
    let at = (value - low).min(high - value) <= 1e-6 * (high - low);
    (unknown.is_of(effect) && is_size && at)
        .then(|| format!("{} = {value} lies at the limit of what is physical", parameter.key))
}

/// Separation of an effect from rivals: the part of what refitting with it changed that neither the rivals' signatures nor
/// what is free can stand for, in standard deviations. Sizes of rivals of which something is `known` have this standard
/// deviation.
fn separation(
    search: &Search,
    without: &Found,
    changed: &Change,
    rivals: &[&[Signature]],
    known: impl Fn(Unknown) -> Option<f64>,
) -> f64 {
    let signatures = [&[slice::from_ref(&changed.signature)], rivals].concat();
    let (normal, mut priors, groups) = search.normal_of(&without.fit, &signatures);
    let mut free: Vec<usize> = (0..without.fit.columns.len()).collect();
    for (&column, signature) in groups[1..].iter().flatten().zip(rivals.iter().copied().flatten()) {
        free.push(column);
        if let Some(deviation) = known(signature.unknown) {
            priors[column].deviation = deviation;
        }
    }
    changed.size.abs() * normal.beside(groups[0][0], &free, &priors).sqrt()
}

/// Why what an effect changes is no more than what laws of the vehicle file may leave; none where it is more.
///
/// Such a law is known to a part of what it does: its radius of gyration is hardly ever measured.
fn within_filed(search: &Search, without: &Found, changed: &Change) -> Option<String> {
    let filed = &search.base.as_filed.hypothesis;
    let laws: Vec<&(Variant, Vec<Signature>)> = search
        .catalogue
        .entries
        .iter()
        .filter(|(law, _)| filed.effect(law.effect).is_some())
        .filter(|(law, _)| !changed.signature.unknown.is_of(law.effect))
        .collect();
    let signatures: Vec<&[Signature]> = laws.iter().map(|(_, law)| &law[..]).collect();
    let known = |unknown: Unknown| {
        let none = unknown.parameter().map_or(0.0, neutral);
        Some(Rules::FORM * (filed.get(unknown) - none).abs()).filter(|size| *size > 0.0)
    };
    let apart = separation(search, without, changed, &signatures, known);
    (!laws.is_empty() && apart < Rules::ISOLATED).then(|| {
        let names: Vec<&str> = laws.iter().map(|(law, _)| CATALOGUE[law.effect].id).collect();
        format!("no more than what {} of a slightly other size may leave", names.join(" and "))
    })
}

/// Refuses the claims that nothing speaks for any more beside what is left of a hypothesis; their effects.
pub fn refuse_unsupported(search: &Search, best: &Found, verdicts: &mut [Verdict]) -> Vec<usize> {
    let claimed = verdicts.iter_mut().filter(|verdict| verdict.refused.is_none());
    let unsupported = claimed.filter_map(|verdict| {
        let effect = verdict.effect;
        let left = best.ln_evidence - search.without(best, effect).ln_evidence;
        (left < Rules::LN_BAYES_FACTOR).then(|| {
            verdict.refused =
                Some(format!("ln Bayes factor {left:.1} beside the claims that are left"));
            effect
        })
    });
    unsupported.collect()
}

/// Refuses the claims whose sizes may all be none by their own intervals; their effects.
pub fn refuse_unsure(verdicts: &mut [Verdict], intervals: &[Interval]) -> Vec<usize> {
    let claimed = verdicts.iter_mut().filter(|verdict| verdict.refused.is_none());
    let unsure = claimed.filter_map(|verdict| {
        let effect = verdict.effect;
        let places = sizes(effect).into_iter().map(|place| Unknown::Effect(effect, place));
        let sizes = places
            .filter_map(|unknown| intervals.iter().find(|interval| interval.unknown == unknown));
        let mut may_be_none = sizes.map(|interval| {
            // of a limit that the law approaches, the range ends before it
            let [low, high] = interval.unknown.range();
            let none = interval.unknown.parameter().map_or(0.0, neutral).clamp(low, high);
            (interval.low..=interval.high).contains(&none)
        });
        let refused = may_be_none.next()? && may_be_none.all(|may| may);
        refused.then(|| {
            verdict.refused = Some("the 95 % interval of its size holds none".to_owned());
            effect
        })
    });
    unsure.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_that_may_be_none_is_not_claimed() {
        let of = |id: &str| CATALOGUE.iter().position(|card| card.id == id).expect("an effect");
        let refused = |id: &str, [low, high]: [f64; 2]| {
            let effect = of(id);
            let unknown = Unknown::Effect(effect, sizes(effect)[0]);
            let interval = Interval { unknown, value: f64::midpoint(low, high), low, high };
            let support = Support::none();
            let mut verdicts = [Verdict { effect, one_of: vec![effect], support, refused: None }];
            refuse_unsure(&mut verdicts, &[interval]) == [effect] && verdicts[0].refused.is_some()
        };
        assert!(refused("yaw-inertia", [0.0, 0.03]));
        assert!(!refused("yaw-inertia", [0.01, 0.03]));
        assert!(refused("directional-lugs", [-0.01, 0.002]));
        // the range of a modulus ends above none
        assert!(refused("shear-displacement", [1e-5, 2e-3]));
        assert!(!refused("shear-displacement", [1e-4, 2e-3]));
    }
}
