//! Ground with a grain.

use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

/// Brushed concrete, rolled grass, furrows: friction depends on the way of the slip over the world.
#[derive(Clone, Copy, Debug)]
pub struct BrushedGround {
    excess: f64,
    along: f64,
}

impl Described for BrushedGround {
    const SHEET: Sheet = Sheet {
        id: "brushed-ground",
        origin: Origin::Outside,
        law: "μ (1 + a sin² φ), φ between slip and grain",
        size: "a is the excess across the grain; 0.3 is a guess, for want of a published figure",
        shares_size: false,
        family: None,
        breaks: &[Symmetry::Mirror, Symmetry::Heading],
        trial: Trial::law(Identifiability::Distinct, 10.0),
        parameters: &[
            Parameter {
                key: "excess",
                unit: "1",
                range: [-0.9, 5.0],
                typical: 0.3,
                draw: Draw::size(0.3),
            },
            Parameter {
                key: "grain_deg",
                unit: "deg",
                range: [-360.0, 360.0],
                typical: 0.0,
                draw: Draw::direction(),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { excess: values[0], along: values[1].to_radians() }
    }
}

impl Mechanism for BrushedGround {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let [x, y] = contact.scene.world_axes_from_body(contact.deflection);
        let (sin, cos) = self.along.sin_cos();
        let across = cos * y - sin * x;
        // |z|/z₀ is 1 where the shoe slides
        let factor = 1.0 + self.excess * across * across;
        *mu = mu.map(|mu| mu * factor);
    }
}
