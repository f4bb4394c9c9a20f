//! A reported heading that drifts.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Sensor;

/// Constant yaw rate of the pose estimate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadingDrift {
    rate: f64,
}

impl Effect for HeadingDrift {
    const CARD: Card = Card {
        id: "heading-drift",
        title: "Drift of the reported heading",
        law: "reported yaw rate = ω + b",
        assumes: "A constant bias of a gyro or of a map that turns; the path is the one that the \
                  reported twist draws.",
        shows: "Left and right turns, fast and slow ones seem to have different ICRs; a robot at \
                rest or on a straight seems to turn.",
        resembles: "A gyroscope with a bias.",
        breaks: &[
            Symmetry::SpeedScale,
            Symmetry::Reversal,
            Symmetry::Manoeuvre,
            Symmetry::Mirror,
            Symmetry::Straight,
        ],
        stages: &[Stage::Sense],
        parameters: &[Parameter {
            key: "rate_deg_per_s",
            symbol: "b",
            unit: "deg/s",
            meaning: "yaw rate that is reported of a robot at rest",
            role: Role::Size { neutral: 0.0 },
            range: [-10.0, 10.0],
            typical: 0.5,
        }],
        sources: &["Bias of a rate gyro, e.g. Woodman, UCAM-CL-TR-696, 2007"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { rate: values[0].to_radians() }
    }

    fn sense(&self, sensor: &mut Sensor) {
        // reported yaw rate = ω + b
        sensor.yaw_rate_bias += self.rate;
    }
}
