//! A share of cases with its interval.

use super::interval::clopper_pearson;
use trackdyn_core::real;

/// A share of cases.
#[derive(Clone, Debug, PartialEq)]
pub struct Rate {
    /// What is counted.
    pub name: String,
    /// Cases of which it is true.
    pub successes: usize,
    /// Cases that count.
    pub cases: usize,
}

impl Rate {
    /// A rate over cases that are told to succeed or not.
    pub(super) fn of(name: impl Into<String>, outcomes: impl IntoIterator<Item = bool>) -> Self {
        let mut rate = Self { name: name.into(), successes: 0, cases: 0 };
        for success in outcomes {
            rate.cases += 1;
            rate.successes += usize::from(success);
        }
        rate
    }

    /// The share; none without cases.
    pub fn share(&self) -> Option<f64> {
        (self.cases > 0).then(|| real(self.successes) / real(self.cases))
    }

    /// Its interval of 95 %.
    pub fn interval(&self) -> Option<[f64; 2]> {
        clopper_pearson(self.successes, self.cases)
    }
}
