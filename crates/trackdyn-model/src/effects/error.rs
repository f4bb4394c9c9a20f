//! Errors in the choice of an effect.

use super::CATALOGUE;
use crate::effect::{Card, Parameter};

/// An effect that cannot be activated as requested.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum EffectError {
    /// No such id, in the catalogue or of a registered law.
    UnknownEffect {
        /// Requested id.
        id: String,
    },
    /// The effect has no such parameter.
    UnknownParameter {
        /// The effect.
        card: &'static Card,
        /// Requested key.
        key: String,
    },
    /// A value outside the physical range.
    OutOfRange {
        /// The effect.
        card: &'static Card,
        /// The parameter.
        parameter: &'static Parameter,
        /// Requested value.
        value: f64,
    },
    /// A parameter that was given twice.
    Repeated {
        /// The effect.
        card: &'static Card,
        /// The parameter.
        parameter: &'static Parameter,
    },
    /// A text that is not of the form `id:key=value,...`.
    Malformed {
        /// The text.
        text: String,
    },
}

impl std::error::Error for EffectError {}

impl std::fmt::Display for EffectError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::UnknownEffect { id: text } | Self::Malformed { text } => {
                write!(f, "effect \"{text}\"")
            }
            Self::UnknownParameter { card, key } => write!(f, "effect \"{}\": {key}", card.id),
            Self::OutOfRange { card, parameter, value } => {
                write!(f, "effect \"{}\": {} = {value}", card.id, parameter.key)
            }
            Self::Repeated { card, parameter } => {
                write!(f, "effect \"{}\": {} given twice", card.id, parameter.key)
            }
        }?;
        write!(f, ": expected {}", self.expected())
    }
}

impl EffectError {
    /// Nearest valid alternative.
    pub fn expected(&self) -> String {
        match self {
            Self::UnknownEffect { id } => {
                let ids = CATALOGUE.iter().map(|card| card.id);
                let near = nearest(id, ids);
                format!("an effect of the catalogue, such as \"{near}\", or a law defined here")
            }
            Self::UnknownParameter { card, key } => {
                let keys = || card.parameters.iter().map(|parameter| parameter.key);
                let all = keys().collect::<Vec<_>>().join(", ");
                format!("a parameter of {} ({all}), such as \"{}\"", card.id, nearest(key, keys()))
            }
            Self::OutOfRange { parameter, .. } => {
                let [low, high] = parameter.range;
                let unit = parameter.unit_behind();
                format!("{}, between {low} and {high}{unit}", parameter.meaning)
            }
            Self::Repeated { .. } => "each parameter once".to_owned(),
            Self::Malformed { .. } => {
                "the form id or id:parameter=number,parameter=number".to_owned()
            }
        }
    }
}

/// The most similar of the names.
fn nearest(name: &str, names: impl Iterator<Item = &'static str>) -> &'static str {
    let similarity = |candidate: &&str| strsim::jaro_winkler(name, candidate);
    names.max_by(|a, b| similarity(a).total_cmp(&similarity(b))).unwrap_or_default()
}
