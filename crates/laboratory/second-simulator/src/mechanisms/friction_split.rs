//! Different friction under the two sides.

use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

/// One side runs on better ground than the other.
#[derive(Clone, Copy, Debug)]
pub struct FrictionSplit {
    split: f64,
}

impl Described for FrictionSplit {
    const SHEET: Sheet = Sheet {
        id: "friction-split",
        origin: Origin::Catalogue,
        law: "μ_left (1 + δ), μ_right (1 − δ)",
        size: "the same",
        shares_size: true,
        breaks: &[Symmetry::Mirror],
        trial: Trial::law(Identifiability::Indistinct, 5.0),
        parameters: &[Parameter {
            key: "split",
            unit: "1",
            range: [-0.9, 0.9],
            typical: 0.1,
            draw: Draw::size(0.1).signed(),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { split: values[0] }
    }
}

impl Mechanism for FrictionSplit {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let factor = 1.0 - contact.side.sign() * self.split;
        *mu = mu.map(|mu| mu * factor);
    }
}
