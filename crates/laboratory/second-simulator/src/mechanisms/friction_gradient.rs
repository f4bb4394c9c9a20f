//! More friction under the front than under the rear.

use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Trial};

/// A step of friction in the middle of the contact.
#[derive(Clone, Copy, Debug)]
pub struct FrictionGradient {
    step: f64,
}

impl Described for FrictionGradient {
    const SHEET: Sheet = Sheet {
        id: "friction-gradient",
        origin: Origin::Catalogue,
        law: "μ (1 + (2/3) γ tanh(5 η)), η = y over the half length of a side's contact",
        size: "a step of 2/3 γ has the first moment along y of the linear law 1 + γ η",
        shares_size: false,
        breaks: &[],
        trial: Trial::law(Identifiability::Indistinct, 5.0),
        parameters: &[Parameter {
            key: "gradient",
            unit: "1",
            range: [-0.9, 0.9],
            typical: 0.1,
            draw: Draw::size(0.1).signed(),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        // ∫ η γ η dη = ∫ |η| step dη over the contact
        Self { step: 2.0 / 3.0 * values[0] }
    }
}

impl Mechanism for FrictionGradient {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let factor = 1.0 + self.step * (5.0 * contact.relative_y()).tanh();
        *mu = mu.map(|mu| mu * factor);
    }
}
