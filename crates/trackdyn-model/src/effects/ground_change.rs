//! Ground that is another one between two times.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::{Ground, done_at};
use trackdyn_core::Side;

/// Another friction ratio between two times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundChange {
    factor: f64,
    from: f64,
    until: f64,
}

impl Effect for GroundChange {
    const CARD: Card = Card {
        id: "ground-change",
        title: "Another ground between two times",
        law: "μ_x ← κ^(φ(t − t₀) − φ(t − t₁)) μ_x, φ rises from 0 to 1 within 2 s",
        assumes: "One other ground, wherever the robot is: runs on grass among runs on asphalt, \
                  rain that begins.",
        shows: "The ICRs lie elsewhere between two times.",
        resembles: "Rain, or another tool on the robot.",
        breaks: &[Symmetry::Time],
        stages: &[Stage::Ground],
        parameters: &[
            Parameter {
                key: "across_factor",
                symbol: "κ",
                unit: "1",
                meaning: "friction ratio μ_x/μ_y on the other ground over that on the first",
                role: Role::Size { neutral: 1.0 },
                range: [0.3, 3.0],
                typical: 1.2,
            },
            Parameter {
                key: "from_s",
                symbol: "t₀",
                unit: "s",
                meaning: "begin, since the start of the recording",
                role: Role::Time,
                range: [-1e6, 1e6],
                typical: 60.0,
            },
            Parameter {
                key: "until_s",
                symbol: "t₁",
                unit: "s",
                meaning: "end; the first ground for an end before the begin",
                role: Role::Time,
                range: [-1e6, 1e6],
                typical: 120.0,
            },
        ],
        sources: &["Martinez et al., IJRR 24(10), 2005, eq. (23) with [μ] of the time"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { factor: values[0], from: values[1], until: values[2] }
    }

    fn ground(&self, ground: &mut Ground) {
        let time = ground.circumstance.time;
        // φ(t − t₀) − φ(t − t₁)
        let there = (done_at(time, self.from) - done_at(time, self.until)).max(0.0);
        if there > 0.0 {
            let factor = self.factor.powf(there);
            for side in Side::BOTH {
                ground.friction[side].across *= factor;
            }
        }
    }
}
