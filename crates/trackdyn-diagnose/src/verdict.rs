//! The verdict on each effect of the best hypothesis: claimed, or why not, and what it cannot be told from.

mod constants;
mod instruments;
mod rivals;
mod rules;
mod support;

pub use constants::{Constants, judge_constants};
pub use instruments::judge_instruments;
pub use rules::Rules;
pub use support::{Support, cross_validated};

use crate::candidate::{Signature, Variant, sizes};
use crate::fit::Fit;
use crate::hypothesis::{Unknown, beyond_none, neutral};
use crate::resampling::Resampling;
use crate::search::{AS_FILED, Found, Search};
use crate::uncertainty::Interval;
use rivals::{Rivals, separation};
use std::cell::LazyCell;
use support::Change;
use trackdyn_model::effect::Role;
use trackdyn_model::{ActiveEffect, EffectId, VehicleFile};

/// Something that was left out, or why it is not claimed.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// Place of the effect in the catalogue.
    pub effect: EffectId,
    /// All effects that explain it as well, ascending, itself among them.
    pub one_of: Vec<EffectId>,
    /// The effect as it was found; none where it stands for a class of constants.
    pub found: Option<ActiveEffect>,
    /// What speaks for it.
    pub support: Support,
    /// Why it is not claimed; none where it is.
    pub refused: Option<String>,
}

/// Judges effects that the best hypothesis adds.
///
/// `file` is the vehicle's.
pub fn judge(
    search: &Search,
    best: &Found,
    effects: &[EffectId],
    constants: &Constants,
    file: &VehicleFile,
    resampling: Resampling,
) -> Vec<Verdict> {
    let departure = (search.base.fit.objective - best.fit.objective).max(0.0).sqrt();
    // What mostly moves constant ICRs is known to a part of all that moved them. What a law beyond their class breaks none of
    // them does.
    let by_constants = LazyCell::new(|| constants::departure(search, best, constants, file));
    let of = |effect: EffectId| {
        let rivals = Rivals::new(search, best, constants, effect);
        let (one_of, stable) = rivals.answer(search, best, resampling);
        let support = rivals.support(search, best, &one_of, stable, resampling);
        let whole = if one_of.iter().any(|member| constants.could_be_constant(*member)) {
            departure.hypot(*by_constants)
        } else {
            departure
        };
        let unfit = || {
            let mut unknowns = best.fit.unknowns.iter();
            unknowns.find_map(|&unknown| at_limit(&best.fit, unknown, effect))
        };
        let as_filed = || {
            let mut members = rivals.refitted(best).filter(|(member, _)| one_of.contains(member));
            members.find_map(|(member, found)| nearly_as_filed(search, &found.fit, member))
        };
        let refused = refusal(&support, whole)
            .or_else(unfit)
            .or_else(|| rivals.too_many())
            .or_else(as_filed)
            .or_else(|| within_filed(search, &rivals.without, rivals.changed.as_ref()?));
        let found = best.fit.hypothesis.effect(effect).cloned();
        Verdict { effect, one_of, found, support, refused }
    };
    effects.iter().copied().map(of).collect()
}

/// Why a claim is refused by the rules; none where it is not. The `whole` is √ of what the misfit falls by with all laws.
fn refusal(support: &Support, whole: f64) -> Option<String> {
    if let Some(reason) = support.falls_short() {
        return Some(reason);
    }
    if support.stable < Rules::STABLE {
        return Some(format!(
            "named in {:.0} % of resampled recordings only",
            100.0 * support.stable
        ));
    }
    if support.z < Rules::FORM * whole {
        return Some("no larger than what the form of the other laws may leave".to_owned());
    }
    None
}

/// An effect that the vehicle file knows, at nearly the sizes that it gives: no law is known better.
fn nearly_as_filed(search: &Search, found: &Fit, effect: EffectId) -> Option<String> {
    let filed = search.base.as_filed.hypothesis.effect(effect)?;
    let found = found.hypothesis.effect(effect)?;
    let near = sizes(effect).into_iter().all(|place| {
        let [filed, found] = [filed, found].map(|effect| beyond_none(effect, place));
        (found - filed).abs() <= AS_FILED * filed.abs()
    });
    let id = effect.name();
    near.then(|| format!("the vehicle file knows {id}, which explains it at nearly the filed size"))
}

/// A size of the effect that ended at the limit of its physical range.
fn at_limit(fit: &Fit, unknown: Unknown, effect: EffectId) -> Option<String> {
    let parameter = unknown.parameter()?;
    let is_size = matches!(parameter.role, Role::Size { .. });
    let value = fit.hypothesis.get(unknown);
    (unknown.is_of(effect) && is_size && fit.is_at_limit(unknown))
        .then(|| format!("{} = {value} lies at the limit of what is physical", parameter.key))
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
        let names: Vec<&str> = laws.iter().map(|(law, _)| law.effect.name()).collect();
        format!("no more than what {} of a slightly other size may leave", names.join(" and "))
    })
}

/// Refuses the claims whose sizes may all be none by their own intervals.
pub fn refuse_unsure(verdicts: &mut [Verdict], intervals: &[Interval]) {
    for verdict in verdicts.iter_mut().filter(|verdict| verdict.refused.is_none()) {
        let effect = verdict.effect;
        let places = sizes(effect).into_iter().map(|place| Unknown::Effect(effect, place));
        let sizes: Vec<&Interval> = places
            .filter_map(|unknown| intervals.iter().find(|interval| interval.unknown == unknown))
            .collect();
        let may_be_none = |interval: &&Interval| {
            // of a limit that the law approaches, the range ends before it
            let [low, high] = interval.unknown.range();
            let none = interval.unknown.parameter().map_or(0.0, neutral).clamp(low, high);
            (interval.low..=interval.high).contains(&none)
        };
        if !sizes.is_empty() && sizes.iter().all(may_be_none) {
            verdict.refused = Some("the 95 % interval of its size holds none".to_owned());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_that_may_be_none_is_not_claimed() {
        let of = |id: &str| EffectId::of(id).expect("an effect");
        let refused = |id: &str, [low, high]: [f64; 2]| {
            let effect = of(id);
            let unknown = Unknown::Effect(effect, sizes(effect)[0]);
            let interval = Interval { unknown, value: f64::midpoint(low, high), low, high };
            let support = Support::none();
            let one_of = vec![effect];
            let mut verdicts = [Verdict { effect, one_of, found: None, support, refused: None }];
            refuse_unsure(&mut verdicts, &[interval]);
            verdicts[0].refused.is_some()
        };
        assert!(refused("yaw-inertia", [0.0, 0.03]));
        assert!(!refused("yaw-inertia", [0.01, 0.03]));
        assert!(refused("directional-lugs", [-0.01, 0.002]));
        // the range of a modulus ends above none
        assert!(refused("shear-displacement", [1e-5, 2e-3]));
        assert!(!refused("shear-displacement", [1e-4, 2e-3]));
    }
}
