//! Velocity of the body in the plane.

use crate::Scalar;

/// Planar twist of the body, at the frame's origin and in the frame's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist<S = f64> {
    /// Velocity of the origin along the frame's x axis, m/s.
    pub v_x: S,
    /// Velocity of the origin along the frame's y axis, m/s.
    pub v_y: S,
    /// Yaw rate, counter-clockwise positive, rad/s.
    pub w: S,
}

impl<S: Scalar> Twist<S> {
    /// Velocity of the body point (x, y), m/s.
    #[inline]
    pub fn velocity_at(&self, [x, y]: [f64; 2]) -> [S; 2] {
        [self.v_x - self.w * y, self.v_y + self.w * x]
    }

    /// Acceleration of the body point (x, y) when the twist stays constant in the body's axes, m/s².
    #[inline]
    pub fn steady_acceleration_at(&self, point: [f64; 2]) -> [S; 2] {
        let [v_x, v_y] = self.velocity_at(point);
        // a = ω × v
        [-self.w * v_y, self.w * v_x]
    }
}
