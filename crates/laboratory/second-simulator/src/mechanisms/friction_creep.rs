//! Friction that is full only above a slip speed.

use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

use std::f64::consts::FRAC_PI_2;

/// A contact that creeps under any load, as rubber and clay do.
#[derive(Clone, Copy, Debug)]
pub struct FrictionCreep {
    speed: f64,
}

impl Described for FrictionCreep {
    const SHEET: Sheet = Sheet {
        id: "friction-creep",
        origin: Origin::Catalogue,
        law: "μ (2/π) atan(π |s|/(2 v))",
        size: "rises from rest with 1/v, as the catalogue's law does; at |s| = v it has reached 64 \
               %",
        shares_size: false,
        breaks: &[Symmetry::SpeedScale, Symmetry::Manoeuvre],
        trial: Trial::law(Identifiability::DistinctWhenLarge, 10.0)
            .compared_at(&[0.3, 1.0, 3.0, 10.0]),
        parameters: &[Parameter {
            key: "speed_m_per_s",
            unit: "m/s",
            range: [0.0001, 1.0],
            typical: 0.03,
            draw: Draw::size(0.03),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { speed: values[0] }
    }
}

impl Mechanism for FrictionCreep {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let factor = (FRAC_PI_2 * contact.slip_speed() / self.speed).atan() / FRAC_PI_2;
        *mu = mu.map(|mu| mu * factor);
    }
}
