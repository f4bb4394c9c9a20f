//! Friction that grows with slip speed, by a power law.

use crate::form::{Curve, Draws, Steps};
use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Family, Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

/// Slip speed at which the law equals the linear one, m/s.
const EQUAL_SLIP_SPEED: f64 = 0.3;

/// Rubber and wet soil resist faster slip with more than friction.
#[derive(Clone, Debug)]
pub struct ViscousFriction {
    growth: Growth,
}

#[derive(Clone, Debug)]
enum Growth {
    /// 1 + a (|s|/v₀)^p.
    Power { excess: f64, power: f64 },
    /// A factor over |s|/v₀.
    Steps(Curve),
}

impl Described for ViscousFriction {
    const SHEET: Sheet = Sheet {
        id: "viscous-friction",
        origin: Origin::Catalogue,
        law: "μ (1 + c v₀ (|s|/v₀)^0.6), v₀ = 0.3 m/s",
        size: "equal to 1 + c |s| at 0.3 m/s; more below, less above",
        shares_size: false,
        family: Some(Family {
            law: "μ (1 + c v₀)^(S(|s|)/S(v₀)), S from 0.05 to 1.5 m/s with S(v₀) from 0.3 to 0.7 \
                  of its end; or 1 + c v₀ (|s|/v₀)^p, p from 0.4 to 0.75 or 1.3 to 1.7",
            size: "equal to 1 + c |s| at v₀ = 0.3 m/s",
            shares_size: false,
        }),
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
        Self { growth: Growth::Power { excess: values[0] * EQUAL_SLIP_SPEED, power: 0.6 } }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        let excess = values[0] * EQUAL_SLIP_SPEED;
        let growth = if random.happens(0.3) {
            let is_below = random.happens(0.5);
            let power = if is_below { random.between(0.4, 0.75) } else { random.between(1.3, 1.7) };
            Growth::Power { excess, power }
        } else {
            let reached = random.between(0.3, 0.7);
            let steps = Steps::draw(random, 0.05 / EQUAL_SLIP_SPEED, 1.5 / EQUAL_SLIP_SPEED);
            let steps = steps.through(1.0, reached);
            Growth::Steps(Curve::of(|ratio| (excess.ln_1p() * steps.at(ratio) / reached).exp()))
        };
        Self { growth }
    }
}

impl Mechanism for ViscousFriction {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let ratio = contact.slip_speed() / EQUAL_SLIP_SPEED;
        let factor = match &self.growth {
            Growth::Power { excess, power } => 1.0 + excess * ratio.powf(*power),
            Growth::Steps(curve) => curve.at(ratio),
        };
        *mu = mu.map(|mu| mu * factor);
    }
}
