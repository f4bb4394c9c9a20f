//! A clock offset between encoders and poses.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Sensor;

/// Poses with late stamps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeOffset {
    delay: f64,
}

impl Effect for TimeOffset {
    const CARD: Card = Card {
        id: "time-offset",
        title: "Stamps of the poses late against the encoders",
        law: "reported pose(t) = pose(t − τ)",
        assumes: "A constant delay.",
        shows: "Nothing at constant speeds. Where they change, the robot seems to lag as behind a \
                slow drivetrain.",
        resembles: "A filter of the poses.",
        breaks: &[Symmetry::Transient],
        stages: &[Stage::Sense],
        parameters: &[Parameter {
            key: "delay_s",
            symbol: "τ",
            unit: "s",
            meaning: "by how much the poses are late",
            role: Role::Size { neutral: 0.0 },
            range: [-2.0, 2.0],
            typical: 0.1,
        }],
        sources: &["Definition of the clock offset"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { delay: values[0] }
    }

    fn sense(&self, sensor: &mut Sensor) {
        // reported pose(t) = pose(t − τ)
        sensor.delay += self.delay;
    }
}
