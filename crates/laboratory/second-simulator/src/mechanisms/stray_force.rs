//! A force that turns with the robot.

use crate::mechanism::{Described, Mechanism, Scene};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Scale, Sheet, Symmetry, Trial};
use trackdyn_core::{Twist, Wrench};

/// A blower, a magnet near the ground, a hose that is led over the stern.
#[derive(Clone, Copy, Debug)]
pub struct StrayForce {
    force: [f64; 2],
}

impl Described for StrayForce {
    const SHEET: Sheet = Sheet {
        id: "stray-force",
        origin: Origin::Outside,
        law: "F = F₀ (−sin γ, cos γ) in the robot's axes, at the middle",
        size: "a slope that turns with the robot: no heading matters",
        shares_size: false,
        family: None,
        breaks: &[Symmetry::Reversal, Symmetry::Mirror],
        trial: Trial::law(Identifiability::Distinct, 7.0).with_drawn_forms_only(),
        parameters: &[
            Parameter {
                key: "force_n",
                unit: "N",
                range: [0.0, 10000.0],
                typical: 80.0,
                draw: Draw::size(0.03).times(Scale::Weight),
            },
            Parameter {
                key: "left_deg",
                unit: "deg",
                range: [-360.0, 360.0],
                typical: 40.0,
                draw: Draw::shape(-180.0, 180.0, &[]),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        // left of ahead is negative x of the paper's frame
        let (sin, cos) = values[1].to_radians().sin_cos();
        Self { force: [-values[0] * sin, values[0] * cos] }
    }
}

impl Mechanism for StrayForce {
    fn push(&self, _scene: &Scene, _twist: &Twist, wrench: &mut Wrench) {
        wrench.add_force(self.force, [0.0, 0.0]);
    }
}
