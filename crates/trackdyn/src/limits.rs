//! Limits of settings.

use std::fmt::{self, Display, Formatter};
use trackdyn_core::real;

/// The least and the largest value that a setting accepts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The least value.
    pub least: f64,
    /// The largest value.
    pub most: f64,
    /// Unit of both; empty for numbers of things.
    pub unit: &'static str,
}

/// A setting outside its limits.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{setting} {value}: expected {limits}")]
pub struct OutOfLimits {
    /// The setting.
    pub setting: &'static str,
    /// Its value.
    pub value: f64,
    /// What it accepts.
    pub limits: Limits,
}

impl Limits {
    /// Whether a value lies within them.
    pub fn hold(&self, value: f64) -> bool {
        (self.least..=self.most).contains(&value)
    }

    /// A value of a setting that lies within them.
    ///
    /// # Errors
    /// [`OutOfLimits`].
    pub fn check(self, setting: &'static str, value: f64) -> Result<f64, OutOfLimits> {
        self.hold(value).then_some(value).ok_or(OutOfLimits { setting, value, limits: self })
    }

    /// A number of things that lies within them.
    ///
    /// # Errors
    /// [`OutOfLimits`].
    pub fn check_count(self, setting: &'static str, count: usize) -> Result<usize, OutOfLimits> {
        self.check(setting, real(count)).map(|_| count)
    }
}

impl Display for Limits {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { least, most, unit } = self;
        write!(f, "{least} to {most}{}{unit}", if unit.is_empty() { "" } else { " " })
    }
}
