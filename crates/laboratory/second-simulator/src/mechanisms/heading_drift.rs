//! A heading that turns away.

use crate::mechanism::{Described, Mechanism};
use crate::sheet::{Invariance, Origin, Parameter, Sheet};
use trackdyn_core::{Moment, Pose, Twist};

/// The offset of the gyro from which a map is built: the way is laid on along the wrong heading.
#[derive(Clone, Copy, Debug)]
pub struct HeadingDrift {
    rate: f64,
}

impl Described for HeadingDrift {
    const SHEET: Sheet = Sheet {
        id: "heading-drift",
        origin: Origin::Catalogue,
        law: "yaw_reported = yaw + r t, and the way from moment to moment in that heading",
        size: "the same",
        breaks: &[
            Invariance::SpeedScale,
            Invariance::Reversal,
            Invariance::Manoeuvre,
            Invariance::Mirror,
            Invariance::Straight,
        ],
        parameters: &[Parameter {
            key: "rate_deg_per_s",
            unit: "deg/s",
            range: [-10.0, 10.0],
            typical: 0.3,
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { rate: values[0].to_radians() }
    }
}

impl Mechanism for HeadingDrift {
    fn sense(&self, moments: &mut [Moment]) {
        let Some(first) = moments.first().copied() else { return };
        let (mut t, mut true_pose, mut pose) = (first.t, first.pose, first.pose);
        for moment in moments {
            let way = true_pose.relative(&moment.pose);
            let twist = way.log(1.0);
            let turned = Twist { w: twist.w + self.rate * (moment.t - t), ..twist };
            pose = pose.compose(&Pose::exp(&turned, 1.0));
            (t, true_pose) = (moment.t, moment.pose);
            moment.pose = pose;
            moment.twist.w += self.rate;
        }
    }
}
