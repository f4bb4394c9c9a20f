//! A heading that turns away.

use crate::mechanism::{Described, Mechanism};
use crate::sheet::{Invariance, Origin, Parameter, Sheet};
use trackdyn_core::{Moment, Twist};

/// A gyro's offset in the reported yaw.
#[derive(Clone, Copy, Debug)]
pub struct HeadingDrift {
    rate: f64,
}

impl Described for HeadingDrift {
    const SHEET: Sheet = Sheet {
        id: "heading-drift",
        origin: Origin::Catalogue,
        law: "yaw_reported = yaw + r t",
        size: "the same",
        breaks: &[Invariance::SpeedScale, Invariance::Reversal, Invariance::Mirror, Invariance::Straight],
        parameters: &[Parameter { key: "rate_deg_per_s", unit: "deg/s", range: [-10.0, 10.0], typical: 0.3 },],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { rate: values[0].to_radians() }
    }
}

impl Mechanism for HeadingDrift {
    fn sense(&self, moment: &mut Moment) {
        let turned = self.rate * moment.t;
        moment.pose.yaw += turned;
        let Twist { v_x, v_y, w } = moment.twist;
        let (sin, cos) = turned.sin_cos();
        moment.twist =
            Twist { v_x: cos * v_x + sin * v_y, v_y: cos * v_y - sin * v_x, w: w + self.rate };
    }
}
