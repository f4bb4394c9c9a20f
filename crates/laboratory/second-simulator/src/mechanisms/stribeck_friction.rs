//! Friction that falls from stick to slip.

use crate::form::{Curve, Draws, Steps};
use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Family, Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
use std::f64::consts::LN_2;

/// The steady law of LuGre bristles.
#[derive(Clone, Debug)]
pub struct StribeckFriction {
    speed: f64,
    loss: Loss,
}

/// How the excess is lost over |s|/v.
#[derive(Clone, Debug)]
enum Loss {
    /// 1 + a exp(−(|s|/v)²).
    Gaussian { excess: f64 },
    /// A factor.
    Steps(Curve),
}

impl Described for StribeckFriction {
    const SHEET: Sheet = Sheet {
        id: "stribeck-friction",
        origin: Origin::Catalogue,
        law: "μ (1 + a exp(−(|s|/v)²))",
        size: "the same excess; half of it is lost at 0.83 v, by an exponential at 0.69 v",
        shares_size: false,
        family: Some(Family {
            law: "μ (1 + a)^(1 − S(|s|)), S from v/8 to 8 v, moved so that half is lost at 0.69 v",
            size: "the excess at rest, and where an exponential has lost half",
            shares_size: false,
        }),
        breaks: &[Symmetry::SpeedScale, Symmetry::Manoeuvre],
        trial: Trial::law(Identifiability::DistinctWhenLarge, 3.0),
        parameters: &[
            Parameter {
                key: "excess",
                unit: "1",
                range: [0.0, 2.0],
                typical: 0.25,
                draw: Draw::size(0.25),
            },
            Parameter {
                key: "speed_m_per_s",
                unit: "m/s",
                range: [0.001, 5.0],
                typical: 0.1,
                draw: Draw::log_shape(0.05, 0.3, &[0.03, 0.06, 0.12, 0.25, 0.5]),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { speed: values[1], loss: Loss::Gaussian { excess: values[0] } }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        let steps = Steps::draw(random, 0.125, 8.0).through(LN_2, 0.5);
        let curve = Curve::of(|ratio| (values[0].ln_1p() * (1.0 - steps.at(ratio))).exp());
        Self { speed: values[1], loss: Loss::Steps(curve) }
    }
}

impl Mechanism for StribeckFriction {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        // g(s) = F_c + (F_s − F_c) exp(−(s/v)²), Canudas de Wit et al., IEEE TAC 40(3), 1995
        let ratio = contact.slip_speed() / self.speed;
        let factor = match &self.loss {
            Loss::Gaussian { excess } => 1.0 + excess * (-ratio * ratio).exp(),
            Loss::Steps(curve) => curve.at(ratio),
        };
        *mu = mu.map(|mu| mu * factor);
    }
}
