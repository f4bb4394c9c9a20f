//! Ground that holds the tracks back.

use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

/// Belt speed at which the ground resists with 71 %, m/s.
const ONSET_SPEED: f64 = 2e-3;

/// Force along the track that holds a shoe back, N.
pub(super) fn resistance(coefficient: f64, contact: &Contact) -> f64 {
    let speed = contact.scene.sprocket[contact.side];
    -coefficient * contact.load * speed / (speed * speed + ONSET_SPEED * ONSET_SPEED).sqrt()
}

/// Each shoe pays for the ground it presses in.
#[derive(Clone, Copy, Debug)]
pub struct MotionResistance {
    coefficient: f64,
}

impl Described for MotionResistance {
    const SHEET: Sheet = Sheet {
        id: "motion-resistance",
        origin: Origin::Catalogue,
        law: "R = −c N V/√(V² + v₀²) on every shoe, v₀ = 2 mm/s",
        size: "the same above 2 cm/s; below, it comes up smoothly",
        shares_size: true,
        breaks: &[Symmetry::Manoeuvre],
        trial: Trial::law(Identifiability::DistinctWhenLarge, 6.0),
        parameters: &[Parameter {
            key: "coefficient",
            unit: "1",
            range: [0.0, 0.5],
            typical: 0.05,
            draw: Draw::size(0.05),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { coefficient: values[0] }
    }
}

impl Mechanism for MotionResistance {
    fn resistance(&self, contact: &Contact, force: &mut f64) {
        *force += resistance(self.coefficient, contact);
    }
}
