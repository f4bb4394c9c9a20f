//! Different friction under the two sides.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Ground;
use trackdyn_core::Side;

/// More friction under one side than under the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionSplit {
    split: f64,
}

impl Effect for FrictionSplit {
    const CARD: Card = Card {
        id: "friction-split",
        title: "Different friction under the two sides",
        law: "μ_left = (1 + δ) μ, μ_right = (1 − δ) μ",
        assumes: "Both directions of friction change by the same factor.",
        shows: "Moves the constant ICRs like a lateral cog-shift. ICRs alone cannot tell them \
                apart.",
        resembles: "A track that is worn or wet.",
        breaks: &[Symmetry::Mirror],
        stages: &[Stage::Ground],
        parameters: &[Parameter {
            key: "split",
            symbol: "δ",
            unit: "1",
            meaning: "relative excess of the left side's friction over the mean",
            role: Role::Size { neutral: 0.0 },
            range: [-0.9, 0.9],
            typical: 0.1,
        }],
        sources: &["Martinez et al., IJRR 24(10), 2005, eq. (23) with [μ] per side"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { split: values[0] }
    }

    fn ground(&self, ground: &mut Ground) {
        for side in Side::BOTH {
            // μ_left = (1 + δ) μ, μ_right = (1 − δ) μ
            let factor = 1.0 - side.sign() * self.split;
            ground.friction[side].across *= factor;
            ground.friction[side].along *= factor;
        }
    }
}
