//! Friction that drifts with time.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Ground;
use trackdyn_core::Side;

/// A friction ratio that changes while the robot drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionDrift {
    rate: f64,
}

impl Effect for FrictionDrift {
    const CARD: Card = Card {
        id: "friction-drift",
        title: "Friction ratio that drifts with time",
        law: "μ_x ← (1 + r t) μ_x, not below a twentieth",
        assumes: "Linear in the time since the start of the recording: ground that dries or is \
                  worn, belts that warm up.",
        shows: "The ICRs move slowly in the course of a recording, wherever the robot is.",
        resembles: "Ground that dries, and tracks that warm.",
        breaks: &[Symmetry::Time],
        stages: &[Stage::Ground],
        parameters: &[Parameter {
            key: "rate_1_per_s",
            symbol: "r",
            unit: "1/s",
            meaning: "relative change of μ_x/μ_y per second",
            role: Role::Size { neutral: 0.0 },
            range: [-0.02, 0.02],
            typical: 0.001,
        }],
        sources: &["Martinez et al., IJRR 24(10), 2005, eq. (23) with [μ] of the time"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { rate: values[0] }
    }

    fn ground(&self, ground: &mut Ground) {
        // μ_x ← (1 + r t) μ_x
        let factor = (1.0 + self.rate * ground.circumstance.time).max(0.05);
        for side in Side::BOTH {
            ground.friction[side].across *= factor;
        }
    }
}
