//! Other ground for a while.

use crate::form::Draws;
use crate::mechanism::{Contact, Described, Mechanism, scale_ratio, share_ratio};
use crate::sheet::{Draw, Family, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

/// Another ratio of frictions between two times.
#[derive(Clone, Copy, Debug)]
pub struct GroundChange {
    factor: f64,
    from: f64,
    until: f64,
    /// Time in which the ground changes, s, and the share of the change that is across; at once and
    /// evenly for none.
    course: Option<[f64; 2]>,
}

impl Described for GroundChange {
    const SHEET: Sheet = Sheet {
        id: "ground-change",
        origin: Origin::Catalogue,
        law: "κ on μ_x/μ_y for t₀ ≤ t < t₁",
        size: "the same",
        shares_size: true,
        family: Some(Family {
            law: "κ on μ_x/μ_y, within 0 to 10 s, κ^q of it on μ_x, q from 0 to 1",
            size: "the same",
            shares_size: true,
        }),
        breaks: &[Symmetry::Time],
        trial: Trial::law(Identifiability::Distinct, 4.0).with_drawn_forms_only(),
        parameters: &[
            Parameter {
                key: "across_factor",
                unit: "1",
                range: [0.3, 3.0],
                typical: 1.2,
                draw: Draw::factor(1.2).signed(),
            },
            Parameter {
                key: "from_s",
                unit: "s",
                range: [-1e6, 1e6],
                typical: 60.0,
                draw: Draw::shape(60.0, 160.0, &[]),
            },
            Parameter {
                key: "until_s",
                unit: "s",
                range: [-1e6, 1e6],
                typical: 120.0,
                draw: Draw::shape(220.0, 340.0, &[]),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { factor: values[0], from: values[1], until: values[2], course: None }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        let course = [random.between(0.0, 10.0), random.between(0.0, 1.0)];
        Self { course: Some(course), ..Self::from_values(values) }
    }
}

impl Mechanism for GroundChange {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let time = contact.scene.t;
        let Some([takes, across]) = self.course else {
            if (self.from..self.until).contains(&time) {
                scale_ratio(mu, self.factor);
            }
            return;
        };
        let done = |at: f64| ((time - at) / takes.max(1e-3) + 0.5).clamp(0.0, 1.0);
        let there = (done(self.from) - done(self.until)).max(0.0);
        share_ratio(mu, self.factor.powf(there), across);
    }
}
