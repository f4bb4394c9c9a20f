//! A hypothesis: a vehicle, effects with their sizes, and constant offsets of the ICRs.

use crate::evidence::{Evidence, Sample};
use crate::settings;
use std::collections::BTreeSet;
use std::sync::Arc;
use trackdyn_core::Twist;
use trackdyn_model::effect::{Card, Parameter, Role};
use trackdyn_model::{ActiveEffect, EffectId, Effects, Vehicle, VehicleFile};

/// A hypothesis on the robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Hypothesis {
    /// The vehicle.
    pub vehicle: Vehicle,
    /// Active effects.
    pub effects: Effects,
    /// Offset of the ICRs (x_l, x_r, y), m: all that slow driving on level ground identifies.
    pub offset: [f64; 3],
    /// ln of the factor of both friction coefficients against the initial vehicle. Steady driving
    /// identifies their ratio only; with inertia, a robot slides farther on less friction.
    pub friction_level: f64,
    /// Shift of the centre of gravity (x_c, y_c) against the initial vehicle, m. Constant ICRs
    /// confound it with other numbers; with inertia, every start and stop shows it.
    pub cog_moved: [f64; 2],
    /// Largest |friction_level|.
    pub max_friction_change: f64,
    /// Motions with which runs begin, where they were found for this hypothesis.
    pub starts: Option<OwnStarts>,
}

/// Departure of the twist (paper's frame) from the stationary one with which each run of some
/// samples begins.
#[derive(Clone, Debug)]
pub struct OwnStarts {
    samples: Arc<[Sample]>,
    twists: Arc<[Twist]>,
}

impl PartialEq for OwnStarts {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.samples, &other.samples) && self.twists == other.twists
    }
}

/// A free number of a hypothesis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Unknown {
    /// Offset of x_l, x_r or y.
    Offset(usize),
    /// Friction level.
    FrictionLevel,
    /// Centre of gravity, x_c or y_c.
    Cog(usize),
    /// Parameter of an effect, by its index.
    Effect(EffectId, usize),
}

impl Unknown {
    /// Card of its effect; none if it belongs to no effect.
    pub fn card(self) -> Option<&'static Card> {
        match self {
            Self::Offset(_) | Self::FrictionLevel | Self::Cog(_) => None,
            Self::Effect(effect, _) => Some(effect.card()),
        }
    }

    /// Parameter in the catalogue; none if it belongs to no effect.
    pub fn parameter(self) -> Option<&'static Parameter> {
        match self {
            Self::Offset(_) | Self::FrictionLevel | Self::Cog(_) => None,
            Self::Effect(effect, parameter) => Some(&effect.card().parameters[parameter]),
        }
    }

    /// Whether it is a parameter of this effect.
    pub fn is_of(self, effect: EffectId) -> bool {
        matches!(self, Self::Effect(of, _) if of == effect)
    }
}

/// Unknowns of an effect: all its parameters.
pub fn unknowns_of(effect: EffectId) -> impl Iterator<Item = Unknown> {
    (0..effect.card().parameters.len()).map(move |parameter| Unknown::Effect(effect, parameter))
}

/// Value of a parameter without the effect, clamped to the physical range; the typical value for a
/// parameter that is no size.
pub fn neutral(parameter: &Parameter) -> f64 {
    match parameter.role {
        Role::Size { neutral } => neutral.clamp(parameter.range[0], parameter.range[1]),
        _ => parameter.typical,
    }
}

/// Distance of an effect's parameter from its neutral value.
pub fn beyond_none(effect: &ActiveEffect, place: usize) -> f64 {
    effect.values()[place] - neutral(&effect.card().parameters[place])
}

/// Distance of the typical from the neutral size, in the parameter's unit.
pub fn typical_size(parameter: &Parameter) -> f64 {
    match parameter.role {
        Role::Size { neutral } => (parameter.typical - neutral).abs(),
        _ => parameter.typical.abs(),
    }
}

/// Largest distance of a parameter from its neutral value.
pub fn largest_size(parameter: &Parameter) -> f64 {
    let [low, high] = parameter.range;
    (high - neutral(parameter)).max(neutral(parameter) - low)
}

impl Hypothesis {
    /// The hypothesis of a vehicle file.
    pub fn filed(file: &VehicleFile, settings: &settings::Prior) -> Self {
        let VehicleFile { vehicle, effects, .. } = file.clone();
        let settings::Prior { max_friction_change, .. } = *settings;
        let (offset, cog_moved) = ([0.0; 3], [0.0; 2]);
        Self {
            vehicle,
            effects,
            offset,
            friction_level: 0.0,
            cog_moved,
            max_friction_change,
            starts: None,
        }
    }

    /// Departure of the twist (paper's frame) from the stationary one with which each run of this
    /// evidence begins; none where all begin in stationary motion.
    pub fn starts_in<'a>(&'a self, evidence: &'a Evidence) -> Option<&'a Arc<[Twist]>> {
        let is_of = |own: &&OwnStarts| Arc::ptr_eq(&own.samples, evidence.shared_samples());
        let own = self.starts.as_ref().filter(is_of);
        own.map(|own| &own.twists).or_else(|| evidence.starts())
    }

    /// The hypothesis in which the runs of this evidence begin with these departures.
    pub fn beginning(&self, evidence: &Evidence, twists: Vec<Twist>) -> Self {
        let samples = Arc::clone(evidence.shared_samples());
        Self { starts: Some(OwnStarts { samples, twists: twists.into() }), ..self.clone() }
    }

    /// Allowed range of an unknown.
    pub fn range(&self, unknown: Unknown) -> [f64; 2] {
        match (unknown, unknown.parameter()) {
            (Unknown::FrictionLevel, _) => [-self.max_friction_change, self.max_friction_change],
            (_, Some(parameter)) => parameter.range,
            (_, None) => [f64::NEG_INFINITY, f64::INFINITY],
        }
    }

    /// Value of an unknown; the neutral one where the effect is absent.
    pub fn get(&self, unknown: Unknown) -> f64 {
        match unknown {
            Unknown::Offset(k) => self.offset[k],
            Unknown::FrictionLevel => self.friction_level,
            Unknown::Cog(k) => self.cog_moved[k],
            Unknown::Effect(effect, parameter) => value(&self.effects, effect, parameter),
        }
    }

    /// The hypothesis with another value of an unknown, clamped to its range. An absent effect is
    /// added with neutral sizes and the typical values of all other parameters.
    pub fn with(&self, unknown: Unknown, value: f64) -> Self {
        let mut changed = self.clone();
        let [low, high] = self.range(unknown);
        let value = value.clamp(low, high);
        match unknown {
            Unknown::Offset(k) => changed.offset[k] = value,
            Unknown::FrictionLevel => {
                changed.vehicle = with_friction(&self.vehicle, value - self.friction_level);
                changed.friction_level = value;
            }
            Unknown::Cog(k) => {
                changed.vehicle.cog[k] += value - self.cog_moved[k];
                changed.cog_moved[k] = value;
            }
            Unknown::Effect(effect, parameter) => {
                let card = effect.card();
                let mut values: Vec<f64> = match self.effect(effect) {
                    Some(active) => active.values().to_vec(),
                    None => card.parameters.iter().map(neutral).collect(),
                };
                values[parameter] = value;
                changed.effects.insert(active(effect, &values));
            }
        }
        changed
    }

    /// The effect, where it is active.
    pub fn effect(&self, effect: EffectId) -> Option<&ActiveEffect> {
        find(&self.effects, effect)
    }

    /// The hypothesis with an effect added or replaced.
    pub fn with_effect(&self, effect: ActiveEffect) -> Self {
        let mut changed = self.clone();
        changed.effects.insert(effect);
        changed
    }

    /// The hypothesis with an effect as in another hypothesis: absent where it is absent there.
    pub fn with_effect_of(&self, other: &Self, effect: EffectId) -> Self {
        match other.effect(effect) {
            Some(known) => self.with_effect(known.clone()),
            None => self.without(effect),
        }
    }

    /// The hypothesis without an effect.
    pub fn without(&self, effect: EffectId) -> Self {
        let others = self.effects.iter().filter(|active| active.effect() != effect);
        let effects = others.cloned().collect();
        Self { effects, ..self.clone() }
    }
}

/// The effect in a set, where it is active.
pub fn find(effects: &Effects, effect: EffectId) -> Option<&ActiveEffect> {
    effects.iter().find(|active| active.effect() == effect)
}

/// Value of an effect's parameter; the neutral one where the effect is absent.
pub fn value(effects: &Effects, effect: EffectId, parameter: usize) -> f64 {
    find(effects, effect).map_or_else(
        || neutral(&effect.card().parameters[parameter]),
        |active| active.values()[parameter],
    )
}

/// Numbers of effects that differ, with the difference from here to there; an absent effect has
/// the neutral ones.
pub fn differences(here: &Effects, there: &Effects) -> Vec<(Unknown, f64)> {
    let both: BTreeSet<EffectId> = here.iter().chain(there).map(ActiveEffect::effect).collect();
    let places = both
        .into_iter()
        .flat_map(|effect| (0..effect.card().parameters.len()).map(move |place| (effect, place)));
    let change = |(effect, place): (EffectId, usize)| {
        let [here, there] = [here, there].map(|effects| value(effects, effect, place));
        (Unknown::Effect(effect, place), there - here)
    };
    places.map(change).filter(|(_, change)| *change != 0.0).collect()
}

/// A vehicle with both friction coefficients multiplied by e^`level`.
pub fn with_friction(vehicle: &Vehicle, level: f64) -> Vehicle {
    let mut changed = vehicle.clone();
    changed.friction.across *= level.exp();
    changed.friction.along *= level.exp();
    changed
}

/// An effect at its typical size.
///
/// # Panics
/// Never: typical sizes are in range.
pub fn typical(effect: EffectId) -> ActiveEffect {
    ActiveEffect::of(effect, &[]).expect("typical sizes are in range")
}

/// An effect with sizes at a share of the typical ones, and the typical values of all other
/// parameters.
pub fn at_share(effect: EffectId, share: f64) -> ActiveEffect {
    let value = |parameter: &Parameter| {
        neutral(parameter) + share * (parameter.typical - neutral(parameter))
    };
    active(effect, &effect.card().parameters.iter().map(value).collect::<Vec<_>>())
}

/// An effect with these values, clamped into their physical ranges.
///
/// # Panics
/// Never: names and ranges are the catalogue's.
pub fn active(effect: EffectId, values: &[f64]) -> ActiveEffect {
    with_values(&typical(effect), values)
}

/// An effect with other values, clamped into their physical ranges.
///
/// # Panics
/// Never: names and ranges are the catalogue's.
pub fn with_values(effect: &ActiveEffect, values: &[f64]) -> ActiveEffect {
    let card = effect.card();
    let settings: Vec<(&str, f64)> = card
        .parameters
        .iter()
        .zip(values)
        .map(|(parameter, value)| {
            (parameter.key, value.clamp(parameter.range[0], parameter.range[1]))
        })
        .collect();
    ActiveEffect::of(effect.effect(), &settings).expect("values within the ranges of the card")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A step of a fit may be huge; with forces of 10³⁰ N a solve fails slowly.
    #[test]
    fn numbers_stay_within_what_they_may_be() {
        let settings = settings::Prior::default();
        let most = settings.max_friction_change;
        let filed = Hypothesis::filed(&VehicleFile::auriga_alpha(), &settings);
        let grip = |hypothesis: &Hypothesis| hypothesis.vehicle.friction.along;
        let raised = filed.with(Unknown::FrictionLevel, 70.0);
        assert_eq!(raised.friction_level, most);
        assert!((grip(&raised) / grip(&filed) - most.exp()).abs() < 1e-12);
        let lowered = raised.with(Unknown::FrictionLevel, -70.0);
        assert!((grip(&lowered) * grip(&raised) / grip(&filed).powi(2) - 1.0).abs() < 1e-12);
        assert_eq!(filed.with(Unknown::Offset(1), -7.0).offset[1], -7.0);
    }
}
