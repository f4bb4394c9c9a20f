//! Belts that lose their edge when they are steered hard.

use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::PerSide;

/// The tension of a steered belt lifts its lugs: it holds less along, by the difference of the
/// track speeds.
#[derive(Clone, Copy, Debug)]
pub struct SteeringGrip {
    loss: f64,
}

impl Described for SteeringGrip {
    const SHEET: Sheet = Sheet {
        id: "steering-grip",
        origin: Origin::Outside,
        law: "μ_y/(1 + c |V_r − V_l|)",
        size: "a speed law of the commands instead of the slip",
        shares_size: false,
        family: None,
        breaks: &[Symmetry::SpeedScale, Symmetry::Manoeuvre],
        trial: Trial::law(Identifiability::Distinct, 13.0),
        parameters: &[Parameter {
            key: "loss_s_per_m",
            unit: "s/m",
            range: [0.0, 2.0],
            typical: 0.15,
            draw: Draw::size(0.15),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { loss: values[0] }
    }
}

impl Mechanism for SteeringGrip {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let PerSide { left, right } = contact.scene.sprocket;
        mu[1] /= 1.0 + self.loss * (right - left).abs();
    }
}
