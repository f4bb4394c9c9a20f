//! Limits of settings.

use crate::Error;
use std::fmt::{Display, Formatter, Result};
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

impl Limits {
    /// Whether a value lies within them.
    pub fn hold(&self, value: f64) -> bool {
        (self.least..=self.most).contains(&value)
    }

    /// A value of a setting that lies within them.
    ///
    /// # Errors
    /// [`Error::OutOfLimits`].
    pub fn check(self, setting: &'static str, value: f64) -> std::result::Result<f64, Error> {
        let refused = Error::OutOfLimits { setting, value, limits: self };
        self.hold(value).then_some(value).ok_or(refused)
    }

    /// A number of things that lies within them.
    ///
    /// # Errors
    /// [`Error::OutOfLimits`].
    pub fn check_count(
        self,
        setting: &'static str,
        count: usize,
    ) -> std::result::Result<usize, Error> {
        self.check(setting, real(count)).map(|_| count)
    }
}

impl Display for Limits {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let Self { least, most, unit } = self;
        write!(f, "{least} to {most}{}{unit}", if unit.is_empty() { "" } else { " " })
    }
}
