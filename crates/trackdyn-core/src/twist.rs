//! Velocity of the body in the plane.

use crate::Scalar;
use std::ops::{Add, AddAssign, Div, Mul, Sub};

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
    /// No motion.
    #[inline]
    pub fn zero() -> Self {
        let zero = S::from(0.0);
        Self { v_x: zero, v_y: zero, w: zero }
    }

    /// From (v_x, v_y, w).
    #[inline]
    pub fn from_array([v_x, v_y, w]: [S; 3]) -> Self {
        Self { v_x, v_y, w }
    }

    /// (v_x, v_y, w).
    #[inline]
    pub fn to_array(self) -> [S; 3] {
        [self.v_x, self.v_y, self.w]
    }

    /// Velocity of the body point (x, y), m/s.
    #[inline]
    pub fn velocity_at(&self, [x, y]: [f64; 2]) -> [S; 2] {
        [self.v_x - self.w * y, self.v_y + self.w * x]
    }

    /// Acceleration of the body point (x, y) when the twist stays constant in the body's axes,
    /// m/s².
    #[inline]
    pub fn steady_acceleration_at(&self, point: [f64; 2]) -> [S; 2] {
        let [v_x, v_y] = self.velocity_at(point);
        // a = ω × v
        [-self.w * v_y, self.w * v_x]
    }
}

impl<S: Scalar> Add for Twist<S> {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self { v_x: self.v_x + other.v_x, v_y: self.v_y + other.v_y, w: self.w + other.w }
    }
}

impl<S: Scalar> AddAssign for Twist<S> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Scalar> Sub for Twist<S> {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        Self { v_x: self.v_x - other.v_x, v_y: self.v_y - other.v_y, w: self.w - other.w }
    }
}

impl Div<f64> for Twist {
    type Output = Self;

    #[inline]
    fn div(self, divisor: f64) -> Self {
        Self::from_array(self.to_array().map(|part| part / divisor))
    }
}

impl<S: Scalar> Mul<S> for Twist<S> {
    type Output = Self;

    #[inline]
    fn mul(self, factor: S) -> Self {
        Self { v_x: self.v_x * factor, v_y: self.v_y * factor, w: self.w * factor }
    }
}
