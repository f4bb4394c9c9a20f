//! A pose sensor mounted at an angle.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Sensor;

/// Heading of the pose sensor relative to the hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorYaw {
    yaw: f64,
}

impl Effect for SensorYaw {
    const CARD: Card = Card {
        id: "sensor-yaw",
        title: "Pose sensor turned on its mount",
        law: "reported velocity = R(−ψ) v",
        assumes: "A rigid mount; the yaw rate is the same in both axes.",
        shows: "A straight run seems to drift sideways in proportion to its speed. In wide turns y \
                seems to move with the radius.",
        resembles: "",
        breaks: &[Symmetry::Manoeuvre, Symmetry::Mirror, Symmetry::Straight],
        stages: &[Stage::Sense],
        parameters: &[Parameter {
            key: "yaw_deg",
            symbol: "ψ",
            unit: "deg",
            meaning: "sensor turned counter-clockwise",
            role: Role::Size { neutral: 0.0 },
            range: [-180.0, 180.0],
            typical: 1.0,
        }],
        sources: &["Rotation of axes"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { yaw: values[0].to_radians() }
    }

    fn sense(&self, sensor: &mut Sensor) {
        // reported velocity = R(−ψ) v
        sensor.yaw += self.yaw;
    }
}
