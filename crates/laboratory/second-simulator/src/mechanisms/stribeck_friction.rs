//! Friction that falls from stick to slip.

use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

/// The steady law of LuGre bristles.
#[derive(Clone, Copy, Debug)]
pub struct StribeckFriction {
    excess: f64,
    speed: f64,
}

impl Described for StribeckFriction {
    const SHEET: Sheet = Sheet {
        id: "stribeck-friction",
        origin: Origin::Catalogue,
        law: "μ (1 + a exp(−(|s|/v)²))",
        size: "the excess is the same; half of it is lost at 0.83 v, where an exponential loses it \
               at 0.69 v",
        shares_size: false,
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
        Self { excess: values[0], speed: values[1] }
    }
}

impl Mechanism for StribeckFriction {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        // g(s) = F_c + (F_s − F_c) exp(−(s/v)²), Canudas de Wit et al., IEEE TAC 40(3), 1995
        let ratio = contact.slip_speed() / self.speed;
        let factor = 1.0 + self.excess * (-ratio * ratio).exp();
        *mu = mu.map(|mu| mu * factor);
    }
}
