//! Soil that a track pushes aside.

use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Trial};

/// A wedge of soil on the side to which a shoe moves.
#[derive(Clone, Copy, Debug)]
pub struct Bulldozing {
    coefficient: f64,
}

impl Described for Bulldozing {
    const SHEET: Sheet = Sheet {
        id: "bulldozing",
        origin: Origin::Catalogue,
        law: "F_x = −c N tanh(20 z_x/z₀)",
        size: "the law −c N sign(s_x), with a wedge that changes sides while the slip turns \
               through ±3°",
        shares_size: false,
        breaks: &[],
        trial: Trial::law(Identifiability::Indistinct, 5.0),
        parameters: &[Parameter {
            key: "coefficient",
            unit: "1",
            range: [0.0, 1.0],
            typical: 0.1,
            draw: Draw::size(0.1),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { coefficient: values[0] }
    }
}

impl Mechanism for Bulldozing {
    fn traction(&self, contact: &Contact, force: &mut [f64; 2]) {
        force[0] -= self.coefficient * contact.load * (20.0 * contact.deflection[0]).tanh();
    }
}
