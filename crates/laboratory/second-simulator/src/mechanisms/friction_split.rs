//! Different friction under the two sides.

use crate::form::Draws;
use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Family, Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::PerSide;

/// One side runs on better ground than the other.
#[derive(Clone, Copy, Debug)]
pub struct FrictionSplit {
    /// What multiplies the friction of each side.
    factor: PerSide<f64>,
}

impl Described for FrictionSplit {
    const SHEET: Sheet = Sheet {
        id: "friction-split",
        origin: Origin::Catalogue,
        law: "μ_left (1 + δ), μ_right (1 − δ)",
        size: "the same",
        shares_size: true,
        family: Some(Family {
            law: "μ_left r^p, μ_right r^(p − 1), r = (1 + δ)/(1 − δ), p from 0 to 1",
            size: "the same ratio of the sides",
            shares_size: true,
        }),
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
        Self { factor: PerSide::from_fn(|side| 1.0 - side.sign() * values[0]) }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        let ratio = (1.0 + values[0]) / (1.0 - values[0]);
        let left = random.between(0.0, 1.0);
        Self { factor: PerSide::new(ratio.powf(left), ratio.powf(left - 1.0)) }
    }
}

impl Mechanism for FrictionSplit {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let factor = self.factor[contact.side];
        *mu = mu.map(|mu| mu * factor);
    }
}
