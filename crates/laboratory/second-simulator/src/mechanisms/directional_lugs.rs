//! Lugs that grip better one way than the other.

use crate::form::Draws;
use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Family, Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

/// Friction grows with the share of slip that goes backward.
#[derive(Clone, Copy, Debug)]
pub struct DirectionalLugs {
    excess: f64,
    turn: Turn,
}

/// How friction goes from one way of the slip to the other.
#[derive(Clone, Copy, Debug)]
enum Turn {
    /// With its cosine along the track.
    Cosine,
    /// With a power of it.
    Power(f64),
    /// Sooner.
    Steep(f64),
}

impl Described for DirectionalLugs {
    const SHEET: Sheet = Sheet {
        id: "directional-lugs",
        origin: Origin::Catalogue,
        law: "μ_y (1 − d z_y/z₀)",
        size: "equal to μ_y (1 − d sign(s_y)) where the slip is along the track; in between it \
               follows its cosine",
        shares_size: false,
        family: Some(Family {
            law: "μ_y (1 − d C(z_y/z₀)), C odd with C(1) = 1: |c|^p, p from 1.2 to 3, or tanh(k \
                  c)/tanh(k), k from 1 to 6",
            size: "equal to μ_y (1 − d sign(s_y)) where the slip is along the track",
            shares_size: false,
        }),
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
        Self { excess: values[0], turn: Turn::Cosine }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        let turn = if random.happens(0.5) {
            Turn::Power(random.between(1.2, 3.0))
        } else {
            Turn::Steep(random.log_between(1.0, 6.0))
        };
        Self { excess: values[0], turn }
    }
}

impl Mechanism for DirectionalLugs {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let cosine = contact.deflection[1];
        let turned = match self.turn {
            Turn::Cosine => cosine,
            Turn::Power(power) => cosine.abs().powf(power).copysign(cosine),
            Turn::Steep(steepness) => (steepness * cosine).tanh() / steepness.tanh(),
        };
        mu[1] *= 1.0 - self.excess * turned;
    }
}
