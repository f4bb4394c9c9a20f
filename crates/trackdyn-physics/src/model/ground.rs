//! What the world is where the robot stands.

use crate::contact::Friction;
use trackdyn_core::frames::paper_from_ros;
use trackdyn_core::{PerSide, STANDARD_GRAVITY};

/// Where the robot is and when, in the world's frame (REP-103).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Circumstance {
    /// Position of the robot's origin (x, y), m.
    pub position: [f64; 2],
    /// Heading of the robot's forward axis, counter-clockwise from the world's x axis, rad.
    pub heading: f64,
    /// Time since the start of the recording, s.
    pub time: f64,
}

impl Circumstance {
    /// A direction of the world in the robot's axes (paper's frame).
    pub fn to_robot(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.heading.sin_cos();
        paper_from_ros([cos * x + sin * y, cos * y - sin * x])
    }
}

/// The ground under the robot and the pull of gravity, in the paper's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Where the robot is and when.
    pub circumstance: Circumstance,
    /// Friction coefficients under each side.
    pub friction: PerSide<Friction>,
    /// Gravity along the ground, (x, y) in m/s².
    pub gravity_along: [f64; 2],
    /// Gravity into the ground, m/s².
    pub gravity_normal: f64,
}

impl Ground {
    /// Level ground with the same friction everywhere.
    pub fn level(friction: Friction, circumstance: Circumstance) -> Self {
        Self {
            circumstance,
            friction: PerSide::new(friction, friction),
            gravity_along: [0.0, 0.0],
            gravity_normal: STANDARD_GRAVITY,
        }
    }
}
