//! Soil that a track pushes aside.

use crate::form::Draws;
use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Family, Draw, Identifiability, Origin, Parameter, Sheet, Trial};

/// A wedge of soil on the side to which a shoe moves.
#[derive(Clone, Copy, Debug)]
pub struct Bulldozing {
    coefficient: f64,
    steepness: f64,
}

impl Described for Bulldozing {
    const SHEET: Sheet = Sheet {
        id: "bulldozing",
        origin: Origin::Catalogue,
        law: "F_x = −c N tanh(20 z_x/z₀)",
        size: "the law −c N sign(s_x), with a wedge that changes sides while the slip turns \
               through ±3°",
        shares_size: false,
        family: Some(Family {
            law: "F_x = −c N tanh(k z_x/z₀), k from 5 to 40",
            size: "the law −c N sign(s_x), with a wedge that changes sides while the slip turns \
                   through 1 to 11 degrees",
            shares_size: false,
        }),
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
        Self { coefficient: values[0], steepness: 20.0 }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        Self { coefficient: values[0], steepness: random.log_between(5.0, 40.0) }
    }
}

impl Mechanism for Bulldozing {
    fn traction(&self, contact: &Contact, force: &mut [f64; 2]) {
        let side = (self.steepness * contact.deflection[0]).tanh();
        force[0] -= self.coefficient * contact.load * side;
    }
}
