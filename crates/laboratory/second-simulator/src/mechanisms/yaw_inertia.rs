//! Mass that resists changes of speed.

use crate::mechanism::{Described, Inertia, Mechanism};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Scale, Sheet, Symmetry, Trial};

/// Newton's law in transients.
#[derive(Clone, Copy, Debug)]
pub struct YawInertia {
    strength: f64,
    radius: f64,
}

impl Described for YawInertia {
    const SHEET: Sheet = Sheet {
        id: "yaw-inertia",
        origin: Origin::Catalogue,
        law: "k m v' and k m r² ω'",
        size: "the same: the mass in the equations of motion",
        shares_size: true,
        family: None,
        breaks: &[Symmetry::Transient],
        trial: Trial::law(Identifiability::Distinct, 4.0),
        parameters: &[
            Parameter {
                key: "strength",
                unit: "1",
                range: [0.01, 10.0],
                typical: 1.0,
                draw: Draw::size(1.0),
            },
            Parameter {
                key: "gyration_m",
                unit: "m",
                range: [0.01, 5.0],
                typical: 0.3,
                draw: Draw::fixed(1.0).times(Scale::GyrationRadius),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { strength: values[0], radius: values[1] }
    }
}

impl Mechanism for YawInertia {
    fn inertia(&self, inertia: &mut Inertia) {
        inertia.transient = self.strength;
        inertia.gyration_radius = self.radius;
    }
}
