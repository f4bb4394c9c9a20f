//! Parameters of a law as a user declares them.

use crate::effect::{Parameter, Role};

/// A parameter of a law of a user.
#[derive(Clone, Debug, PartialEq)]
pub struct Declared {
    /// Name in files: small letters, digits and underscores.
    pub key: String,
    /// Unit, `1` for pure numbers.
    pub unit: String,
    /// Description; the key where it is empty.
    pub meaning: String,
    /// Role in the law.
    pub role: Role,
    /// Smallest and largest physical value; infinite where there is no limit.
    pub range: [f64; 2],
    /// Typical value; the default. A diagnosis begins here, and expects a few times it.
    pub typical: f64,
}

/// Size of a value without a limit, in typical ones. Searches expect a few typical sizes, and call
/// an end of a range what is less than a millionth of it away.
const UNLIMITED_SIZE: f64 = 1000.0;

/// A law that cannot be defined so.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DefinitionError {
    /// A name that files could not hold.
    #[error("law {id:?}: expected small letters and digits joined by hyphens, such as \"my-drag\"")]
    Id {
        /// The name.
        id: String,
    },
    /// A name that the catalogue has.
    #[error("law {id:?}: an effect of the catalogue: expected another name")]
    InCatalogue {
        /// The name.
        id: String,
    },
    /// A parameter whose key files could not hold, or that is there twice.
    #[error(
        "law {id:?}, parameter {key:?}: expected small letters, digits and underscores, and each \
         parameter once"
    )]
    Key {
        /// The law.
        id: String,
        /// The key.
        key: String,
    },
    /// A typical value outside the range, or a range that is none.
    #[error(
        "law {id:?}, parameter {key}: typical value {typical} and range {low} to {high}: expected \
         numbers in ascending order low, typical, high"
    )]
    Range {
        /// The law.
        id: String,
        /// The parameter.
        key: String,
        /// The typical value.
        typical: f64,
        /// The smallest value.
        low: f64,
        /// The largest value.
        high: f64,
    },
    /// A typical size at which there is no effect.
    #[error(
        "law {id:?}, parameter {key}: typical value {typical}: expected another than the \
             neutral one, at which the law does nothing"
    )]
    Neutral {
        /// The law.
        id: String,
        /// The parameter.
        key: String,
        /// The typical value.
        typical: f64,
    },
    /// No size among the parameters.
    #[error("law {id:?}: no parameter is a size: expected one that can make the law do nothing")]
    NoSize {
        /// The law.
        id: String,
    },
}

impl Declared {
    /// A size: at zero the law does nothing. It may be any number.
    pub fn size(key: &str, unit: &str, typical: f64) -> Self {
        let range = [f64::NEG_INFINITY, f64::INFINITY];
        let (key, unit, meaning) = (key.to_owned(), unit.to_owned(), String::new());
        Self { key, unit, meaning, role: Role::Size { neutral: 0.0 }, range, typical }
    }

    /// With this range.
    #[must_use]
    pub fn within(self, range: [f64; 2]) -> Self {
        Self { range, ..self }
    }

    /// The parameter of a card, which lasts as long as the process.
    pub(super) fn parameter(&self) -> Parameter {
        let meaning = if self.meaning.is_empty() { &self.key } else { &self.meaning };
        // places, directions and times as in the catalogue
        let most = match self.role {
            Role::Place { .. } => 1e4,
            Role::Direction => 360.0,
            Role::Time => 1e6,
            Role::Size { .. } | Role::Shape if self.typical == 0.0 => UNLIMITED_SIZE,
            Role::Size { .. } | Role::Shape => UNLIMITED_SIZE * self.typical.abs(),
        };
        Parameter {
            key: lasting(&self.key),
            symbol: lasting(&self.key),
            unit: lasting(&self.unit),
            meaning: lasting(meaning),
            role: self.role,
            range: self.range.map(|end| if end.is_infinite() { most.copysign(end) } else { end }),
            typical: self.typical,
        }
    }
}

/// A text that lasts as long as the process.
pub(super) fn lasting(text: &str) -> &'static str {
    Box::leak(text.to_owned().into_boxed_str())
}

/// Checks the name and the parameters of a law.
pub(super) fn check(id: &str, parameters: &[Declared]) -> Result<(), DefinitionError> {
    let id = id.to_owned();
    let is_word = |text: &str, others: fn(char) -> bool| {
        text.starts_with(|first: char| first.is_ascii_lowercase()) && text.chars().all(others)
    };
    let is_kebab = |one: char| one.is_ascii_lowercase() || one.is_ascii_digit() || one == '-';
    if !is_word(&id, is_kebab) || id.ends_with('-') {
        return Err(DefinitionError::Id { id });
    }
    let is_snake = |one: char| one.is_ascii_lowercase() || one.is_ascii_digit() || one == '_';
    for (place, parameter) in parameters.iter().enumerate() {
        let Declared { key, range: [low, high], typical, .. } = parameter;
        let (key, low, high, typical) = (key.clone(), *low, *high, *typical);
        let is_double = parameters[..place].iter().any(|other| other.key == key);
        if !is_word(&key, is_snake) || is_double {
            return Err(DefinitionError::Key { id, key });
        }
        if !(low < high && (low..=high).contains(&typical) && typical.is_finite()) {
            return Err(DefinitionError::Range { id, key, typical, low, high });
        }
        if matches!(parameter.role, Role::Size { neutral } if neutral == typical) {
            return Err(DefinitionError::Neutral { id, key, typical });
        }
    }
    if parameters.iter().any(|one| matches!(one.role, Role::Size { .. })) {
        Ok(())
    } else {
        Err(DefinitionError::NoSize { id })
    }
}
