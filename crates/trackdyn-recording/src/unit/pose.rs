//! Units of positions.

use std::fmt;
use std::str::FromStr;
use trackdyn_core::named::by_name;

/// Unit of the positions of poses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PoseUnit {
    /// m.
    #[default]
    Metres,
    /// mm.
    Millimetres,
    /// cm.
    Centimetres,
    /// ft, of 0.3048 m.
    Feet,
    /// in, of 25.4 mm.
    Inches,
}

impl PoseUnit {
    /// All units.
    pub const ALL: [Self; 5] =
        [Self::Metres, Self::Millimetres, Self::Centimetres, Self::Feet, Self::Inches];

    /// Its name, as the option takes it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Metres => "m",
            Self::Millimetres => "mm",
            Self::Centimetres => "cm",
            Self::Feet => "ft",
            Self::Inches => "in",
        }
    }

    /// Its name in a sentence.
    pub fn word(self) -> &'static str {
        match self {
            Self::Metres => "metres",
            Self::Millimetres => "millimetres",
            Self::Centimetres => "centimetres",
            Self::Feet => "feet",
            Self::Inches => "inches",
        }
    }

    /// m per unit.
    pub fn factor(self) -> f64 {
        match self {
            Self::Metres => 1.0,
            Self::Millimetres => 1e-3,
            Self::Centimetres => 1e-2,
            Self::Feet => 0.3048,
            Self::Inches => 0.0254,
        }
    }

    /// What is said of positions that are so many times those of the tracks, where these are right;
    /// none where no unit is within this factor.
    pub(super) fn remedy(times: f64, allowed: impl Fn(f64) -> f64) -> Option<String> {
        let off = |unit: &Self| (times * unit.factor()).max(1.0 / (times * unit.factor()));
        let other = Self::ALL.into_iter().filter(|unit| *unit != Self::Metres);
        let near = other.filter(|unit| off(unit) <= allowed(1.0 / unit.factor()));
        let unit = near.min_by(|a, b| off(a).total_cmp(&off(b)))?;
        Some(format!(
            "where the track speeds are right, the positions look like {}: --pose-unit {unit} \
             reads them",
            unit.word()
        ))
    }
}

impl fmt::Display for PoseUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for PoseUnit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        by_name(&Self::ALL, Self::name, text)
    }
}
