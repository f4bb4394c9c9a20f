//! Verdict on each effect of the best hypothesis: claimed or refused, and with which effects it is
//! confounded.

mod constants;
mod instruments;
mod left;
mod refusal;
mod rivals;
mod rule;
mod support;

pub use constants::{Constants, judge_constants};
pub use instruments::judge_instruments;
pub use left::tolerated;
pub use refusal::Refusal;
pub use rule::Rule;
pub use support::{Support, cross_validated};

use crate::candidate::{Signature, Variant, sizes};
use crate::evidence::Evidence;
use crate::fit::Fit;
use crate::hypothesis::{Unknown, beyond_none, neutral};
use crate::prior::area;
use crate::progress::{Cancelled, Watch};
use crate::resampling::Resampling;
use crate::search::{Found, Search};
use crate::settings;
use crate::uncertainty::Interval;
use rivals::{Rivals, separation};
use std::cell::LazyCell;
use support::Change;
use trackdyn_model::effect::Role;
use trackdyn_model::{ActiveEffect, EffectId, VehicleFile};

/// Verdict on an effect: a claim, or a refusal with its reason.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// The effect.
    pub effect: EffectId,
    /// All effects that explain it as well, ascending, this one included.
    pub one_of: Vec<EffectId>,
    /// The effect with its fitted parameters; none where it stands for a class of constants.
    pub found: Option<ActiveEffect>,
    /// Statistical support of the claim.
    pub support: Support,
    /// Why it is not claimed; none where it is claimed.
    pub refused: Option<Refusal>,
}

/// What all verdicts on a search rest on.
#[derive(Clone, Copy)]
pub struct Basis<'a> {
    /// Evidence, base and catalogue of candidates.
    pub search: &'a Search,
    /// Effects that act as constant ICRs.
    pub constants: &'a Constants,
    /// The vehicle file.
    pub file: &'a VehicleFile,
    /// Draws and seed of the resampling.
    pub resampling: Resampling,
    /// The watch, asked before each refit.
    pub watch: &'a Watch<'a>,
}

/// Judges effects that the best hypothesis adds.
///
/// # Errors
/// [`Cancelled`], by the observer of the watch.
pub fn judge(basis: &Basis, best: &Found, effects: &[EffectId]) -> Result<Vec<Verdict>, Cancelled> {
    let Basis { search, constants, file, resampling, watch } = *basis;
    let departure = (search.base.fit.objective - best.fit.objective).max(0.0).sqrt();
    // The form error of what may act as constant ICRs is a share of all that moved them. It cannot
    // mimic a law outside their class, which breaks symmetries that constants keep.
    let by_constants = LazyCell::new(|| constants::departure(search, best, constants, file));
    let of = |effect: EffectId| {
        if let Some(weak) = weak(search, best, effect) {
            return Ok(weak);
        }
        let rivals = Rivals::new(search, best, constants, effect, watch)?;
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
        let refused = refusal(&support, whole, &search.settings().verdict)
            .or_else(unfit)
            .or_else(|| rivals.too_many())
            .or_else(as_filed)
            .or_else(|| within_filed(search, &rivals.without, rivals.changed.as_ref()?));
        let found = best.fit.hypothesis.effect(effect).cloned();
        Ok(Verdict { effect, one_of, found, support, refused })
    };
    effects.iter().copied().map(of).collect()
}

/// Refuses an effect that gains too little against the hypothesis without it: it cannot gain more
/// against its rivals. None where it gains enough.
fn weak(search: &Search, best: &Found, effect: EffectId) -> Option<Verdict> {
    let without = search.without(best, effect);
    let support = Support {
        ln_bayes_factor: best.ln_evidence - without.ln_evidence,
        z: (without.fit.objective - best.fit.objective).max(0.0).sqrt(),
        ..Support::none()
    };
    let refused = support.falls_short(&search.settings().verdict);
    let refused = refused.filter(|refusal| refusal.rule() == Rule::BayesFactor)?;
    let (one_of, found) = (vec![effect], best.fit.hypothesis.effect(effect).cloned());
    Some(Verdict { effect, one_of, found, support, refused: Some(refused) })
}

/// Refusal by the statistical rules; none where all are met. `whole` is the √ of the decrease of
/// chi-squared by all laws together.
fn refusal(support: &Support, whole: f64, rules: &settings::Verdict) -> Option<Refusal> {
    if let Some(reason) = support.falls_short(rules) {
        return Some(reason);
    }
    let Support { stable, z, .. } = *support;
    if stable < rules.min_stability {
        return Some(Refusal::Unstable { share: stable, needed: rules.min_stability });
    }
    let needed = rules.max_form_error * whole;
    (z < needed).then_some(Refusal::WithinForm { z, needed })
}

/// Refuses an effect of the vehicle file with nearly the filed sizes: no law is known more
/// accurately.
fn nearly_as_filed(search: &Search, found: &Fit, effect: EffectId) -> Option<Refusal> {
    let filed = search.base.as_filed.hypothesis.effect(effect)?;
    let found = found.hypothesis.effect(effect)?;
    let changes = sizes(effect).into_iter().map(|place| {
        let [filed, found] = [filed, found].map(|effect| beyond_none(effect, place));
        if found == filed { 0.0 } else { ((found - filed) / filed).abs() }
    });
    let (change, needed) =
        (changes.fold(0.0, f64::max), search.settings().verdict.min_filed_change);
    (change <= needed).then_some(Refusal::NearlyAsFiled { effect, change, needed })
}

/// Refuses an effect with a size at the limit of its physical range.
fn at_limit(fit: &Fit, unknown: Unknown, effect: EffectId) -> Option<Refusal> {
    let parameter = unknown.parameter()?;
    let is_size = matches!(parameter.role, Role::Size { .. });
    let value = fit.hypothesis.get(unknown);
    (unknown.is_of(effect) && is_size && fit.is_at_limit(unknown))
        .then_some(Refusal::AtLimit { size: unknown, value })
}

/// Refuses an effect that errors in the laws of the vehicle file could cause; none where it is
/// larger than that.
///
/// Such laws are known to a share of their size: a radius of gyration is hardly ever measured.
fn within_filed(search: &Search, without: &Found, changed: &Change) -> Option<Refusal> {
    let filed = &search.base.as_filed.hypothesis;
    let laws: Vec<&(Variant, Vec<Signature>)> = search
        .catalogue
        .entries
        .iter()
        .filter(|(law, _)| filed.effect(law.effect).is_some())
        .filter(|(law, _)| !changed.signature.unknown.is_of(law.effect))
        .collect();
    let signatures: Vec<&[Signature]> = laws.iter().map(|(_, law)| &law[..]).collect();
    let form_error = search.settings().verdict.max_form_error;
    let known = |unknown: Unknown| {
        let none = unknown.parameter().map_or(0.0, neutral);
        Some(form_error * (filed.get(unknown) - none).abs()).filter(|size| *size > 0.0)
    };
    let apart = separation(search, without, changed, &signatures, known);
    let needed = search.settings().answer.min_separation;
    (!laws.is_empty() && apart < needed).then(|| Refusal::WithinFiled {
        laws: laws.iter().map(|(law, _)| law.effect).collect(),
        apart,
        needed,
    })
}

/// The verdict. It is refused where the intervals of all its sizes include the neutral size, or
/// where the interval of its place is wider than the area driven.
pub fn unless_unsure(verdict: Verdict, intervals: &[Interval], evidence: &Evidence) -> Verdict {
    let places = sizes(verdict.effect).into_iter();
    let sizes: Vec<&Interval> = places
        .map(|place| Unknown::Effect(verdict.effect, place))
        .filter_map(|unknown| intervals.iter().find(|interval| interval.unknown == unknown))
        .collect();
    let may_be_none = |interval: &&Interval| {
        let none = interval.unknown.parameter().map_or(0.0, neutral);
        (interval.low..=interval.high).contains(&none)
    };
    let is_unsure = sizes.iter().all(may_be_none);
    let first = sizes.first().filter(|_| is_unsure);
    let unsure = || first.map(|interval| Refusal::MayBeNone { interval: **interval });
    let anywhere = |interval: &Interval| {
        let role = interval.unknown.parameter().map(|parameter| parameter.role);
        let place = role.filter(|role| matches!(role, Role::Place { .. } | Role::Time));
        let needed = area(evidence, place?)[1];
        let is_wide = (interval.high - interval.low) / 2.0 > needed;
        is_wide.then_some(Refusal::Nowhere { interval: *interval, needed })
    };
    let mut own = intervals.iter().filter(|interval| interval.unknown.is_of(verdict.effect));
    let refused = verdict.refused.clone().or_else(unsure).or_else(|| own.find_map(anywhere));
    Verdict { refused, ..verdict }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::planned::PlannedRun;
    use crate::plan::assumed_noise;
    use crate::settings::Settings;
    use nalgebra::Vector3;
    use trackdyn_core::Pose;
    use trackdyn_recording::TrackSample;

    /// Eight metres along x.
    fn driven() -> Evidence {
        let reading = |k: u32| TrackSample { t: 0.03 * f64::from(k), v_left: 1.0, v_right: 1.0 };
        let tracks = (0..=270).map(reading).collect();
        let run = PlannedRun { tracks, pose: Pose::default(), blocks: vec![0] };
        let noise = assumed_noise(1e-3, 1e-3);
        Evidence::planned(&[run], noise, 0.0, &Settings::default(), |evidence| {
            evidence.samples().iter().map(|s| Vector3::new(s.duration, 0.0, 0.0)).collect()
        })
    }

    #[test]
    fn a_place_that_may_be_anywhere_is_not_claimed() {
        let effect = EffectId::of("terrain-patch").expect("an effect");
        let parameters = effect.card().parameters.iter();
        let along = parameters.clone().position(|p| p.role == Role::Place { axis: 0 }).expect("x");
        let refused = |half: f64| {
            let unknown = Unknown::Effect(effect, along);
            let interval = Interval { unknown, value: 4.0, low: 4.0 - half, high: 4.0 + half };
            let (one_of, support) = (vec![effect], Support::none());
            let verdict = Verdict { effect, one_of, found: None, support, refused: None };
            unless_unsure(verdict, &[interval], &driven()).refused
        };
        assert_eq!(refused(0.5), None);
        assert!(matches!(refused(150.0), Some(Refusal::Nowhere { .. })));
    }

    #[test]
    fn a_size_that_may_be_none_is_not_claimed() {
        let of = |id: &str| EffectId::of(id).expect("an effect");
        let refused = |id: &str, [low, high]: [f64; 2]| {
            let effect = of(id);
            let unknown = Unknown::Effect(effect, sizes(effect)[0]);
            let interval = Interval { unknown, value: f64::midpoint(low, high), low, high };
            let support = Support::none();
            let one_of = vec![effect];
            let verdict = Verdict { effect, one_of, found: None, support, refused: None };
            unless_unsure(verdict, &[interval], &driven()).refused.is_some()
        };
        assert!(refused("yaw-inertia", [0.0, 0.03]));
        assert!(!refused("yaw-inertia", [0.01, 0.03]));
        assert!(refused("directional-lugs", [-0.01, 0.002]));
        // the neutral modulus, zero, lies below its range
        assert!(refused("shear-displacement", [1e-5, 2e-3]));
        assert!(!refused("shear-displacement", [1e-4, 2e-3]));
    }
}
