//! Friction that changes along the tracks.

use crate::contact::ShearStress;
use crate::effect::{Card, Effect, Parameter, Role, Stage};
use crate::pipeline::{RigidBody, Site};
use trackdyn_core::Scalar;

/// More friction in front than behind, as with worn belts or cleared ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionGradient {
    gradient: f64,
}

impl Effect for FrictionGradient {
    const CARD: Card = Card {
        id: "friction-gradient",
        title: "Friction that changes from rear to front",
        law: "τ = −[μ] p (1 + γ η) s/|s|, η = −1 at the rear end of the contact, +1 at its front",
        assumes: "Linear along the contact, alike on both sides and in both directions.",
        shows: "y moves towards the end with more friction. It belongs to the class of constants.",
        resembles: "",
        breaks: &[],
        stages: &[Stage::Shear],
        parameters: &[Parameter {
            key: "gradient",
            symbol: "γ",
            unit: "1",
            meaning: "relative excess of friction at the front end",
            role: Role::Size { neutral: 0.0 },
            range: [-0.9, 0.9],
            typical: 0.2,
        }],
        sources: &["Martinez et al., IJRR 24(10), 2005, eq. (22) with [μ] along y"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { gradient: values[0] }
    }

    fn rigid_body(&self, body: &mut RigidBody) {
        body.friction_gradient += self.gradient;
    }

    fn shear<S: Scalar>(&self, site: &Site<S>, stress: &mut ShearStress<S>) {
        let [rear, front] = site.situation.footprint.ends;
        // η = (y − ȳ)/(l/2)
        let eta = (site.slip.position[1] * 2.0 - (front + rear)) / (front - rear);
        // 1 + γ η
        stress.scale(eta * self.gradient + 1.0);
    }
}
