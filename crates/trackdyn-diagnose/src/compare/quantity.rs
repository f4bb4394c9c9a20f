//! Numbers that both sets have, with an estimate in each.

use super::choice::{Choice, is_constant, sizes};
use crate::base::spin_with;
use crate::diagnosis::Examination;
use crate::hypothesis::{Hypothesis, Unknown, neutral, typical_size};
use crate::mechanics::is_instrument;
use crate::normal::Prior;
use crate::prior::prior;
use crate::search::Found;
use crate::uncertainty::{Interval, Spread, Uncertainty};
use trackdyn_estimate::interval::NORMAL_QUANTILE;
use trackdyn_model::effect::{Card, Parameter, Role};
use trackdyn_model::{ActiveEffect, EffectId, Effects};

/// What is compared as one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Subject {
    /// The sizes of an effect.
    Effect(EffectId),
    /// The constant ICRs: friction ratio, centre of gravity and all that acts alike.
    Constants,
    /// The level of friction that inertia shows: mass over friction is one number.
    FrictionLevel,
    /// The centre of gravity that inertia shows.
    CentreOfGravity,
}

/// A number that is compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// A free number of both hypotheses.
    Unknown(Unknown),
    /// ln of the friction on which the robot slides, where effects of inertia are free: their
    /// strengths are the inverse of its level.
    Level,
    /// Of the constant ICRs: their middle (x_l + x_r)/2, half their distance (x_r − x_l)/2, or y.
    Icr(usize),
}

impl Number {
    /// Its parameter in the catalogue; none where it belongs to no effect.
    pub fn parameter(self) -> Option<&'static Parameter> {
        match self {
            Self::Unknown(unknown) => unknown.parameter(),
            Self::Level | Self::Icr(_) => None,
        }
    }

    /// Whether it moves this unknown of a fit; constant ICRs are moved by their offsets.
    pub(super) fn moves(self, unknown: Unknown) -> bool {
        let is_size = |of: &Parameter| matches!(of.role, Role::Size { .. });
        match self {
            Self::Unknown(own) => own == unknown,
            Self::Level => {
                let is_inertia = unknown.card().is_some_and(Card::is_inertia);
                is_inertia && unknown.parameter().is_some_and(is_size)
            }
            Self::Icr(_) => false,
        }
    }

    /// Its name, as a key of the vehicle file where it is one.
    pub fn name(self) -> &'static str {
        match self {
            Self::Icr(0) => "icr_middle",
            Self::Icr(1) => "icr_half_distance",
            Self::Icr(_) | Self::Unknown(Unknown::Offset(_)) => "icr_y",
            Self::Level | Self::Unknown(Unknown::FrictionLevel) => "ln_friction",
            Self::Unknown(Unknown::Cog(0)) => "cog_x",
            Self::Unknown(Unknown::Cog(_)) => "cog_y",
            Self::Unknown(Unknown::Effect(effect, place)) => effect.card().parameters[place].key,
        }
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Level | Self::Unknown(Unknown::FrictionLevel) => "1",
            Self::Unknown(Unknown::Effect(effect, place)) => effect.card().parameters[place].unit,
            Self::Icr(_) | Self::Unknown(_) => "m",
        }
    }
}

/// An estimate with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Estimate.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

impl Estimate {
    pub(super) fn around(value: f64, half: f64) -> Self {
        Self { value, low: value - half, high: value + half }
    }

    /// Standard deviation, as if the interval were that of a normal number; by its longer half,
    /// since the other may end at the limit of what is physical.
    pub fn deviation(&self) -> f64 {
        (self.high - self.value).max(self.value - self.low) / NORMAL_QUANTILE
    }

    /// This less another estimate that is independent of it.
    ///
    /// # Law
    /// low = d − √((θ₁ − l₁)² + (u₂ − θ₂)²), and high likewise. Each end depends on one end of
    /// either interval.
    ///
    /// # Sources
    /// Zou, Donner, *Statistics in Medicine* 27(10), 2008.
    pub fn less(&self, other: &Self) -> Self {
        let value = self.value - other.value;
        let below = (self.value - self.low).hypot(other.high - other.value);
        let above = (self.high - self.value).hypot(other.value - other.low);
        Self { value, low: value - below, high: value + above }
    }

    /// Whether its interval includes a value.
    pub fn holds(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }
}

impl From<Interval> for Estimate {
    fn from(Interval { value, low, high, .. }: Interval) -> Self {
        Self { value, low, high }
    }
}

/// A number with its estimate in each set.
#[derive(Clone, Copy, Debug)]
pub struct Quantity {
    /// The number.
    pub number: Number,
    /// Its estimate in the first set and in the second.
    pub each: [Estimate; 2],
    /// The second less the first.
    pub difference: Estimate,
    /// What is known of it without recordings; its mean is the value without the effect.
    pub prior: Prior,
    /// Change of a typical size, in its unit: what the difference is measured by.
    pub typical: f64,
}

impl Quantity {
    pub(super) fn new(number: Number, each: [Estimate; 2], prior: Prior, typical: f64) -> Self {
        Self { number, each, difference: each[1].less(&each[0]), prior, typical }
    }

    /// The mean of both, weighted by what each knows.
    pub(super) fn common(&self) -> f64 {
        let [a, b] = self.each.map(|one| one.deviation().powi(-2));
        let mean = (a * self.each[0].value + b * self.each[1].value) / (a + b);
        if mean.is_finite() { mean } else { self.each[0].value }
    }
}

/// Numbers that are compared as one.
#[derive(Clone, Debug)]
pub struct Group {
    /// What they are.
    pub subject: Subject,
    /// The effects whose sizes they are, or follow from, ascending.
    pub effects: Vec<EffectId>,
    /// The numbers.
    pub numbers: Vec<Quantity>,
}

/// Change of the middle, the half distance and y of the constant ICRs by each unknown of a fit.
pub(super) type Gradients = Vec<[f64; 3]>;

/// All groups that both fits have: effects, constants, and what inertia shows; and by how much the
/// unknowns of each fit move its constant ICRs.
pub(super) fn groups(
    sets: [&Examination; 2],
    choice: &Choice,
    uncertainties: &[Uncertainty; 2],
) -> (Vec<Group>, Option<[Gradients; 2]>) {
    let fits = [&choice.fits[0], &choice.fits[1]];
    let spreads = uncertainties.each_ref().map(Uncertainty::spread);
    let shown = |effect: &&EffectId| fits.iter().all(|fit| fit.effects.contains(effect));
    let effects: Vec<EffectId> = choice.compared.iter().filter(shown).copied().collect();
    let mut groups = of_effects(&effects, sets, choice, uncertainties);
    let evidence = &sets[0].search.evidence;
    let hypothesis = &sets[0].search.base.as_filed.hypothesis;
    let (constants, gradients) = constants(sets, choice, spreads).unzip();
    groups.extend(constants);
    for (subject, unknowns) in [
        (Subject::FrictionLevel, &[Unknown::FrictionLevel][..]),
        (Subject::CentreOfGravity, &[Unknown::Cog(0), Unknown::Cog(1)]),
    ] {
        let numbers = unknowns.iter().filter_map(|&unknown| {
            let of = |k: usize| known(fits[k], unknown, spreads[k]);
            let prior = prior(hypothesis, unknown, evidence);
            let typical = prior.deviation;
            Some(Quantity::new(Number::Unknown(unknown), [of(0)?, of(1)?], prior, typical))
        });
        groups.push(Group { subject, effects: Vec::new(), numbers: numbers.collect() });
    }
    groups.retain(|group| !group.numbers.is_empty());
    (groups, gradients)
}

/// The sizes of each of these effects, which both fits have.
fn of_effects(
    effects: &[EffectId],
    sets: [&Examination; 2],
    choice: &Choice,
    uncertainties: &[Uncertainty; 2],
) -> Vec<Group> {
    let intervals = uncertainties.each_ref().map(|one| one.intervals(effects));
    let evidence = &sets[0].search.evidence;
    let hypothesis = &sets[0].search.base.as_filed.hypothesis;
    let group = |&effect: &EffectId| {
        let numbers = sizes(effect).filter_map(|unknown| {
            let of =
                |k: usize| size(&choice.fits[k], unknown, &intervals[k], uncertainties[k].spread());
            let parameter = unknown.parameter()?;
            let known = prior(hypothesis, unknown, evidence);
            let known = Prior { mean: neutral(parameter), ..known };
            let typical = typical_size(parameter);
            Some(Quantity::new(Number::Unknown(unknown), [of(0)?, of(1)?], known, typical))
        });
        let numbers = numbers.collect();
        Group { subject: Subject::Effect(effect), effects: vec![effect], numbers }
    };
    effects.iter().map(group).collect()
}

/// Estimate of a size: by its profile where it is free, by the normal equations where it is held at
/// a bound; none where the fit does not have it.
fn size(
    found: &Found,
    unknown: Unknown,
    intervals: &[Interval],
    spread: &Spread,
) -> Option<Estimate> {
    let place = found.fit.unknowns.iter().position(|one| *one == unknown)?;
    if found.fit.free.contains(&place) {
        return intervals.iter().find(|one| one.unknown == unknown).copied().map(Estimate::from);
    }
    let Estimate { value, low, high } = known(found, unknown, spread)?;
    let range = found.fit.hypothesis.range(unknown);
    Some(Estimate { value, low: low.max(range[0]), high: high.min(range[1]) })
}

/// Estimate of an unknown by the normal equations; none where the fit does not have it.
fn known(found: &Found, unknown: Unknown, spread: &Spread) -> Option<Estimate> {
    let place = found.fit.unknowns.iter().position(|one| *one == unknown)?;
    Some(Estimate::around(found.fit.hypothesis.get(unknown), spread.half_of(place)))
}

/// Middle, half distance and y of the constant ICRs.
pub(super) fn middle_half_y([left, right, y]: [f64; 3]) -> [f64; 3] {
    [f64::midpoint(left, right), (right - left) / 2.0, y]
}

/// The constant ICRs of a hypothesis in a slow spin: without effects other than those that act as
/// constants.
fn icrs(hypothesis: &Hypothesis, beside: &[EffectId]) -> Option<[f64; 3]> {
    let effects = hypothesis.effects.iter().filter(|one| beside.contains(&one.effect()));
    let effects: Effects = effects.cloned().collect();
    let spin = spin_with(&hypothesis.vehicle, effects)?;
    Some(middle_half_y(std::array::from_fn(|k| spin[k] + hypothesis.offset[k])))
}

/// The constant ICRs of both sets, and by how much the unknowns move them; none where a vehicle has
/// no slow spin.
fn constants(
    sets: [&Examination; 2],
    choice: &Choice,
    spreads: [&Spread; 2],
) -> Option<(Group, [Gradients; 2])> {
    let of = |k: usize| -> Option<([Estimate; 3], Gradients)> {
        let fit = &choice.fits[k].fit;
        let beside = beside(sets, choice, &fit.hypothesis);
        let here = icrs(&fit.hypothesis, &beside)?;
        let by = |&unknown: &Unknown| -> Option<[f64; 3]> {
            let Some(step) = step(&fit.hypothesis, unknown, &beside) else {
                return Some([0.0; 3]);
            };
            let moved = fit.hypothesis.with(unknown, fit.hypothesis.get(unknown) + step);
            let step = moved.get(unknown) - fit.hypothesis.get(unknown);
            let there = icrs(&moved, &beside)?;
            Some([0, 1, 2].map(|n| if step == 0.0 { 0.0 } else { (there[n] - here[n]) / step }))
        };
        let gradients: Gradients = fit.unknowns.iter().map(by).collect::<Option<_>>()?;
        let estimate = |n: usize| {
            let own: Vec<f64> = gradients.iter().map(|by| by[n]).collect();
            Estimate::around(here[n], spreads[k].half(&own))
        };
        Some(([0, 1, 2].map(estimate), gradients))
    };
    let [(first, of_first), (second, of_second)] = [of(0)?, of(1)?];
    let filed = &sets[0].search.base.as_filed.hypothesis;
    let centred = Hypothesis { offset: [0.0; 3], ..filed.clone() };
    let mean = icrs(&centred, &beside(sets, choice, filed))?;
    let gauge = filed.vehicle.gauge;
    let settings = sets[0].search.settings();
    let deviation = settings.prior.icr_offset_deviation * gauge;
    let numbers = (0..3).map(|n| {
        let known = Prior::normal(mean[n], deviation);
        Quantity::new(
            Number::Icr(n),
            [first[n], second[n]],
            known,
            settings.comparison.icr_difference * gauge,
        )
    });
    let numbers = numbers.collect();
    let group = Group { subject: Subject::Constants, effects: Vec::new(), numbers };
    Some((group, [of_first, of_second]))
}

/// Effects of a hypothesis that act as constant ICRs, both its own and those of the vehicle file.
/// Where they are free, only their sum with the offsets is known.
fn beside(sets: [&Examination; 2], choice: &Choice, hypothesis: &Hypothesis) -> Vec<EffectId> {
    let is_one = |effect: &EffectId| {
        let mostly = sets.iter().any(|set| set.constants.mostly.contains(effect));
        let acts = mostly || is_constant(sets, *effect) || choice.effects.contains(effect);
        acts && !choice.compared.contains(effect)
    };
    hypothesis.effects.iter().map(ActiveEffect::effect).filter(is_one).collect()
}

/// A step of an unknown that moves constant ICRs; none for one that does not.
fn step(hypothesis: &Hypothesis, unknown: Unknown, beside: &[EffectId]) -> Option<f64> {
    const SHARE: f64 = 1e-3;
    match unknown {
        Unknown::Offset(_) | Unknown::Cog(_) => Some(SHARE * hypothesis.vehicle.gauge),
        Unknown::Effect(effect, _) if beside.contains(&effect) => {
            let parameter = unknown.parameter()?;
            let [_, high] = parameter.range;
            let step = SHARE * typical_size(parameter).max(f64::MIN_POSITIVE);
            let is_over = hypothesis.get(unknown) + step > high;
            Some(if is_over { -step } else { step })
        }
        Unknown::FrictionLevel | Unknown::Effect(..) => None,
    }
}

/// Sizes of encoders and pose sensor that are free in both sets.
pub(super) fn instruments(
    sets: [&Examination; 2],
    choice: &Choice,
    uncertainties: &[Uncertainty; 2],
) -> Vec<Group> {
    let hypothesis = &sets[0].search.base.as_filed.hypothesis;
    let is_one = |effect: EffectId, k: usize| {
        let active: Option<&ActiveEffect> = choice.fits[k].fit.hypothesis.effect(effect);
        active.is_some_and(|active| is_instrument(&hypothesis.vehicle, active))
            && sets[k].search.base.instruments.contains(&effect)
    };
    let both: Vec<EffectId> =
        EffectId::all().filter(|&effect| is_one(effect, 0) && is_one(effect, 1)).collect();
    let mut groups = of_effects(&both, sets, choice, uncertainties);
    groups.retain(|group| !group.numbers.is_empty());
    groups
}
