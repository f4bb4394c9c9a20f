//! A heading that turns away.

use crate::mechanism::{Described, Mechanism};
use crate::sheet::{Draw, Origin, Parameter, Sheet, Symmetry, Trial};
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
        shares_size: true,
        family: None,
        breaks: &[
            Symmetry::SpeedScale,
            Symmetry::Reversal,
            Symmetry::Manoeuvre,
            Symmetry::Mirror,
            Symmetry::Straight,
        ],
        trial: Trial::instrument("heading-drift", 0.0),
        parameters: &[Parameter {
            key: "rate_deg_per_s",
            unit: "deg/s",
            range: [-10.0, 10.0],
            typical: 0.3,
            draw: Draw::reading(0.0, 0.0, [0.05, 0.4]),
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
