//! Clocks of poses and encoders that differ.

use crate::mechanism::{Described, Mechanism};
use crate::sheet::{Draw, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::Moment;

/// Poses carry stamps of another clock.
#[derive(Clone, Copy, Debug)]
pub struct TimeOffset {
    offset: f64,
}

impl Described for TimeOffset {
    const SHEET: Sheet = Sheet {
        id: "time-offset",
        origin: Origin::Catalogue,
        law: "t_reported = t + τ",
        size: "the same",
        shares_size: true,
        family: None,
        breaks: &[Symmetry::Transient],
        trial: Trial::clock_offset("clock-and-yaw"),
        parameters: &[Parameter {
            key: "delay_s",
            unit: "s",
            range: [-2.0, 2.0],
            typical: 0.1,
            draw: Draw::reading(0.0, 0.0, [0.03, 0.15]),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { offset: values[0] }
    }
}

impl Mechanism for TimeOffset {
    fn sense(&self, moments: &mut [Moment]) {
        for moment in moments {
            moment.t += self.offset;
        }
    }
}
