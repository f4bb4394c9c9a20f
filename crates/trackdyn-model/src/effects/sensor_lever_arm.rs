//! A pose sensor away from the origin of the hull.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Sensor;

/// Position of the pose sensor on the hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorLeverArm {
    lever: [f64; 2],
}

impl Effect for SensorLeverArm {
    const CARD: Card = Card {
        id: "sensor-lever-arm",
        title: "Pose sensor away from the origin",
        law: "reported velocity = v + ω × (Δx, Δy)",
        assumes: "A rigid mount. Poses are those of the sensor, not corrected for where it sits.",
        shows: "All ICRs appear shifted by (−Δx, −Δy), as by a constant change of the ICRs. Only \
                a measured mount tells.",
        resembles: "",
        breaks: &[Symmetry::Mirror],
        stages: &[Stage::Sense],
        parameters: &[
            Parameter {
                key: "x_m",
                symbol: "Δx",
                unit: "m",
                meaning: "sensor right of the origin",
                role: Role::Size { neutral: 0.0 },
                range: [-5.0, 5.0],
                typical: 0.05,
            },
            Parameter {
                key: "y_m",
                symbol: "Δy",
                unit: "m",
                meaning: "sensor forward of the origin",
                role: Role::Size { neutral: 0.0 },
                range: [-5.0, 5.0],
                typical: 0.1,
            },
        ],
        sources: &["Velocity of a point of a rigid body"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { lever: [values[0], values[1]] }
    }

    fn sense(&self, sensor: &mut Sensor) {
        // reported velocity = v + ω × (Δx, Δy)
        for (lever, offset) in sensor.lever.iter_mut().zip(self.lever) {
            *lever += offset;
        }
    }
}
