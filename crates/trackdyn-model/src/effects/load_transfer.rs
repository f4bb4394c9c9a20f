//! Load transfer by a centre of gravity above the ground.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::{RigidBody, Situation};
use trackdyn_core::Scalar;

/// The weight shifts outwards in a turn, and downhill on a slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadTransfer {
    cog_height: f64,
}

impl Effect for LoadTransfer {
    const CARD: Card = Card {
        id: "load-transfer",
        title: "Load transfer of a centre of gravity above the ground",
        law: "(x_p, y_p) = (x_c, y_c) + h (g_along − a)/g_normal, a = ω × v_cog + dv_cog/dt",
        assumes: "The load shifts at once; a suspension that leans late differs only while speeds \
                  change. dv_cog/dt counts where inertia does. The pressure is linear along the \
                  part of the track that bears; what would have to pull has lifted.",
        shows: "Fast turns: the outer track gains load, so its ICR comes closer.",
        resembles: "A hull that leans on its suspension.",
        breaks: &[Symmetry::SpeedScale, Symmetry::Manoeuvre],
        stages: &[Stage::Load],
        parameters: &[Parameter {
            key: "cog_height_m",
            symbol: "h",
            unit: "m",
            meaning: "height of the centre of gravity above the ground",
            role: Role::Size { neutral: 0.0 },
            range: [0.0, 5.0],
            typical: 0.3,
        }],
        sources: &[
            "Balance of moments about the ground plane; Wong, Theory of Ground Vehicles, ch. 6",
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { cog_height: values[0] }
    }

    fn rigid_body(&self, body: &mut RigidBody) {
        body.cog_height += self.cog_height;
    }

    fn load<S: Scalar>(&self, situation: &Situation<S>, centre_of_pressure: &mut [S; 2]) {
        let ground = situation.ground;
        let (steady, transient) =
            (situation.steady_acceleration(), situation.transient_acceleration());
        for (axis, centre) in centre_of_pressure.iter_mut().enumerate() {
            let a = steady[axis] + transient[axis];
            // Δ(x_p, y_p) = h (g_along − a)/g_normal
            *centre +=
                (-a + ground.gravity_along[axis]) * (self.cog_height / ground.gravity_normal);
        }
    }
}
