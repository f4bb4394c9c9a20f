//! Inertia of the body against changes of motion.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::{RigidBody, Situation};
use trackdyn_core::{PerSide, Scalar, Wrench};

/// Mass and moment of inertia in transients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct YawInertia {
    strength: f64,
    gyration: f64,
}

impl Effect for YawInertia {
    const CARD: Card = Card {
        id: "yaw-inertia",
        title: "Inertia of the body in transients",
        law: "F = −k m dv_c/dt at the centre of gravity, M = −k m r² dω/dt; derivatives in the \
              body's axes",
        assumes: "Together with the centripetal force it is Newton's law in full. k = 1 where the \
                  vehicle's absolute friction is right.",
        shows: "The robot lags behind changes of the track speeds, most behind quick ones. Steady \
                turns do not show it.",
        resembles: "Motors and gears that are spun up with the tracks.",
        breaks: &[Symmetry::Transient],
        stages: &[Stage::Wrench],
        parameters: &[
            Parameter {
                key: "strength",
                symbol: "k",
                unit: "1",
                meaning: "ratio of the forces to those of mass m",
                role: Role::Size { neutral: 0.0 },
                range: [0.0, 10.0],
                typical: 1.0,
            },
            Parameter {
                key: "gyration_m",
                symbol: "r",
                unit: "m",
                meaning: "radius of gyration about the vertical",
                role: Role::Shape,
                range: [0.0, 5.0],
                typical: 0.3,
            },
        ],
        sources: &[
            "Martinez et al., IJRR 24(10), 2005, eqs (14)-(15) before the accelerations are set to \
             zero",
        ],
    };

    const IS_INERTIA: bool = true;

    fn from_values(values: &[f64]) -> Self {
        Self { strength: values[0], gyration: values[1] }
    }

    fn rigid_body(&self, body: &mut RigidBody) {
        body.transient_inertia = Some(body.transient_inertia.unwrap_or(0.0) + self.strength);
        body.gyration = Some(body.gyration.unwrap_or(0.0).hypot(self.gyration));
    }

    fn wrench<S: Scalar>(
        &self,
        situation: &Situation<S>,
        _normal_load: &PerSide<S>,
        wrench: &mut Wrench<S>,
    ) {
        let mass = self.strength * situation.vehicle.mass;
        // F = −k m dv_c/dt, M = −k m r² dω/dt
        let force = situation.transient_acceleration().map(|a| a * -mass);
        wrench.add_force(force, situation.vehicle.cog);
        wrench.moment += situation.motion.acceleration.w * (-mass * self.gyration.powi(2));
    }
}
