//! Sloping ground.

use crate::mechanism::{Described, Gravity, Mechanism, Scene};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

/// A plane that rises in one direction of the world.
#[derive(Clone, Copy, Debug)]
pub struct Slope {
    angle: f64,
    uphill: f64,
}

impl Described for Slope {
    const SHEET: Sheet = Sheet {
        id: "slope",
        origin: Origin::Catalogue,
        law: "g_along = −g sin β uphill, g_normal = g cos β",
        size: "the same",
        shares_size: true,
        family: None,
        breaks: &[Symmetry::Reversal, Symmetry::Mirror, Symmetry::Heading],
        trial: Trial::law(Identifiability::Distinct, 7.0),
        parameters: &[
            Parameter {
                key: "angle_deg",
                unit: "deg",
                range: [0.0, 60.0],
                typical: 2.0,
                draw: Draw::size(2.0),
            },
            Parameter {
                key: "uphill_deg",
                unit: "deg",
                range: [-360.0, 360.0],
                typical: 0.0,
                draw: Draw::direction(),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { angle: values[0].to_radians(), uphill: values[1].to_radians() }
    }
}

impl Mechanism for Slope {
    fn gravity(&self, scene: &Scene, gravity: &mut Gravity) {
        let (sin, cos) = self.uphill.sin_cos();
        let uphill = scene.body_axes_from_world([cos, sin]);
        for (along, uphill) in gravity.along.iter_mut().zip(uphill) {
            *along -= gravity.normal * self.angle.sin() * uphill;
        }
        gravity.normal *= self.angle.cos();
    }
}
