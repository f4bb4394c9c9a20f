//! Slip velocity of a belt over the ground.

use super::Patch;
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

    /// Squared distance from the centre of a patch to the ICR, in half diagonals of the patch;
    /// infinite where the field does not rotate.
    #[inline]
    pub fn icr_distance_squared(&self, patch: &Patch) -> f64 {
        let [x, y] = patch.centre();
        let (lateral, forward, rotation) =
            (self.lateral.value(), self.forward.value(), self.rotation.value());
        // |s(centre)| = |rotation| · distance from the centre to the ICR
        let slip_squared = (lateral - rotation * y).powi(2) + (forward + rotation * x).powi(2);
        let half_diagonal_squared = (patch.width().powi(2) + patch.length().powi(2)) / 4.0;
        slip_squared / (rotation * rotation * half_diagonal_squared)
    }
}
