//! Centripetal force of the turning body.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::{RigidBody, Situation};
use trackdyn_core::{PerSide, Scalar, Wrench};

/// The centripetal force on the centre of gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Centripetal {
    strength: f64,
}

impl Effect for Centripetal {
    const CARD: Card = Card {
        id: "centripetal",
        title: "Centripetal force of the turning body",
        law: "F = −k m a, a = ω × v_cog, at the centre of gravity",
        assumes: "Stationary motion. k = 1 where the vehicle's absolute friction is right: the \
                  force is felt in units of the friction μ m g, so k also absorbs a common error \
                  of μ_x and μ_y.",
        shows: "Fast turns: y grows with speed and changes sides between forward and reverse. It \
                makes the absolute friction visible.",
        resembles: "Frames that give way, so that the tracks splay in quick turns.",
        breaks: &[Symmetry::SpeedScale, Symmetry::Reversal, Symmetry::Manoeuvre],
        stages: &[Stage::Wrench],
        parameters: &[Parameter {
            key: "strength",
            symbol: "k",
            unit: "1",
            meaning: "ratio of the force to m a",
            role: Role::Size { neutral: 0.0 },
            range: [0.0, 10.0],
            typical: 1.0,
        }],
        sources: &["Newton's second law in the body's axes; left out in eqs (14)-(15)"],
    };

    const IS_INERTIA: bool = true;

    fn from_values(values: &[f64]) -> Self {
        Self { strength: values[0] }
    }

    fn rigid_body(&self, body: &mut RigidBody) {
        body.steady_inertia = Some(body.steady_inertia.unwrap_or(0.0) + self.strength);
    }

    fn wrench<S: Scalar>(
        &self,
        situation: &Situation<S>,
        _normal_load: &PerSide<S>,
        wrench: &mut Wrench<S>,
    ) {
        // F = −k m a
        let factor = -self.strength * situation.vehicle.mass;
        let force = situation.steady_acceleration().map(|a| a * factor);
        wrench.add_force(force, situation.vehicle.cog);
    }
}
