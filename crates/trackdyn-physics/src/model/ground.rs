//! What the world is where the robot stands.

use crate::contact::Friction;
use trackdyn_core::{PerSide, STANDARD_GRAVITY};

/// Where the robot is and when, in the world's frame (REP-103).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Circumstance {
    /// Heading of the robot's forward axis, counter-clockwise from the world's x axis, rad.
    pub heading: f64,
}

/// The ground under the robot and the pull of gravity, in the paper's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Friction coefficients under each side.
    pub friction: PerSide<Friction>,
    /// Gravity along the ground, (x, y) in m/s².
    pub gravity_along: [f64; 2],
    /// Gravity into the ground, m/s².
    pub gravity_normal: f64,
}

impl Ground {
    /// Level ground with the same friction everywhere.
    pub fn level(friction: Friction) -> Self {
        Self {
            friction: PerSide::new(friction, friction),
            gravity_along: [0.0, 0.0],
            gravity_normal: STANDARD_GRAVITY,
        }
    }
}
