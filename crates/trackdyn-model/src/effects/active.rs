//! Active effects: effects with parameter values.

use super::{CATALOGUE, EffectError, EffectId, Law};
use crate::contact::ShearStress;
use crate::custom::ActiveLaw;
use crate::effect::{Card, Parameter, Symmetry};
use crate::pipeline::{Drive, Ground, RigidBody, Sensor, Site, Situation};
use crate::vehicle::Vehicle;
use trackdyn_core::{PerSide, Scalar, Wrench};

/// An effect with the values of its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct ActiveEffect {
    effect: EffectId,
    values: Vec<f64>,
    law: Law,
}

impl ActiveEffect {
    /// The effect `id` with `settings` (key, value). Parameters left out have their typical value;
    /// coefficients of a form are zero.
    ///
    /// # Errors
    /// Unknown effect or parameter (with the nearest name), a parameter given twice, or a value
    /// outside its physical range.
    pub fn new(id: &str, settings: &[(&str, f64)]) -> Result<Self, EffectError> {
        Self::of(id.parse()?, settings)
    }

    /// This effect with `settings` (key, value), as for [`ActiveEffect::new`].
    ///
    /// # Errors
    /// Those of [`ActiveEffect::new`], but for an unknown effect.
    pub fn of(effect: EffectId, settings: &[(&str, f64)]) -> Result<Self, EffectError> {
        let card = effect.card();
        let mut values: Vec<Option<f64>> = vec![None; card.parameters.len()];
        for &(key, value) in settings {
            let position = card
                .parameters
                .iter()
                .position(|parameter| parameter.key == key)
                .ok_or_else(|| EffectError::UnknownParameter { card, key: key.to_owned() })?;
            let parameter = &card.parameters[position];
            let [low, high] = parameter.range;
            if !(low..=high).contains(&value) {
                return Err(EffectError::OutOfRange { card, parameter, value });
            }
            if values[position].replace(value).is_some() {
                return Err(EffectError::Repeated { card, parameter });
            }
        }
        let values: Vec<f64> = values
            .into_iter()
            .zip(card.parameters)
            .map(|(value, parameter)| value.unwrap_or_else(|| card.default_of(parameter)))
            .collect();
        Ok(Self { effect, law: Law::from_values(effect, &values), values })
    }

    /// The effect.
    pub fn effect(&self) -> EffectId {
        self.effect
    }

    /// The effect's card.
    pub fn card(&self) -> &'static Card {
        self.effect.card()
    }

    /// Parameter values in the order and units of the card.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Parameters that a text must state: all of a mechanism, and the nonzero ones of a form.
    pub fn stated(&self) -> impl Iterator<Item = (&'static Parameter, f64)> {
        let card = self.card();
        let values = card.parameters.iter().zip(self.values.iter().copied());
        values.filter(|(parameter, value)| !card.is_form() || *value != card.default_of(parameter))
    }
}

/// `id:key=value,key=value`, the form that the command line takes.
impl std::fmt::Display for ActiveEffect {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.card().id)?;
        for (k, (parameter, value)) in self.stated().enumerate() {
            let separator = if k == 0 { ':' } else { ',' };
            write!(f, "{separator}{}={value}", parameter.key)?;
        }
        Ok(())
    }
}

/// Reads `id` or `id:key=value,key=value`.
impl std::str::FromStr for ActiveEffect {
    type Err = EffectError;

    fn from_str(text: &str) -> Result<Self, EffectError> {
        let malformed = || EffectError::Malformed { text: text.to_owned() };
        let (id, settings) = text.split_once(':').map_or((text, None), |(id, s)| (id, Some(s)));
        let settings = settings
            .map(|settings| settings.split(','))
            .into_iter()
            .flatten()
            .map(|setting| {
                let (key, value) = setting.split_once('=').ok_or_else(malformed)?;
                let value = value.trim().parse().map_err(|_| malformed())?;
                Ok((key.trim(), value))
            })
            .collect::<Result<Vec<_>, EffectError>>()?;
        Self::new(id.trim(), &settings)
    }
}

/// The effects of a model, each at most once, in the catalogue's order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Effects(Vec<ActiveEffect>);

impl Effects {
    /// No effects: the base model.
    pub fn none() -> Self {
        Self::default()
    }

    /// Adds the missing terms of Newton's second law, with typical sizes.
    ///
    /// # Panics
    /// Never: all are in the catalogue, with typical sizes in range.
    pub fn with_inertia(mut self) -> Self {
        for card in CATALOGUE.iter().filter(|card| card.is_inertia()) {
            if self.get(card.id).is_none() {
                let typical = ActiveEffect::new(card.id, &[]);
                self.insert(typical.expect("typical sizes are in range"));
            }
        }
        self
    }

    /// Removes inertia against changes of speed: the motion is then always the stationary one. The
    /// inertial forces of a steady turn stay.
    pub fn quasi_static(mut self) -> Self {
        let is_kept = |card: &Card| !card.is_inertia() || card.breaks != [Symmetry::Transient];
        self.0.retain(|effect| is_kept(effect.card()));
        self
    }

    /// Whether one is a law of a user whose calls take long, so that works that go on
    /// [`together`](crate::custom::together) share them.
    pub fn share_calls(&self) -> bool {
        self.0.iter().filter_map(ActiveEffect::custom).any(ActiveLaw::is_shared)
    }

    /// Adds an effect; it replaces one of the same id.
    pub fn insert(&mut self, effect: ActiveEffect) {
        if effect.effect.custom().is_some() {
            // A law that was registered again has another number.
            self.0.retain(|present| present.card().id != effect.card().id);
        }
        match self.0.binary_search_by_key(&effect.effect, |present| present.effect) {
            Ok(position) => self.0[position] = effect,
            Err(position) => self.0.insert(position, effect),
        }
    }

    /// The effect of this id, if active.
    pub fn get(&self, id: &str) -> Option<&ActiveEffect> {
        self.iter().find(|effect| effect.card().id == id)
    }

    /// The effects, in the catalogue's order.
    pub fn iter(&self) -> std::slice::Iter<'_, ActiveEffect> {
        self.0.iter()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<'a> IntoIterator for &'a Effects {
    type Item = &'a ActiveEffect;
    type IntoIter = std::slice::Iter<'a, ActiveEffect>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl FromIterator<ActiveEffect> for Effects {
    fn from_iter<I: IntoIterator<Item = ActiveEffect>>(effects: I) -> Self {
        let mut all = Self::none();
        for effect in effects {
            all.insert(effect);
        }
        all
    }
}

/// The hooks, forwarded to the law.
impl ActiveEffect {
    pub(crate) fn body(&self, vehicle: &mut Vehicle) {
        self.law.body(vehicle);
    }

    pub(crate) fn drive(&self, drive: &mut Drive) {
        self.law.drive(drive);
    }

    pub(crate) fn sense(&self, sensor: &mut Sensor) {
        self.law.sense(sensor);
    }

    pub(crate) fn rigid_body(&self, body: &mut RigidBody) {
        self.law.rigid_body(body);
    }

    pub(crate) fn ground(&self, ground: &mut Ground) {
        self.law.ground(ground);
    }

    #[inline]
    pub(crate) fn load<S: Scalar>(
        &self,
        situation: &Situation<S>,
        centre_of_pressure: &mut [S; 2],
    ) {
        self.law.load(situation, centre_of_pressure);
    }

    #[inline]
    pub(crate) fn shear<S: Scalar>(&self, site: &Site<S>, stress: &mut ShearStress<S>) {
        self.law.shear(site, stress);
    }

    /// The law of a user that it is, whose friction is found for many points at once.
    pub(crate) fn custom(&self) -> Option<&ActiveLaw> {
        match &self.law {
            Law::Custom(law) => Some(law),
            _ => None,
        }
    }

    #[inline]
    pub(crate) fn wrench<S: Scalar>(
        &self,
        situation: &Situation<S>,
        normal_load: &PerSide<S>,
        wrench: &mut Wrench<S>,
    ) {
        self.law.wrench(situation, normal_load, wrench);
    }
}
