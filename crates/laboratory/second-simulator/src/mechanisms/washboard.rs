//! Ground in waves.

use crate::mechanism::{Contact, Described, Mechanism, scale_ratio};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

/// Crests and hollows that grip differently, periodic in place.
#[derive(Clone, Copy, Debug)]
pub struct Washboard {
    depth: f64,
    number: f64,
}

impl Described for Washboard {
    const SHEET: Sheet = Sheet {
        id: "washboard",
        origin: Origin::Outside,
        law: "μ_x/μ_y (1 + a sin(2π x/λ)), x along the world",
        size: "waves of a gravel road are 0.5 to 1 m long",
        shares_size: false,
        family: None,
        breaks: &[Symmetry::Mirror, Symmetry::Heading, Symmetry::Place],
        trial: Trial::law(Identifiability::Distinct, 2.8),
        parameters: &[
            Parameter {
                key: "depth",
                unit: "1",
                range: [0.0, 0.9],
                typical: 0.3,
                draw: Draw::size(0.3),
            },
            Parameter {
                key: "wavelength_m",
                unit: "m",
                range: [0.05, 1000.0],
                typical: 0.9,
                draw: Draw::log_shape(0.6, 2.0, &[]),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { depth: values[0], number: std::f64::consts::TAU / values[1] }
    }
}

impl Mechanism for Washboard {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let [x, _] = contact.world();
        scale_ratio(mu, 1.0 + self.depth * (self.number * x).sin());
    }
}
