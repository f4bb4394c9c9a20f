//! Observed minus predicted motion.

use crate::odometry::{DeadReckoning, Stretch};
use trackdyn_core::Pose;

/// Observed minus predicted motion over a stretch, in the frame of its first pose.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Residual {
    /// Forward, m.
    pub along: f64,
    /// To the left, m.
    pub across: f64,
    /// Counter-clockwise, rad.
    pub yaw: f64,
}

impl Residual {
    /// The residual of a motion.
    pub fn new(observed: &Pose, predicted: &Pose) -> Self {
        Self {
            along: observed.x - predicted.x,
            across: observed.y - predicted.y,
            yaw: observed.yaw - predicted.yaw,
        }
    }

    /// The residual of a stretch of the run that the trajectory was replayed from.
    pub fn of_stretch(stretch: &Stretch, trajectory: &DeadReckoning) -> Self {
        let [from, to] = stretch.poses.map(|index| &trajectory.poses[index - trajectory.first]);
        Self::new(&stretch.observed, &from.relative(to))
    }

    /// Distance between observed and predicted place, m.
    pub fn position(&self) -> f64 {
        self.along.hypot(self.across)
    }
}
