//! Where the robot takes itself to be.

use super::Steering;
use trackdyn_core::{Moment, PerSide, Pose};

/// How a robot knows its pose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Estimate {
    /// Someone tells it the truth.
    #[default]
    Truth,
    /// Dead reckoning from its encoders by its own kinematics, (7)-(9), from the true pose at the
    /// start.
    Odometry,
}

/// The pose that a robot takes for its own.
pub(super) struct Belief<'a> {
    estimate: Estimate,
    steering: &'a dyn Steering,
    pose: Pose,
}

impl<'a> Belief<'a> {
    pub(super) fn new(estimate: Estimate, steering: &'a dyn Steering, start: Pose) -> Self {
        Self { estimate, steering, pose: start }
    }

    pub(super) fn pose(&self) -> Pose {
        self.pose
    }

    /// Updates the estimate with the moments since the last call, the present one included. In them
    /// the encoders showed these speeds, m/s. Encoders sit on the sprockets and show the commands,
    /// whatever the belts do.
    pub(super) fn moved(&mut self, moments: &[Moment], shown: PerSide<f64>) {
        let [first, .., last] = moments else { return };
        if self.estimate == Estimate::Truth {
            self.pose = last.pose;
            return;
        }
        let duration = last.t - first.t;
        self.pose = self.pose.compose(&Pose::exp(&self.steering.twist(shown), duration));
    }
}
