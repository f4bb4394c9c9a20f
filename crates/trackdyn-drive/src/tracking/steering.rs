//! What turns set-points into track speeds, and track speeds into motion.

use trackdyn_core::frames::ros_twist_from_paper;
use trackdyn_core::{PerSide, Twist};
use trackdyn_model::Kinematics;
use trackdyn_model::kinematics::KinematicsFile;

/// A kinematic model, both ways.
pub trait Steering {
    /// Track speeds as encoders show them, m/s, for a forward speed (m/s) and a yaw rate (rad/s),
    /// eqs (10)-(11); and the constants that give them.
    fn track_speeds(&self, forward: f64, yaw_rate: f64) -> (PerSide<f64>, Kinematics);

    /// Twist in ROS axes at the track speeds that encoders show, m/s, eqs (7)-(9).
    fn twist(&self, measured: PerSide<f64>) -> Twist;
}

impl Steering for Kinematics {
    fn track_speeds(&self, forward: f64, yaw_rate: f64) -> (PerSide<f64>, Kinematics) {
        (Kinematics::track_speeds(self, forward, yaw_rate), *self)
    }

    fn twist(&self, measured: PerSide<f64>) -> Twist {
        ros_twist_from_paper(&Kinematics::twist(self, measured))
    }
}

/// By sector where the map is piecewise.
impl Steering for KinematicsFile {
    fn track_speeds(&self, forward: f64, yaw_rate: f64) -> (PerSide<f64>, Kinematics) {
        KinematicsFile::track_speeds(self, forward, yaw_rate)
    }

    fn twist(&self, measured: PerSide<f64>) -> Twist {
        ros_twist_from_paper(&self.kinematics_at(measured).twist(measured))
    }
}
