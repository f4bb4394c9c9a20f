//! A robot that does what (7)-(9) say, at once and exactly.

use trackdyn_core::frames::ros_twist_from_paper;
use trackdyn_core::{Moment, PerSide, Plant, Pose, Stopped, Trajectory, Twist};
use trackdyn_model::Kinematics;

/// Time after which a step of speed shows as one, s.
const STEP: f64 = 1e-6;

/// A robot of constant ICRs: no mass, no delays, exact arcs. What it does is known to the last
/// digit.
#[derive(Clone, Debug, PartialEq)]
pub struct Rolling {
    kinematics: Kinematics,
    moment: Moment,
}

impl Rolling {
    /// The robot at rest at t = 0.
    pub fn new(kinematics: Kinematics, pose: Pose) -> Self {
        let twist = Twist::zero();
        Self { kinematics, moment: Moment { t: 0.0, pose, twist, belt_speed: PerSide::default() } }
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
        let twist = ros_twist_from_paper(&self.kinematics.twist(speeds));
        let start = self.moment;
        let belt_speed = PerSide::from_fn(|side| self.kinematics.alpha[side] * speeds[side]);
        // A moment just after the command: between moments, speeds are taken for linear.
        for t in [start.t + STEP.min((until - start.t) / 2.0), until] {
            let pose = start.pose.compose(&Pose::exp(&twist, t - start.t));
            self.moment = Moment { t, pose, twist, belt_speed };
            trajectory.push(self.moment);
        }
        Ok(())
    }
}
