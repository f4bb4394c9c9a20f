//! Force and moment on the body in the plane.

use crate::Scalar;

/// Planar wrench on the body, about the frame's origin and in the frame's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<S = f64> {
    /// Force along the frame's x axis, N.
    pub force_x: S,
    /// Force along the frame's y axis, N.
    pub force_y: S,
    /// Moment about the origin, counter-clockwise positive, N·m.
    pub moment: S,
}

impl<S: Scalar> Wrench<S> {
    /// No force, no moment.
    #[inline]
    pub fn zero() -> Self {
        let zero = S::from(0.0);
        Self { force_x: zero, force_y: zero, moment: zero }
    }

    /// The wrench times a factor.
    #[inline]
    pub fn scaled(self, factor: S) -> Self {
        Self {
            force_x: self.force_x * factor,
            force_y: self.force_y * factor,
            moment: self.moment * factor,
        }
    }

    /// Adds a force that acts at the body point (x, y).
    #[inline]
    pub fn add_force(&mut self, [force_x, force_y]: [S; 2], [x, y]: [f64; 2]) {
        self.force_x += force_x;
        self.force_y += force_y;
        // M = x F_y − y F_x
        self.moment += force_y * x - force_x * y;
    }
}

impl<S: Scalar> std::ops::AddAssign for Wrench<S> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.force_x += other.force_x;
        self.force_y += other.force_y;
        self.moment += other.moment;
    }
}
