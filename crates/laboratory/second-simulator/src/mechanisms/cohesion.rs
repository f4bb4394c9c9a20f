//! Soil or rubber that adheres beside its friction.

use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Scale, Sheet, Trial};

/// A shear strength that does not depend on the load.
#[derive(Clone, Copy, Debug)]
pub struct Cohesion {
    adhesion: f64,
}

impl Described for Cohesion {
    const SHEET: Sheet = Sheet {
        id: "cohesion",
        origin: Origin::Catalogue,
        law: "F = −c A z/z₀ beside friction",
        size: "the same; adhesion has the elastic range of friction",
        shares_size: true,
        family: None,
        breaks: &[],
        trial: Trial::law(Identifiability::Indistinct, 4.0),
        parameters: &[Parameter {
            key: "stress_pa",
            unit: "Pa",
            range: [0.0, 1e5],
            typical: 2000.0,
            draw: Draw::size(0.15).times(Scale::NormalPressure),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { adhesion: values[0] }
    }
}

impl Mechanism for Cohesion {
    fn traction(&self, contact: &Contact, force: &mut [f64; 2]) {
        for (force, deflection) in force.iter_mut().zip(contact.deflection) {
            *force -= self.adhesion * contact.area * deflection;
        }
    }
}
