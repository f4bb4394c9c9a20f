//! A pose sensor that is mounted askew.

use crate::mechanism::{Described, Mechanism};
use crate::sheet::{Draw, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::{Moment, Twist};

/// The reported yaw is that of the sensor.
#[derive(Clone, Copy, Debug)]
pub struct SensorYaw {
    yaw: f64,
}

impl Described for SensorYaw {
    const SHEET: Sheet = Sheet {
        id: "sensor-yaw",
        origin: Origin::Catalogue,
        law: "world_from_sensor = world_from_body · rotation(ψ)",
        size: "the same",
        shares_size: true,
        family: None,
        breaks: &[Symmetry::Manoeuvre, Symmetry::Mirror, Symmetry::Straight],
        trial: Trial::instrument("clock-and-yaw", 0.2),
        parameters: &[Parameter {
            key: "yaw_deg",
            unit: "deg",
            range: [-180.0, 180.0],
            typical: 2.0,
            draw: Draw::reading(0.0, 0.5, [0.5, 3.0]),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { yaw: values[0].to_radians() }
    }
}

impl Mechanism for SensorYaw {
    fn sense(&self, moments: &mut [Moment]) {
        let (sin, cos) = self.yaw.sin_cos();
        for Moment { pose, twist, .. } in moments {
            pose.yaw += self.yaw;
            let Twist { v_x, v_y, w } = *twist;
            *twist = Twist { v_x: cos * v_x + sin * v_y, v_y: cos * v_y - sin * v_x, w };
        }
    }
}
