//! A frame that stands on two corners.

use crate::mechanism::{Described, Load, Mechanism, Scene};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Scale, Sheet, Symmetry, Trial};

/// A bent chassis presses one track down at the front and the other at the rear.
#[derive(Clone, Copy, Debug)]
pub struct TwistedFrame {
    twist: f64,
}

impl Described for TwistedFrame {
    const SHEET: Sheet = Sheet {
        id: "twisted-frame",
        origin: Origin::Outside,
        law: "centre of pressure at y + d on the left, y − d on the right",
        size: "static, and odd in the sides as friction-split is",
        shares_size: false,
        family: None,
        breaks: &[Symmetry::Mirror],
        trial: Trial::law(Identifiability::Distinct, 2.5),
        parameters: &[Parameter {
            key: "shift_m",
            unit: "m",
            range: [-1.0, 1.0],
            typical: 0.03,
            draw: Draw::size(0.04).times(Scale::ContactLength).signed(),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { twist: values[0] }
    }
}

impl Mechanism for TwistedFrame {
    fn load(&self, _scene: &Scene, load: &mut Load) {
        load.along.left += self.twist;
        load.along.right -= self.twist;
    }
}
