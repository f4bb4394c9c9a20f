//! Derivatives of the inertial departure by parameters.

use super::coarse;
use super::simulated::{Case, Inertia, size, typical};
use crate::hypothesis::{Unknown, find, with_friction, with_values};
use rayon::prelude::*;
use std::sync::Arc;
use trackdyn_core::Twist;
use trackdyn_model::transient::Step;
use trackdyn_model::{ActiveEffect, Model};

/// Derivative of the departure by one parameter.
pub struct Slope {
    pub by: Unknown,
    /// Where it was computed.
    pub at: Arc<Inertia>,
    /// Change of each sample per unit of the parameter.
    pub change: Vec<Twist>,
}

/// Derivatives of the departure at a simulated motion by these parameters, at a pose delay of
/// `delay`, s; none by a parameter that cannot be changed. `steps` are those of the motion.
pub fn slopes(
    by: &[Unknown],
    (at, steps): (&Arc<Inertia>, &[Vec<Step>]),
    case: &Case,
    delay: f64,
) -> Vec<Slope> {
    let stepped = |&by: &Unknown| {
        let step = [1.0, -1.0].into_iter().find_map(|sign| stepped(by, case, sign));
        step.map(|(model, step)| (by, model, step))
    };
    let (mut parameters, mut others) = (Vec::new(), Vec::new());
    for (by, model, step) in by.iter().filter_map(stepped) {
        parameters.push((by, step));
        others.push(model);
    }
    let changes = at.changes_by(&others, steps);
    let slope = |((by, step), change): ((Unknown, f64), &Vec<Vec<Twist>>)| {
        let samples = case.evidence.samples().iter();
        let of = |sample| at.mean_over(sample, delay, change) * step.recip();
        Slope { by, at: Arc::clone(at), change: samples.map(of).collect() }
    };
    parameters.into_par_iter().zip(&changes).map(slope).collect()
}

/// The model with one parameter changed by a step of this sign, and the step; none where it would
/// leave its physical range.
fn stepped(by: Unknown, case: &Case, sign: f64) -> Option<(Model, f64)> {
    let (vehicle, effects) = (case.vehicle, case.model.effects());
    let settings = case.settings();
    let step = sign * settings.departure_difference * size(by, vehicle, settings);
    match by {
        Unknown::Offset(_) => None,
        Unknown::Cog(axis) => {
            let mut moved = vehicle.clone();
            moved.cog[axis] += step;
            Some((coarse(&moved, effects.clone()), step))
        }
        Unknown::FrictionLevel => {
            Some((coarse(&with_friction(vehicle, step), effects.clone()), step))
        }
        Unknown::Effect(effect, place) => {
            let moved = moved(find(effects, effect)?, place, step)?;
            let mut effects = effects.clone();
            effects.insert(moved);
            Some((coarse(vehicle, effects), step))
        }
    }
}

/// An effect with one number changed by a step; none where it would leave its physical range.
pub fn moved(effect: &ActiveEffect, place: usize, step: f64) -> Option<ActiveEffect> {
    let mut values = effect.values().to_vec();
    let [low, high] = effect.card().parameters[place].range;
    values[place] += step;
    (low..=high).contains(&values[place]).then(|| with_values(effect, &values))
}

/// Whether the departure can be differentiated by a parameter: one whose typical size is zero has
/// no step, and counts as near only if equal.
pub fn has_slope(by: Unknown, model: &Model) -> bool {
    match by {
        Unknown::Offset(_) => false,
        Unknown::FrictionLevel | Unknown::Cog(_) => true,
        Unknown::Effect(effect, _) => find(model.effects(), effect).is_some() && typical(by) > 0.0,
    }
}
