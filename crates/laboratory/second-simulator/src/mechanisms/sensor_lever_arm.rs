//! A pose sensor that is not mounted over the origin.

use crate::mechanism::{Described, Mechanism};
use crate::sheet::{Draw, Origin, Parameter, Scale, Sheet, Symmetry, Trial};
use trackdyn_core::{Moment, Pose, Twist, frames};

/// The reported pose is that of another point of the hull.
#[derive(Clone, Copy, Debug)]
pub struct SensorLeverArm {
    arm: [f64; 2],
}

impl Described for SensorLeverArm {
    const SHEET: Sheet = Sheet {
        id: "sensor-lever-arm",
        origin: Origin::Catalogue,
        law: "world_from_sensor = world_from_body · (x, y)",
        size: "the same",
        shares_size: true,
        family: None,
        breaks: &[Symmetry::Mirror],
        trial: Trial::instrument("lever-arm", 0.3),
        parameters: &[
            Parameter {
                key: "x_m",
                unit: "m",
                range: [-5.0, 5.0],
                typical: 0.1,
                draw: Draw::reading(0.0, 0.12, [0.1, 0.5]).times(Scale::Gauge),
            },
            Parameter {
                key: "y_m",
                unit: "m",
                range: [-5.0, 5.0],
                typical: 0.2,
                draw: Draw::reading(0.0, 0.12, [0.1, 0.5]).times(Scale::Gauge),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { arm: [values[0], values[1]] }
    }
}

impl Mechanism for SensorLeverArm {
    fn sense(&self, moments: &mut [Moment]) {
        let [x, y] = frames::ros_from_paper(self.arm);
        for Moment { pose, twist, .. } in moments {
            *pose = pose.compose(&Pose::new(x, y, 0.0));
            let [v_x, v_y] = twist.velocity_at([x, y]);
            *twist = Twist { v_x, v_y, w: twist.w };
        }
    }
}
