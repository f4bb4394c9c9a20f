//! Friction that grows with slip speed, by a power law.

use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

/// Slip speed at which the law equals the linear one, m/s.
const EQUAL_SLIP_SPEED: f64 = 0.3;

/// Rubber and wet soil resist faster slip with more than friction.
#[derive(Clone, Copy, Debug)]
pub struct ViscousFriction {
    growth: f64,
}

impl Described for ViscousFriction {
    const SHEET: Sheet = Sheet {
        id: "viscous-friction",
        origin: Origin::Catalogue,
        law: "μ (1 + c v₀ (|s|/v₀)^0.6), v₀ = 0.3 m/s",
        size: "equal to 1 + c |s| at 0.3 m/s; more below, less above",
        shares_size: false,
        breaks: &[Symmetry::SpeedScale, Symmetry::Manoeuvre],
        trial: Trial::law(Identifiability::DistinctWhenLarge, 10.0),
        parameters: &[Parameter {
            key: "growth_s_per_m",
            unit: "s/m",
            range: [0.0, 10.0],
            typical: 0.5,
            draw: Draw::size(0.5),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { growth: values[0] }
    }
}

impl Mechanism for ViscousFriction {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let ratio = contact.slip_speed() / EQUAL_SLIP_SPEED;
        let factor = 1.0 + self.growth * EQUAL_SLIP_SPEED * ratio.powf(0.6);
        *mu = mu.map(|mu| mu * factor);
    }
}
