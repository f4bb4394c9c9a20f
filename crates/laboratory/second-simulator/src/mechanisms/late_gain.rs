//! A belt that jumps during a drive.

use crate::mechanism::{Described, Mechanism, Scene};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::{PerSide, Side};

/// Gains of the belts from a time on.
#[derive(Clone, Copy, Debug)]
pub struct LateGain {
    factor: PerSide<f64>,
    from: f64,
}

impl Described for LateGain {
    const SHEET: Sheet = Sheet {
        id: "late-gain",
        origin: Origin::Catalogue,
        law: "V = γ V_shown for t ≥ t₀",
        size: "the same",
        shares_size: true,
        family: None,
        breaks: &[Symmetry::Time],
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
            Parameter {
                key: "from_s",
                unit: "s",
                range: [0.0, 1e6],
                typical: 60.0,
                draw: Draw::shape(60.0, 240.0, &[]),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { factor: PerSide::new(values[0], values[1]), from: values[2] }
    }
}

impl Mechanism for LateGain {
    fn drive(&self, scene: &Scene, _dt: f64, belt: &mut PerSide<f64>) {
        if scene.t >= self.from {
            *belt = PerSide::from_fn(|side: Side| self.factor[side] * belt[side]);
        }
    }
}
