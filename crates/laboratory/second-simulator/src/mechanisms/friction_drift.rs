//! Friction that changes in the course of a day.

use crate::mechanism::{Contact, Described, Mechanism, scale_ratio};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

/// Time in which 63 % of the change are done, s.
const SETTLING_TIME: f64 = 120.0;

/// The ratio of frictions goes exponentially to where it stays.
#[derive(Clone, Copy, Debug)]
pub struct FrictionDrift {
    rate: f64,
}

impl Described for FrictionDrift {
    const SHEET: Sheet = Sheet {
        id: "friction-drift",
        origin: Origin::Catalogue,
        law: "f = 1 + r T (1 − exp(−t/T)), T = 120 s, on μ_x/μ_y",
        size: "starts as 1 + r t does, and ends at 1 + r T",
        shares_size: false,
        breaks: &[Symmetry::Time],
        trial: Trial::law(Identifiability::Distinct, 5.0),
        parameters: &[Parameter {
            key: "rate_1_per_s",
            unit: "1/s",
            range: [-0.005, 0.005],
            typical: 0.001,
            draw: Draw::size(0.001).signed(),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { rate: values[0] }
    }
}

impl Mechanism for FrictionDrift {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let time = contact.scene.t;
        scale_ratio(mu, 1.0 - self.rate * SETTLING_TIME * (-time / SETTLING_TIME).exp_m1());
    }
}
