//! Friction that changes in the course of a day.

use crate::form::Draws;
use crate::mechanism::{Contact, Described, Mechanism, scale_ratio, share_ratio};
use crate::sheet::{Family, Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

/// Time in which 63 % of the change are done, s.
const SETTLING_TIME: f64 = 300.0;

/// Largest logarithm of a factor: friction that has changed five times has changed enough.
const MAX_LN_FACTOR: f64 = 1.6;

/// The ratio of frictions goes exponentially to where it stays.
#[derive(Clone, Copy, Debug)]
pub struct FrictionDrift {
    rate: f64,
    course: Course,
}

/// How it goes in time.
#[derive(Clone, Copy, Debug)]
enum Course {
    /// Exponentially.
    Settles,
    /// Levelling off, straight on or ever faster.
    Other { levels: Option<f64>, power: f64, across: f64 },
}

impl Described for FrictionDrift {
    const SHEET: Sheet = Sheet {
        id: "friction-drift",
        origin: Origin::Catalogue,
        law: "f = 1 + r T (1 − exp(−t/T)), T = 300 s, on μ_x/μ_y",
        size: "starts as 1 + r t does, and ends at 1 + r T",
        shares_size: false,
        family: Some(Family {
            law: "f = (1 + r t₀)^(φ(t/t₀)/φ(1)) on μ_x/μ_y, t₀ = 300 s, φ = 1 − exp(−τ/θ) with θ \
                  from 0.5 to 4, or τ^p with p from 0.5 to 1.8; f^q of it on μ_x, q from 0 to 1",
            size: "equal to 1 + r t at 300 s",
            shares_size: false,
        }),
        breaks: &[Symmetry::Time],
        trial: Trial::law(Identifiability::Distinct, 5.0),
        parameters: &[Parameter {
            key: "rate_1_per_s",
            unit: "1/s",
            range: [-0.003, 0.003],
            typical: 0.001,
            draw: Draw::size(0.001).signed(),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { rate: values[0], course: Course::Settles }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        let levels = random.happens(0.4).then(|| random.between(0.5, 4.0));
        let (power, across) = (random.between(0.5, 1.8), random.between(0.0, 1.0));
        Self { rate: values[0], course: Course::Other { levels, power, across } }
    }
}

impl Mechanism for FrictionDrift {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let time = contact.scene.t;
        match self.course {
            Course::Settles => {
                let change = -self.rate * SETTLING_TIME * (-time / SETTLING_TIME).exp_m1();
                scale_ratio(mu, 1.0 + change);
            }
            Course::Other { levels, power, across } => {
                let passed = (time / SETTLING_TIME).max(0.0);
                let course = match levels {
                    Some(levels) => (-passed / levels).exp_m1() / (-1.0 / levels).exp_m1(),
                    None => passed.powf(power),
                };
                let change = (self.rate * SETTLING_TIME).ln_1p() * course;
                let factor = change.clamp(-MAX_LN_FACTOR, MAX_LN_FACTOR).exp();
                share_ratio(mu, factor, across);
            }
        }
    }
}
