//! What a reader, and a blind trial, see of a mechanism.

mod draw;
mod trial;

pub use draw::{Anchor, Draw, Role, Scale};
pub use trackdyn_model::effect::Symmetry;
pub use trial::{Concealment, Filed, Identifiability, InstrumentError, Trial};

/// Description of a mechanism and its parameters.
#[derive(Debug, PartialEq)]
pub struct Sheet {
    /// Name, kebab-case; that of the effect where the catalogue has the same physics.
    pub id: &'static str,
    /// Whether the catalogue of effects knows this physics.
    pub origin: Origin,
    /// The law of this crate.
    pub law: &'static str,
    /// How its size compares with that of the catalogue's law, or where it stems from.
    pub size: &'static str,
    /// Whether its parameters mean what those of the catalogue's law mean, so that an estimate by
    /// the one can be compared with the value of the other.
    pub shares_size: bool,
    /// The other laws under this name, where nature has more than one.
    pub family: Option<Family>,
    /// Symmetries of the ICR triple that it breaks.
    pub breaks: &'static [Symmetry],
    /// What a blind trial does with it.
    pub trial: Trial,
    /// Parameters, in the order in which the law takes them.
    pub parameters: &'static [Parameter],
}

impl Sheet {
    /// The keys of the parameters, separated by commas.
    pub fn keys(&self) -> String {
        self.parameters.iter().map(|parameter| parameter.key).collect::<Vec<_>>().join(", ")
    }

    /// The parameter of this key.
    pub fn parameter(&self, key: &str) -> Option<&'static Parameter> {
        self.parameters.iter().find(|parameter| parameter.key == key)
    }

    /// Whether it belongs to the class of constants: effects that move the constant ICRs and
    /// nothing else. ICRs that are constant break the mirror alone, where they lie unevenly.
    pub fn is_constant(&self) -> bool {
        self.origin == Origin::Catalogue
            && self.breaks.iter().all(|broken| *broken == Symmetry::Mirror)
    }

    /// Whether it is an error of an instrument.
    pub fn is_instrument(&self) -> bool {
        matches!(self.trial, Trial::Instrument(_))
    }
}

/// A family of laws under one name, of which a number draws one. All have the symmetries and the
/// parameters of the sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Family {
    /// What is drawn.
    pub law: &'static str,
    /// What a size means in all of them.
    pub size: &'static str,
    /// Whether that is what it means in the catalogue, as [`Sheet::shares_size`].
    pub shares_size: bool,
}

/// Whether a diagnosis can name a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The catalogue of effects has this physics under the same id.
    Catalogue,
    /// No catalogue has it: the right answer is that something unknown is there, and where.
    Outside,
}

/// A parameter of a mechanism.
#[derive(Debug, PartialEq)]
pub struct Parameter {
    /// Name; ends in the unit where there is one.
    pub key: &'static str,
    /// Unit, `1` for pure numbers.
    pub unit: &'static str,
    /// Smallest and largest value that is physical.
    pub range: [f64; 2],
    /// A size that a roboticist may meet.
    pub typical: f64,
    /// How a blind trial draws its value.
    pub draw: Draw,
}
