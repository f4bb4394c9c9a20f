//! Belts that follow their encoders otherwise when they run backward.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Drive;
use trackdyn_core::PerSide;

/// A factor between encoder and belt speed on each side, of belts that run backward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BackwardGain {
    factor: PerSide<f64>,
}

impl Effect for BackwardGain {
    const CARD: Card = Card {
        id: "backward-gain",
        title: "Belts faster or slower backward than the encoders show",
        law: "V = α β V_e, β_l and β_r for V_e < 0 and 1 for V_e ≥ 0",
        assumes: "Constant factors: a belt that climbs its teeth or slips one way, a counter that \
                  misses edges in one direction.",
        shows: "Right forward, wrong backward: straight reversing drives a curve, spins turn more \
                or less than they should.",
        resembles: "Belts that hang slack on one way.",
        breaks: &[Symmetry::Reversal, Symmetry::Manoeuvre, Symmetry::Mirror, Symmetry::Straight],
        stages: &[Stage::Drive],
        parameters: &[
            Parameter {
                key: "left",
                symbol: "β_l",
                unit: "1",
                meaning: "gain backward over gain forward, left",
                role: Role::Size { neutral: 1.0 },
                range: [0.5, 2.0],
                typical: 0.97,
            },
            Parameter {
                key: "right",
                symbol: "β_r",
                unit: "1",
                meaning: "gain backward over gain forward, right",
                role: Role::Size { neutral: 1.0 },
                range: [0.5, 2.0],
                typical: 1.03,
            },
        ],
        sources: &["Martinez et al., IJRR 24(10), 2005, eqs (20)-(21), with α of the direction"],
    };

    const IS_RARE: bool = true;

    fn from_values(values: &[f64]) -> Self {
        Self { factor: PerSide::new(values[0], values[1]) }
    }

    fn drive(&self, drive: &mut Drive) {
        // V = α β V_e
        drive.backward.left *= self.factor.left;
        drive.backward.right *= self.factor.right;
    }
}
