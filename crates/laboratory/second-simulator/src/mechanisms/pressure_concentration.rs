//! Load that the belt hands on under its rollers.

use crate::mechanism::{Described, Mechanism};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Trial};

/// Five road wheels, the outer ones over the ends of the contact.
#[derive(Clone, Copy, Debug)]
pub struct PressureConcentration {
    share: f64,
}

impl Described for PressureConcentration {
    const SHEET: Sheet = Sheet {
        id: "pressure-concentration",
        origin: Origin::Catalogue,
        law: "k(η) = 1 − κ + κ c(η) (1 + cos 4πη), c = 2 for the end rollers, else 1",
        size: "the second moment of pressure along y exceeds the even one by 0.43 κ/(1 + κ/4); a \
               U-shape 1 + κ_U (3 η² − 1)/2 exceeds it by 0.4 κ_U",
        shares_size: false,
        breaks: &[],
        trial: Trial::law(Identifiability::Indistinct, 2.25),
        parameters: &[Parameter {
            key: "concentration",
            unit: "1",
            range: [0.0, 0.95],
            typical: 0.5,
            draw: Draw::size(0.4),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { share: values[0] }
    }
}

impl Mechanism for PressureConcentration {
    fn bed(&self, y: f64, [rear, front]: [f64; 2], stiffness: &mut f64) {
        let eta = (2.0 * y - rear - front) / (front - rear);
        // half of an end roller's print lies beyond the contact, and the other half carries its
        // load
        let carries = if eta.abs() > 0.75 { 2.0 } else { 1.0 };
        let print = 1.0 + (4.0 * std::f64::consts::PI * eta).cos();
        *stiffness *= 1.0 - self.share + self.share * carries * print;
    }
}
