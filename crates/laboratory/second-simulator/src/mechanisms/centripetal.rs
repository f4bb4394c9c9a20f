//! Centripetal force of the turning body.

use crate::mechanism::{Described, Inertia, Mechanism};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

/// Mass in Newton's law of turning.
#[derive(Clone, Copy, Debug)]
pub struct Centripetal {
    strength: f64,
}

impl Described for Centripetal {
    const SHEET: Sheet = Sheet {
        id: "centripetal",
        origin: Origin::Catalogue,
        law: "m k ω × v",
        size: "the same",
        shares_size: true,
        family: None,
        breaks: &[Symmetry::SpeedScale, Symmetry::Reversal, Symmetry::Manoeuvre],
        trial: Trial::law(Identifiability::Distinct, 4.0),
        parameters: &[Parameter {
            key: "strength",
            unit: "1",
            range: [0.0, 10.0],
            typical: 1.0,
            draw: Draw::size(1.0),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { strength: values[0] }
    }
}

impl Mechanism for Centripetal {
    fn inertia(&self, inertia: &mut Inertia) {
        inertia.centripetal = self.strength;
    }
}
