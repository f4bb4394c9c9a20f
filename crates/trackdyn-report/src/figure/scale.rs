//! Colours that stand for values.

use super::Area;
use crate::colour::{ColourMap, Rgb};
use serde::{Deserialize, Serialize};

/// Colours for a range of values.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Scale {
    /// Colours of the range.
    pub colours: ColourMap,
    /// Values of the first and the last colour.
    pub range: [f64; 2],
    /// What the values are, with their unit.
    pub label: String,
}

impl Scale {
    /// These colours for this range.
    pub fn new(colours: ColourMap, range: [f64; 2], label: &str) -> Self {
        Self { colours, range, label: label.to_owned() }
    }

    /// Place of a value in the range, 0 to 1 inside.
    pub fn share(&self, value: f64) -> f64 {
        (value - self.range[0]) / (self.range[1] - self.range[0])
    }
}

/// A bar that shows a scale.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct ColourBar {
    /// Where it stands.
    pub place: Area,
    /// What it shows.
    pub scale: Scale,
}

/// Colours of the members of a series.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Paint {
    /// All alike.
    One(Rgb),
    /// One colour each.
    Each(Vec<Rgb>),
    /// The colour of its value each.
    Values {
        /// Values, one each.
        values: Vec<f64>,
        /// Their colours.
        scale: Scale,
    },
}

impl Paint {
    /// Colour of a member by its place in the series.
    pub fn colour(&self, member: usize) -> Rgb {
        match self {
            Self::One(colour) => *colour,
            Self::Each(colours) => colours[member],
            Self::Values { values, scale } => scale.colours.at(scale.share(values[member])),
        }
    }
}
