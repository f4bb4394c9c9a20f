//! A law of a user with values of its parameters, at the hooks of an effect.

use super::argument::{FORCE_COUNT, FRICTION_COUNT};
use super::differences::results;
use super::{CustomLaw, Kind};
use crate::contact::ShearStress;
use crate::pipeline::{Site, Situation};
use std::sync::Arc;
use trackdyn_core::{PerSide, Scalar, Wrench};

/// A law of a user with values of its parameters.
#[derive(Clone)]
pub struct ActiveLaw {
    law: &'static CustomLaw,
    values: Arc<[f64]>,
}

impl PartialEq for ActiveLaw {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.law, other.law) && self.values == other.values
    }
}

impl std::fmt::Debug for ActiveLaw {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple(self.law.card().id).field(&self.values).finish()
    }
}

impl ActiveLaw {
    /// The law with these values, in the order of its parameters.
    pub fn new(law: &'static CustomLaw, values: &[f64]) -> Self {
        Self { law, values: values.into() }
    }

    /// Whether works share its calls, see [`together`](super::together).
    pub(crate) fn is_shared(&self) -> bool {
        self.law.is_shared()
    }

    /// Stage `shear` at one point.
    #[cold]
    pub(crate) fn shear<S: Scalar>(&self, site: &Site<S>, stress: &mut ShearStress<S>) {
        for factors in self.factors(&[seen_at(site)]) {
            stress.scale_each(factors);
        }
    }

    /// Factors on the friction across and along the track, at points that were seen so.
    pub(crate) fn factors<S: Scalar>(&self, seen: &[[S; FRICTION_COUNT]]) -> Vec<[S; 2]> {
        if self.law.kind() != Kind::Friction || seen.is_empty() {
            return vec![[S::from(1.0); 2]; seen.len()];
        }
        let factors = results(self.law, &self.values, seen);
        factors.into_iter().map(|[along, across]| [across, along]).collect()
    }

    /// Stage `wrench`.
    #[cold]
    pub(crate) fn wrench<S: Scalar>(
        &self,
        situation: &Situation<S>,
        normal_load: &PerSide<S>,
        wrench: &mut Wrench<S>,
    ) {
        if self.law.kind() != Kind::Force {
            return;
        }
        let loads = [normal_load.left, normal_load.right];
        let seen = joined::<S, FORCE_COUNT>(motion(situation), loads);
        for [forward, lateral, moment] in results(self.law, &self.values, &[seen]) {
            // paper's frame: x right, y forward
            wrench.add_force([-lateral, forward], situation.vehicle.cog);
            wrench.moment += moment;
        }
    }
}

/// Arguments that all laws see.
fn motion<S: Scalar>(situation: &Situation<S>) -> [S; 9] {
    let motion = situation.motion;
    let [right, forward] = motion.twist.velocity_at(situation.vehicle.cog);
    let circumstance = &situation.ground.circumstance;
    let [x, y] = circumstance.position.map(S::from);
    [
        forward,
        -right,
        motion.twist.w,
        motion.belt_speed.left,
        motion.belt_speed.right,
        x,
        y,
        S::from(circumstance.heading),
        S::from(circumstance.time),
    ]
}

/// What a law of friction sees at a point.
pub(crate) fn seen_at<S: Scalar>(site: &Site<S>) -> [S; FRICTION_COUNT] {
    let speed = site.slip_field().speed;
    let [right, forward] = site.slip.unit_slip.map(|slip| slip * speed);
    let [point_right, point_forward] = site.slip.position;
    let circumstance = &site.situation.ground.circumstance;
    let ([x, y], (sin, cos)) = (circumstance.position, circumstance.heading.sin_cos());
    let contact = [
        forward,
        -right,
        site.slip_speed(),
        site.normal_pressure(),
        site.belt_speed(),
        point_forward,
        -point_right,
        point_forward * cos + point_right * sin + x,
        point_forward * sin - point_right * cos + y,
    ];
    joined::<S, FRICTION_COUNT>(motion(site.situation), contact)
}

/// Two lists in one.
fn joined<S: Scalar, const A: usize>(
    first: impl IntoIterator<Item = S>,
    second: impl IntoIterator<Item = S>,
) -> [S; A] {
    let mut all = [S::from(0.0); A];
    for (place, value) in all.iter_mut().zip(first.into_iter().chain(second)) {
        *place = value;
    }
    all
}
