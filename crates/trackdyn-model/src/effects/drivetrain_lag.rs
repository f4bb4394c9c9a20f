//! Belts that follow the encoders with a lag.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Drive;

/// First-order response of the belts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrivetrainLag {
    time_constant: f64,
}

impl Effect for DrivetrainLag {
    const CARD: Card = Card {
        id: "drivetrain-lag",
        title: "Belts that follow the encoders with a lag",
        law: "T dV/dt = V_e − V",
        assumes: "First order, the same on both sides: elastic belts and gears behind the encoder, \
                  or speeds that were commanded and not measured.",
        shows: "Nothing at constant speeds; where they change, a delay of T. Frequent poses tell \
                it from a clock offset, poses every few T do not.",
        resembles: "A slow controller, or a filter of the encoders.",
        breaks: &[Symmetry::Transient],
        stages: &[Stage::Drive],
        parameters: &[Parameter {
            key: "time_constant_s",
            symbol: "T",
            unit: "s",
            meaning: "time in which 63 % of a step are done",
            role: Role::Size { neutral: 0.0 },
            range: [0.0, 2.0],
            typical: 0.15,
        }],
        sources: &["First-order lag of a driven inertia behind an elastic transmission"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { time_constant: values[0] }
    }

    fn drive(&self, drive: &mut Drive) {
        // T dV/dt = V_e − V
        drive.time_constant.left += self.time_constant;
        drive.time_constant.right += self.time_constant;
    }
}
