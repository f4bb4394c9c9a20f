//! Limits of settings.

use std::fmt::{Display, Formatter, Result};

/// The least and the largest value that a setting accepts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The least value.
    pub least: f64,
    /// The largest value.
    pub most: f64,
    /// Unit of both.
    pub unit: &'static str,
}

impl Limits {
    /// Whether a value lies within them.
    pub fn hold(&self, value: f64) -> bool {
        (self.least..=self.most).contains(&value)
    }
}

impl Display for Limits {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let Self { least, most, unit } = self;
        write!(f, "{least} to {most} {unit}")
    }
}
