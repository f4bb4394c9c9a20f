//! Another ratio of friction across to along the tracks.

use crate::mechanism::{Contact, Described, Mechanism, scale_ratio};
use crate::sheet::{Draw, Filed, Identifiability, Origin, Parameter, Sheet, Trial};

/// Both coefficients change, their product does not.
#[derive(Clone, Copy, Debug)]
pub struct FrictionAnisotropy {
    factor: f64,
}

impl Described for FrictionAnisotropy {
    const SHEET: Sheet = Sheet {
        id: "friction-anisotropy",
        origin: Origin::Catalogue,
        law: "μ_x √f, μ_y/√f",
        size: "the same: f multiplies μ_x/μ_y",
        shares_size: true,
        breaks: &[],
        trial: Trial::law(Identifiability::Indistinct, 3.0).filed(Filed::FrictionRatio),
        parameters: &[Parameter {
            key: "ratio",
            unit: "1",
            range: [0.2, 5.0],
            typical: 1.2,
            draw: Draw::factor(1.2),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { factor: values[0] }
    }
}

impl Mechanism for FrictionAnisotropy {
    fn friction(&self, _contact: &Contact, mu: &mut [f64; 2]) {
        scale_ratio(mu, self.factor);
    }
}
