//! Identifier of a catalogue effect.

use super::{CATALOGUE, EffectError};
use crate::effect::Card;
use std::fmt;
use std::str::FromStr;

/// An effect of the catalogue. Ordered as the catalogue; printed as its id in vehicle files.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EffectId {
    /// Index in [`CATALOGUE`], below its length.
    index: usize,
}

impl EffectId {
    /// All effects, in the catalogue's order.
    pub fn all() -> impl DoubleEndedIterator<Item = Self> + ExactSizeIterator {
        (0..CATALOGUE.len()).map(|index| Self { index })
    }

    /// The effect with this id of vehicle files, such as `yaw-inertia`; none where the catalogue
    /// has no such effect.
    pub fn of(id: &str) -> Option<Self> {
        let index = CATALOGUE.iter().position(|card| card.id == id)?;
        Some(Self { index })
    }

    /// Its card.
    pub fn card(self) -> &'static Card {
        &CATALOGUE[self.index]
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
