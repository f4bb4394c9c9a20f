//! Another ratio of the two friction coefficients.

use crate::effect::{Card, Effect, Parameter, Role, Stage};
use crate::pipeline::Ground;
use trackdyn_core::Side;

/// Friction across the tracks that differs from the vehicle file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionAnisotropy {
    ratio: f64,
}

impl Effect for FrictionAnisotropy {
    const CARD: Card = Card {
        id: "friction-anisotropy",
        title: "Another ratio of friction across to along the tracks",
        law: "μ_x ← k μ_x",
        assumes: "Both sides alike. Slow driving on level ground depends on μ_x/μ_y alone.",
        shows: "The common distance of the ICRs from the middle. It belongs to the class of \
                constants.",
        resembles: "",
        breaks: &[],
        stages: &[Stage::Ground],
        parameters: &[Parameter {
            key: "ratio",
            symbol: "k",
            unit: "1",
            meaning: "factor on μ_x/μ_y",
            role: Role::Size { neutral: 1.0 },
            range: [0.1, 10.0],
            typical: 1.2,
        }],
        sources: &["Martinez et al., IJRR 24(10), 2005, eq. (23)"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { ratio: values[0] }
    }

    fn ground(&self, ground: &mut Ground) {
        for side in Side::BOTH {
            // μ_x ← k μ_x
            ground.friction[side].across *= self.ratio;
        }
    }
}
