//! Rubber that softens with the heat of its own slip.

use crate::mechanism::{Contact, Described, Mechanism, Step};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::{PerSide, Side};

/// Time in which the rubber cools, s.
const COOLING_TIME: f64 = 15.0;

/// Each side remembers the work that slip has done on it.
#[derive(Clone, Copy, Debug)]
pub struct WarmRubber {
    softening: f64,
    warmth: PerSide<f64>,
}

impl Described for WarmRubber {
    const SHEET: Sheet = Sheet {
        id: "warm-rubber",
        origin: Origin::Outside,
        law: "T' = P/(W · 1 m/s) / τ − T/τ per side, τ = 15 s; μ_x/(1 + a T)",
        size: "history: hard work changes the ICRs of a command, seen as a drift; in the end it \
               acts as slip speed does",
        shares_size: false,
        family: None,
        breaks: &[Symmetry::SpeedScale, Symmetry::Manoeuvre, Symmetry::Transient],
        trial: Trial::law(Identifiability::Distinct, 5.0),
        parameters: &[Parameter {
            key: "softening",
            unit: "1",
            range: [0.0, 5.0],
            typical: 1.0,
            draw: Draw::size(1.0),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { softening: values[0], warmth: PerSide::new(0.0, 0.0) }
    }
}

impl Mechanism for WarmRubber {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        mu[0] /= 1.0 + self.softening * self.warmth[contact.side];
    }

    fn advance(&mut self, step: &Step) {
        let share = -(-step.dt / COOLING_TIME).exp_m1();
        for side in Side::BOTH {
            // P over the power of the side's weight moving at 1 m/s
            let power = step.heat[side] / step.scene.weight[side];
            self.warmth[side] += share * (power - self.warmth[side]);
        }
    }
}
