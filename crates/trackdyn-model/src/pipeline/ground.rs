//! Ground and gravity at the robot's place, heading and time.

use crate::contact::Friction;
use crate::contact::pressure::Footprint;
use crate::vehicle::Vehicle;
use trackdyn_core::frames::{paper_from_ros, ros_from_paper};
use trackdyn_core::{PerSide, Pose, STANDARD_GRAVITY, Side};

/// Place, heading and time of the robot, in the world's frame (REP-103).
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

    /// A point of the robot (paper's frame) in the world, m.
    pub fn to_world(&self, place: [f64; 2]) -> [f64; 2] {
        let ([x, y], [ahead, left]) = (self.position, ros_from_paper(place));
        let there = Pose::new(x, y, self.heading).compose(&Pose::new(ahead, left, 0.0));
        [there.x, there.y]
    }
}

/// Ground under the robot, and gravity, in the paper's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Place, heading and time.
    pub circumstance: Circumstance,
    /// Rear and front end of the middle line of each side's contact, m.
    pub lines: PerSide<[[f64; 2]; 2]>,
    /// Friction coefficients under each side.
    pub friction: PerSide<Friction>,
    /// Gravity along the ground, (x, y) in m/s².
    pub gravity_along: [f64; 2],
    /// Gravity into the ground, m/s².
    pub gravity_normal: f64,
}

impl Ground {
    /// Level ground with uniform friction, under a vehicle with this contact on each side.
    pub fn level(vehicle: &Vehicle, footprint: &Footprint, circumstance: Circumstance) -> Self {
        let line = |side: Side| footprint.ends.map(|y| [side.sign() * vehicle.gauge / 2.0, y]);
        Self {
            circumstance,
            lines: PerSide::from_fn(line),
            friction: PerSide::new(vehicle.friction, vehicle.friction),
            gravity_along: [0.0, 0.0],
            gravity_normal: STANDARD_GRAVITY,
        }
    }
}
