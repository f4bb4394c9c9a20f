//! Slip velocity of a belt over the ground.

use trackdyn_core::Scalar;

/// Slip velocity field of one side: `s(x, y) = speed · (lateral − rotation·y, forward +
/// rotation·x)`.
///
/// Coulomb friction depends on the direction only, so the field has a separate scale: the direction
/// stays defined when the robot drives straight and the slip vanishes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlipField<S = f64> {
    /// Unit slip of the origin along x, 1.
    pub lateral: S,
    /// Unit slip of the origin along y, 1.
    pub forward: S,
    /// Rotation of the unit field, 1/m; its sign is the sense of turning.
    pub rotation: S,
    /// Scale of the field, m/s, not negative.
    pub speed: S,
}

impl<S: Scalar> SlipField<S> {
    /// Unit slip at the body point (x, y).
    #[inline]
    pub fn direction_at(&self, [x, y]: [S; 2]) -> [S; 2] {
        [self.lateral - self.rotation * y, self.forward + self.rotation * x]
    }

    /// Zero of the field: ICR of the track, m. Infinite where the field does not rotate.
    #[inline]
    pub fn icr(&self) -> [S; 2] {
        let inverse = self.rotation.recip();
        [-self.forward * inverse, self.lateral * inverse]
    }
}
