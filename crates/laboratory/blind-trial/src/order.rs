//! What is asked of a trial.

use crate::driving::RUN_TIME;
use crate::forms::Forms;
use serde::{Deserialize, Serialize};

/// What is asked of a trial. With the key it determines every byte.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Order {
    /// Version of the program that makes it.
    pub version: String,
    /// Seed from which everything is drawn, together with the key; at most 2⁶³ - 1.
    pub seed: u64,
    /// Number of cases.
    pub cases: usize,
    /// Time of each run, s.
    pub run_time_s: f64,
    /// Which forms laws have.
    #[serde(default, skip_serializing_if = "Forms::is_plain")]
    pub forms: Forms,
}

impl Order {
    /// Time of a run where it is not the usual one, s.
    pub(crate) fn unusual_run_time(&self) -> Option<f64> {
        (self.run_time_s != RUN_TIME).then_some(self.run_time_s)
    }
}

impl std::fmt::Display for Order {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { version, seed, cases, run_time_s, forms } = self;
        write!(f, "{cases} cases with seed {seed}, runs of {run_time_s} s and {forms} forms, ")?;
        write!(f, "version {version}")
    }
}
