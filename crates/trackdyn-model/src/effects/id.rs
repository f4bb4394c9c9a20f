//! Identifier of an effect.

use super::{CATALOGUE, EffectError};
use crate::custom::{self, CustomLaw, DefinitionError};
use crate::effect::Card;
use std::fmt;
use std::str::FromStr;

/// An effect of the catalogue, or a [law of a user](crate::custom). Ordered as the catalogue, then
/// as registered; printed as its id in vehicle files.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EffectId {
    /// Index in [`CATALOGUE`]; from its length on, in the laws that were registered.
    index: usize,
}

impl EffectId {
    /// All effects of the catalogue, in its order.
    pub fn all() -> impl DoubleEndedIterator<Item = Self> + ExactSizeIterator {
        (0..CATALOGUE.len()).map(|index| Self { index })
    }

    /// The effect with this id of vehicle files, such as `yaw-inertia`; none where neither the
    /// catalogue nor a registered law has it.
    pub fn of(id: &str) -> Option<Self> {
        let index = CATALOGUE.iter().position(|card| card.id == id);
        let index = index.or_else(|| Some(CATALOGUE.len() + custom::named(id)?))?;
        Some(Self { index })
    }

    /// Registers a law of a user for the rest of the process: its id can be used like one of the
    /// catalogue. A law of the same id stays with the vehicles that have it; new ones get this.
    ///
    /// # Errors
    /// [`DefinitionError::InCatalogue`].
    pub fn register(law: CustomLaw) -> Result<Self, DefinitionError> {
        let id = law.card().id;
        if CATALOGUE.iter().any(|card| card.id == id) {
            return Err(DefinitionError::InCatalogue { id: id.to_owned() });
        }
        Ok(Self { index: CATALOGUE.len() + custom::register(law) })
    }

    /// Its card.
    pub fn card(self) -> &'static Card {
        match CATALOGUE.get(self.index) {
            Some(card) => card,
            None => self.custom().map_or(&CATALOGUE[0], CustomLaw::card),
        }
    }

    /// The law of a user that it is; none for an effect of the catalogue.
    pub fn custom(self) -> Option<&'static CustomLaw> {
        custom::numbered(self.index.checked_sub(CATALOGUE.len())?)
    }

    /// Its id in vehicle files.
    pub fn name(self) -> &'static str {
        self.card().id
    }

    /// Index of its constructor, nature and terms, in catalogue order.
    pub(super) fn index(self) -> usize {
        self.index
    }
}

impl fmt::Display for EffectId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl fmt::Debug for EffectId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Reads the id of vehicle files.
impl FromStr for EffectId {
    type Err = EffectError;

    fn from_str(id: &str) -> Result<Self, EffectError> {
        Self::of(id).ok_or_else(|| EffectError::UnknownEffect { id: id.to_owned() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_effect_is_read_from_what_it_is_written_as() {
        let all: Vec<EffectId> = EffectId::all().collect();
        assert_eq!(all.len(), CATALOGUE.len());
        assert!(all.is_sorted());
        for (effect, card) in all.into_iter().zip(CATALOGUE) {
            assert_eq!(effect.card().id, card.id);
            assert_eq!(effect.to_string().parse(), Ok(effect));
        }
        assert_eq!(
            "no-effect".parse::<EffectId>(),
            Err(EffectError::UnknownEffect { id: "no-effect".to_owned() })
        );
    }
}
