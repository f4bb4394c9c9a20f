//! What a search has refitted already.
//!
//! Rounds that exchange effects, and the verdicts after them, come to the same refits as rounds
//! before: from the same hypothesis the same step leads to the same end.

use super::Found;
use crate::hypothesis::{Hypothesis, Unknown};
use std::sync::{Mutex, PoisonError};
use trackdyn_model::EffectId;

/// All refits of a search.
#[derive(Default)]
pub struct Done(Mutex<Vec<(Key, Found)>>);

/// From where a refit begins.
#[derive(PartialEq)]
pub struct Key {
    from: Hypothesis,
    unknowns: Vec<Unknown>,
    /// It differs where what inertia adds does.
    objective: f64,
    step: Step,
}

/// What a refit changes.
#[derive(PartialEq)]
pub enum Step {
    /// Entries of the catalogue come in, with these sizes.
    Add(Vec<(usize, Vec<f64>)>),
    /// An effect is left out.
    Leave(EffectId),
}

impl Key {
    /// That of a step from a hypothesis.
    pub fn new(from: &Found, step: Step) -> Self {
        let Found { fit, .. } = from;
        let (from, unknowns) = (fit.hypothesis.clone(), fit.unknowns.clone());
        Self { from, unknowns, objective: fit.objective, step }
    }
}

impl Done {
    /// The end that a refit came to, or that of this one.
    pub fn or_else(&self, key: Key, refit: impl FnOnce() -> Found) -> Found {
        let known = self.known(&key);
        known.unwrap_or_else(|| {
            let found = refit();
            self.0.lock().unwrap_or_else(PoisonError::into_inner).push((key, found.clone()));
            found
        })
    }

    fn known(&self, key: &Key) -> Option<Found> {
        let done = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        done.iter().find(|(other, _)| other == key).map(|(_, found)| found.clone())
    }
}
