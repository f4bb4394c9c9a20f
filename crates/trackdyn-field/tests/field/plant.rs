//! A robot that does what (7)-(9) say, at once and exactly.

use trackdyn_core::frames::ros_twist_from_paper;
use trackdyn_core::{Moment, PerSide, Plant, Pose, Stopped, Trajectory, Twist};
use trackdyn_motion::{Icrs, Kinematics};

/// Auriga-alpha's ICRs as the paper prints them, m.
pub const AURIGA: Icrs = Icrs { x_left: -0.375, x_right: 0.457, y: 0.0492 };

/// Time after which a step of speed shows as one, s.
const STEP: f64 = 1e-6;

/// The robot.
pub struct Rolling {
    kinematics: Kinematics,
    moment: Moment,
    /// When it stops for good, s.
    pub breaks_down: f64,
}

impl Rolling {
    pub fn new(kinematics: Kinematics, pose: Pose) -> Self {
        let twist = Twist { v_x: 0.0, v_y: 0.0, w: 0.0 };
        let moment = Moment { t: 0.0, pose, twist, belt_speed: PerSide::default() };
        Self { kinematics, moment, breaks_down: f64::INFINITY }
    }

    pub fn auriga() -> Self {
        Self::new(Kinematics::new(AURIGA), Pose::default())
    }
}

impl Plant for Rolling {
    fn moment(&self) -> Moment {
        self.moment
    }

    fn drive(
        &mut self,
        speeds: PerSide<f64>,
        until: f64,
        trajectory: &mut Trajectory,
    ) -> Result<(), Stopped> {
        if until > self.breaks_down {
            return Err(Stopped { t: self.moment.t, reason: "a track is off".to_owned() });
        }
        let twist = ros_twist_from_paper(&self.kinematics.twist(speeds));
        let start = self.moment;
        let belt_speed = PerSide::from_fn(|side| self.kinematics.alpha[side] * speeds[side]);
        for t in [start.t + STEP, until] {
            let pose = start.pose.compose(&Pose::exp(&twist, t - start.t));
            self.moment = Moment { t, pose, twist, belt_speed };
            trajectory.push(self.moment);
        }
        Ok(())
    }
}
