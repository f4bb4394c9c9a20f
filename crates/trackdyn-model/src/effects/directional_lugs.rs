//! Lugs that grip better in one direction than in the other.

use crate::contact::ShearStress;
use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Site;
use trackdyn_core::Scalar;

/// Friction along the track that differs between forward and backward slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalLugs {
    excess: f64,
}

impl Effect for DirectionalLugs {
    const CARD: Card = Card {
        id: "directional-lugs",
        title: "Lugs that grip better in one direction",
        law: "τ_y = −μ_y (1 − δ sign(s_y)) p s_y/|s|",
        assumes: "Friction across does not change.",
        shows: "Forward and reverse turns have different ICRs.",
        resembles: "A steady force on the body along the tracks.",
        breaks: &[Symmetry::Reversal],
        stages: &[Stage::Shear],
        parameters: &[Parameter {
            key: "excess",
            symbol: "δ",
            unit: "1",
            meaning: "relative excess of friction where the belt slips backward, that is, where it \
                      pushes forward",
            role: Role::Size { neutral: 0.0 },
            range: [-0.9, 0.9],
            typical: 0.05,
        }],
        sources: &["Bekker, Introduction to Terrain-Vehicle Systems, 1969"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { excess: values[0] }
    }

    fn shear<S: Scalar>(&self, site: &Site<S>, stress: &mut ShearStress<S>) {
        let sign = site.slip.unit_slip[1].value().signum();
        // 1 − δ sign(s_y)
        stress.factor[1] *= S::from(1.0 - self.excess * sign);
    }
}
