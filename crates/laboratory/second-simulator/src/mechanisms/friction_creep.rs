//! Friction that is full only above a slip speed.

use crate::form::{Curve, Draws, Steps};
use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Family, Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

use std::f64::consts::{E, FRAC_PI_2};

/// A contact that creeps under any load, as rubber and clay do.
#[derive(Clone, Debug)]
pub struct FrictionCreep {
    speed: f64,
    /// Part of the friction over |s|/v, where it is not an arc tangent.
    rise: Option<Curve>,
}

impl Described for FrictionCreep {
    const SHEET: Sheet = Sheet {
        id: "friction-creep",
        origin: Origin::Catalogue,
        law: "μ (2/π) atan(π |s|/(2 v))",
        size: "the same slope at rest, 1/v; 64 % at |s| = v",
        shares_size: false,
        family: Some(Family {
            law: "μ S(|s|), S from v/5 to 5 v, moved so that it is 1 − 1/e at v",
            size: "63 % at |s| = v, as 1 − exp(−|s|/v)",
            shares_size: false,
        }),
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
        Self { speed: values[0], rise: None }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        let steps = Steps::draw(random, 0.2, 5.0).through(1.0, 1.0 - 1.0 / E);
        Self { speed: values[0], rise: Some(Curve::of(|ratio| steps.at(ratio))) }
    }
}

impl Mechanism for FrictionCreep {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let factor = match &self.rise {
            None => (FRAC_PI_2 * contact.slip_speed() / self.speed).atan() / FRAC_PI_2,
            Some(curve) => curve.at(contact.slip_speed() / self.speed),
        };
        *mu = mu.map(|mu| mu * factor);
    }
}
