//! Another ratio of friction across to along the tracks.

use crate::form::Draws;
use crate::mechanism::{Contact, Described, Mechanism, scale_ratio, share_ratio};
use crate::sheet::{Family, Draw, Filed, Identifiability, Origin, Parameter, Sheet, Trial};

/// Both coefficients change, their product does not.
#[derive(Clone, Copy, Debug)]
pub struct FrictionAnisotropy {
    factor: f64,
    /// Power of the factor that goes to μ_x, where it is not one half.
    across: Option<f64>,
}

impl Described for FrictionAnisotropy {
    const SHEET: Sheet = Sheet {
        id: "friction-anisotropy",
        origin: Origin::Catalogue,
        law: "μ_x √f, μ_y/√f",
        size: "the same: f multiplies μ_x/μ_y",
        shares_size: true,
        family: Some(Family {
            law: "μ_x f^p, μ_y f^(p − 1), p from 0 to 1",
            size: "f multiplies μ_x/μ_y",
            shares_size: true,
        }),
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
        Self { factor: values[0], across: None }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        Self { factor: values[0], across: Some(random.between(0.0, 1.0)) }
    }
}

impl Mechanism for FrictionAnisotropy {
    fn friction(&self, _contact: &Contact, mu: &mut [f64; 2]) {
        match self.across {
            None => scale_ratio(mu, self.factor),
            Some(across) => share_ratio(mu, self.factor, across),
        }
    }
}
