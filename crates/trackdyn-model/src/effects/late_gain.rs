//! Encoders whose scale changes while the robot drives.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Drive;
use trackdyn_core::PerSide;

/// A factor between encoder and belt speed on each side, from a time on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LateGain {
    factor: PerSide<f64>,
    from: f64,
}

impl Effect for LateGain {
    const CARD: Card = Card {
        id: "late-gain",
        title: "Belts faster or slower than before from a time on",
        law: "V = α (1 + (γ − 1) φ(t − t₀)) V_e, φ rises from 0 to 1 within 2 s",
        assumes: "One change at one time: a belt that jumped or came loose, a tyre that lost air, \
                  another setting of a motor controller.",
        shows: "Straight driving bends from a time on.",
        resembles: "A tyre that loses pressure.",
        breaks: &[Symmetry::Time],
        stages: &[Stage::Drive],
        parameters: &[
            Parameter {
                key: "left",
                symbol: "γ_l",
                unit: "1",
                meaning: "gain afterwards over gain before, left",
                role: Role::Size { neutral: 1.0 },
                range: [0.5, 2.0],
                typical: 0.97,
            },
            Parameter {
                key: "right",
                symbol: "γ_r",
                unit: "1",
                meaning: "gain afterwards over gain before, right",
                role: Role::Size { neutral: 1.0 },
                range: [0.5, 2.0],
                typical: 1.03,
            },
            Parameter {
                key: "from_s",
                symbol: "t₀",
                unit: "s",
                meaning: "middle of the change, since the start of the recording",
                role: Role::Time,
                range: [0.0, 1e6],
                typical: 60.0,
            },
        ],
        sources: &["Martinez et al., IJRR 24(10), 2005, eqs (20)-(21), with α of the time"],
    };

    const IS_RARE: bool = true;

    fn from_values(values: &[f64]) -> Self {
        Self { factor: PerSide::new(values[0], values[1]), from: values[2] }
    }

    fn drive(&self, drive: &mut Drive) {
        // γ and t₀
        drive.later.left *= self.factor.left;
        drive.later.right *= self.factor.right;
        drive.changes_at += self.from;
    }
}
