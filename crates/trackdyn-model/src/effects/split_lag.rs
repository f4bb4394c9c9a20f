//! One belt that follows its encoder later than the other.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Drive;

/// A first-order lag of one side alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplitLag {
    left: f64,
}

impl Effect for SplitLag {
    const CARD: Card = Card {
        id: "split-lag",
        title: "One belt that follows later than the other",
        law: "T_l = T + max(δ, 0), T_r = T + max(−δ, 0),  T dV/dt = V_e − V",
        assumes: "First order: a loose belt, a slower motor controller, messages of one side that \
                  come late.",
        shows: "Nothing at constant speeds; where both change alike, the robot turns for the time \
                δ.",
        resembles: "Play in the gears of one side.",
        breaks: &[Symmetry::Transient],
        stages: &[Stage::Drive],
        parameters: &[
            Parameter {
                key: "left_s",
                symbol: "δ",
                unit: "s",
                meaning: "lag of the left belt behind the right one",
                role: Role::Size { neutral: 0.0 },
                range: [-2.0, 2.0],
                typical: 0.1,
            },
        ],
        sources: &["First-order lag of a driven inertia behind an elastic transmission"],
    };

    const IS_RARE: bool = true;

    fn from_values(values: &[f64]) -> Self {
        Self { left: values[0] }
    }

    fn drive(&self, drive: &mut Drive) {
        // T_l + max(δ, 0), T_r + max(−δ, 0)
        drive.time_constant.left += self.left.max(0.0);
        drive.time_constant.right += (-self.left).max(0.0);
    }
}
