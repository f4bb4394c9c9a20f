//! Sprockets that run out of true.

use crate::mechanism::{Described, Mechanism, Scene, Step};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::{PerSide, Side};
use std::f64::consts::TAU;

/// The radius at which a sprocket holds its belt goes up and down once in a turn of it.
#[derive(Clone, Copy, Debug)]
pub struct EccentricSprocket {
    depth: f64,
    number: f64,
    /// Ways that the encoders have shown, m.
    way: PerSide<f64>,
}

impl Described for EccentricSprocket {
    const SHEET: Sheet = Sheet {
        id: "eccentric-sprocket",
        origin: Origin::Outside,
        law: "V = V_shown (1 + a sin(2π w/λ)), w the way that the side's encoder has shown, on the \
              right a quarter of λ less",
        size: "the mean is right; a is the eccentricity over the radius, λ a turn of the sprocket",
        shares_size: false,
        family: None,
        breaks: &[
            Symmetry::SpeedScale,
            Symmetry::Reversal,
            Symmetry::Manoeuvre,
            Symmetry::Mirror,
            Symmetry::Transient,
            Symmetry::Straight,
        ],
        trial: Trial::law(Identifiability::Distinct, 10.0).with_drawn_forms_only(),
        parameters: &[
            Parameter {
                key: "eccentricity",
                unit: "1",
                range: [0.0, 0.4],
                typical: 0.03,
                draw: Draw::size(0.03),
            },
            Parameter {
                key: "turn_m",
                unit: "m",
                range: [0.05, 100.0],
                typical: 0.9,
                draw: Draw::log_shape(0.5, 2.0, &[]),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { depth: values[0], number: TAU / values[1], way: PerSide::new(0.0, 0.0) }
    }
}

impl Mechanism for EccentricSprocket {
    fn drive(&self, _scene: &Scene, dt: f64, belt: &mut PerSide<f64>) {
        for side in Side::BOTH {
            let quarter = if side == Side::Right { TAU / 4.0 } else { 0.0 };
            let middle = self.way[side] + belt[side] * dt / 2.0;
            belt[side] *= 1.0 + self.depth * (self.number * middle - quarter).sin();
        }
    }

    fn advance(&mut self, step: &Step) {
        for side in Side::BOTH {
            self.way[side] += step.fed[side] * step.dt;
        }
    }
}
