//! A centre of gravity that differs from the vehicle file.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::vehicle::Vehicle;

/// A horizontal shift of the centre of gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CogShift {
    shift: [f64; 2],
}

impl Effect for CogShift {
    const CARD: Card = Card {
        id: "cog-shift",
        title: "Centre of gravity elsewhere",
        law: "(x_c, y_c) ← (x_c + Δx, y_c + Δy)",
        assumes: "A load that stays where it is. The mass does not change.",
        shows: "Moves the constant ICRs: y with Δy, their middle with Δx, as by friction-split.",
        resembles: "A load that was put on.",
        breaks: &[Symmetry::Mirror],
        stages: &[Stage::Body],
        parameters: &[
            Parameter {
                key: "x_m",
                symbol: "Δx",
                unit: "m",
                meaning: "shift to the right",
                role: Role::Size { neutral: 0.0 },
                range: [-1.0, 1.0],
                typical: 0.02,
            },
            Parameter {
                key: "y_m",
                symbol: "Δy",
                unit: "m",
                meaning: "shift forward",
                role: Role::Size { neutral: 0.0 },
                range: [-2.0, 2.0],
                typical: 0.03,
            },
        ],
        sources: &["Martinez et al., IJRR 24(10), 2005, Fig. 5"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { shift: [values[0], values[1]] }
    }

    fn body(&self, vehicle: &mut Vehicle) {
        // (x_c, y_c) ← (x_c + Δx, y_c + Δy)
        for (cog, shift) in vehicle.cog.iter_mut().zip(self.shift) {
            *cog += shift;
        }
    }
}
