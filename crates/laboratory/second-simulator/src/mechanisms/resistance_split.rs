//! Ground that holds one track back more than the other.

use crate::form::Draws;
use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Family, Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

use super::motion_resistance::Rolling;

/// Half the difference on the left, minus half of it on the right.
#[derive(Clone, Copy, Debug)]
pub struct ResistanceSplit {
    difference: f64,
    rolling: Rolling,
}

impl Described for ResistanceSplit {
    const SHEET: Sheet = Sheet {
        id: "resistance-split",
        origin: Origin::Catalogue,
        law: "c_left = +Δc/2, c_right = −Δc/2, as motion-resistance",
        size: "the same above 2 cm/s",
        shares_size: true,
        family: Some(Family {
            law: "c_left = +Δc/2, c_right = −Δc/2, as motion-resistance",
            size: "as motion-resistance",
            shares_size: false,
        }),
        breaks: &[Symmetry::Manoeuvre, Symmetry::Mirror],
        trial: Trial::law(Identifiability::Distinct, 6.0),
        parameters: &[Parameter {
            key: "difference",
            unit: "1",
            range: [-0.5, 0.5],
            typical: 0.05,
            draw: Draw::size(0.05).signed(),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { difference: values[0], rolling: Rolling::HARD_GROUND }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        Self { difference: values[0], rolling: Rolling::draw(random) }
    }
}

impl Mechanism for ResistanceSplit {
    fn resistance(&self, contact: &Contact, force: &mut f64) {
        let coefficient = -contact.side.sign() * self.difference / 2.0;
        *force += self.rolling.resistance(coefficient, contact);
    }
}
