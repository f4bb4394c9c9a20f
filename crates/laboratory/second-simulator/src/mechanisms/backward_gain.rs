//! Belts that lose their teeth one way.

use crate::mechanism::{Described, Mechanism, Scene};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::{PerSide, Side};

/// Gains of the belts that run backward.
#[derive(Clone, Copy, Debug)]
pub struct BackwardGain {
    factor: PerSide<f64>,
}

impl Described for BackwardGain {
    const SHEET: Sheet = Sheet {
        id: "backward-gain",
        origin: Origin::Catalogue,
        law: "V = β V_shown where V_shown < 0",
        size: "the same",
        shares_size: true,
        family: None,
        breaks: &[Symmetry::Reversal, Symmetry::Manoeuvre, Symmetry::Mirror, Symmetry::Straight],
        trial: Trial::law(Identifiability::Distinct, 5.0).with_drawn_forms_only(),
        parameters: &[
            Parameter {
                key: "left",
                unit: "1",
                range: [0.5, 2.0],
                typical: 0.97,
                draw: Draw::factor(0.97).signed(),
            },
            Parameter {
                key: "right",
                unit: "1",
                range: [0.5, 2.0],
                typical: 1.03,
                draw: Draw::factor(1.0),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { factor: PerSide::new(values[0], values[1]) }
    }
}

impl Mechanism for BackwardGain {
    fn drive(&self, _scene: &Scene, _dt: f64, belt: &mut PerSide<f64>) {
        for side in Side::BOTH {
            if belt[side] < 0.0 {
                belt[side] *= self.factor[side];
            }
        }
    }
}
