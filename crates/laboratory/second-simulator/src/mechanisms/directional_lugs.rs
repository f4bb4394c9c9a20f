//! Lugs that grip better one way than the other.

use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

/// Friction grows with the share of slip that goes backward.
#[derive(Clone, Copy, Debug)]
pub struct DirectionalLugs {
    excess: f64,
}

impl Described for DirectionalLugs {
    const SHEET: Sheet = Sheet {
        id: "directional-lugs",
        origin: Origin::Catalogue,
        law: "μ_y (1 − d z_y/z₀)",
        size: "equal to μ_y (1 − d sign(s_y)) where the slip is along the track; in between it \
               follows its cosine",
        shares_size: false,
        breaks: &[Symmetry::Reversal],
        trial: Trial::law(Identifiability::Distinct, 12.0),
        parameters: &[Parameter {
            key: "excess",
            unit: "1",
            range: [-0.9, 0.9],
            typical: 0.05,
            draw: Draw::size(0.05).signed(),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { excess: values[0] }
    }
}

impl Mechanism for DirectionalLugs {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        mu[1] *= 1.0 - self.excess * contact.deflection[1];
    }
}
