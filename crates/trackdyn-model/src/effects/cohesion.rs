//! Adhesion in addition to friction.

use crate::contact::ShearStress;
use crate::effect::{Card, Effect, Parameter, Role, Stage};
use crate::pipeline::Site;
use trackdyn_core::Scalar;

/// Ground that resists shear even without load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cohesion {
    cohesion: f64,
}

impl Effect for Cohesion {
    const CARD: Card = Card {
        id: "cohesion",
        title: "Cohesion of the ground beside friction",
        law: "τ = −([μ] p + c) s/|s|",
        assumes: "Mohr-Coulomb: the same c in all directions and under the whole contact.",
        shows: "Draws the ratio of friction across to along towards 1, and takes weight from the \
                centre of gravity. It belongs to the class of constants.",
        resembles: "",
        breaks: &[],
        stages: &[Stage::Shear],
        parameters: &[Parameter {
            key: "stress_pa",
            symbol: "c",
            unit: "Pa",
            meaning: "shear stress that the ground bears without load",
            role: Role::Size { neutral: 0.0 },
            range: [0.0, 100_000.0],
            typical: 2000.0,
        }],
        sources: &[
            "Bekker, Introduction to Terrain-Vehicle Systems, 1969",
            "Wong, Theory of Ground Vehicles, ch. 2",
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { cohesion: values[0] }
    }

    fn shear<S: Scalar>(&self, site: &Site<S>, stress: &mut ShearStress<S>) {
        let direction = site.slip_direction();
        for (added, component) in stress.added.iter_mut().zip(direction) {
            // τ_added = −c s/|s|
            *added += component * -self.cohesion;
        }
    }
}
