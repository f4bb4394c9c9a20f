//! Encoders that do not show the belts' speeds.

use crate::mechanism::{Described, Mechanism, Scene};
use crate::sheet::{Draw, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::PerSide;

/// Wrong sprocket radii, eqs (20)-(21) of Martinez et al. 2005.
#[derive(Clone, Copy, Debug)]
pub struct EncoderScale {
    alpha: PerSide<f64>,
}

impl Described for EncoderScale {
    const SHEET: Sheet = Sheet {
        id: "encoder-scale",
        origin: Origin::Catalogue,
        law: "V = α V_shown",
        size: "the same",
        shares_size: true,
        family: None,
        breaks: &[Symmetry::Manoeuvre, Symmetry::Mirror, Symmetry::Straight],
        trial: Trial::instrument("encoder-scale", 0.35),
        parameters: &[
            Parameter {
                key: "left",
                unit: "1",
                range: [0.5, 2.0],
                typical: 1.03,
                draw: Draw::reading(1.0, 0.005, [0.01, 0.04]),
            },
            Parameter {
                key: "right",
                unit: "1",
                range: [0.5, 2.0],
                typical: 0.97,
                draw: Draw::reading(1.0, 0.005, [0.01, 0.04]),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { alpha: PerSide::new(values[0], values[1]) }
    }
}

impl Mechanism for EncoderScale {
    fn drive(&self, _scene: &Scene, _dt: f64, belt: &mut PerSide<f64>) {
        belt.left *= self.alpha.left;
        belt.right *= self.alpha.right;
    }
}
