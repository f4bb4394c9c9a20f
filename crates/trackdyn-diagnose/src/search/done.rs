//! Cache of the refits of a search.
//!
//! Rounds of exchange and the verdicts ask for many refits again: the result depends only on the
//! hypothesis that it starts from and on the step.

use super::Found;
use crate::hypothesis::{Hypothesis, Unknown};
use std::sync::{Mutex, PoisonError};
use trackdyn_model::EffectId;

/// All refits of a search.
#[derive(Default)]
pub struct Done(Mutex<Vec<(Key, Found)>>);

/// What a refit depends on.
#[derive(PartialEq)]
pub enum Key {
    /// A step from another hypothesis.
    Step(Box<Start>, Step),
    /// These effects, from where an earlier search left them.
    Again(Vec<EffectId>),
}

/// Start of a refit.
#[derive(PartialEq)]
pub struct Start {
    from: Hypothesis,
    unknowns: Vec<Unknown>,
    /// Distinguishes starts that differ in their inertial departure.
    objective: f64,
}

/// What a refit changes.
#[derive(PartialEq)]
pub enum Step {
    /// Adds catalogue entries with these sizes.
    Add(Vec<(usize, Vec<f64>)>),
    /// Leaves out an effect.
    Leave(EffectId),
    /// Adds all effects of inertia, or what inertia does to the load.
    Newton,
}

impl Key {
    /// Key of a step from a hypothesis.
    pub fn step(from: &Found, step: Step) -> Self {
        let Found { fit, .. } = from;
        let (from, unknowns) = (fit.hypothesis.clone(), fit.unknowns.clone());
        Self::Step(Box::new(Start { from, unknowns, objective: fit.objective }), step)
    }
}

impl Done {
    /// The cached result of a refit, or that of running it now.
    pub fn or_else(&self, key: Key, refit: impl FnOnce() -> Found) -> Found {
        let known = self.known(&key);
        known.unwrap_or_else(|| {
            let found = refit();
            self.keep(key, &found);
            found
        })
    }

    /// Keeps the result of a refit.
    pub fn keep(&self, key: Key, found: &Found) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push((key, found.clone()));
    }

    /// All results.
    pub fn into_found(self) -> impl Iterator<Item = Found> {
        let done = self.0.into_inner().unwrap_or_else(PoisonError::into_inner);
        done.into_iter().map(|(_, found)| found)
    }

    fn known(&self, key: &Key) -> Option<Found> {
        let done = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        done.iter().find(|(other, _)| other == key).map(|(_, found)| found.clone())
    }
}
