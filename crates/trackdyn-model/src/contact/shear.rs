//! Change of the shear stress at a point by effects.

use trackdyn_core::Scalar;

/// Shear stress at a point with effects: τ = f ∘ (τ_base + τ_added).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearStress<S> {
    /// Factors f on the stress across and along the track, 1.
    pub factor: [S; 2],
    /// Added stress on the body, across and along the track, Pa.
    pub added: [S; 2],
}

impl<S: Scalar> ShearStress<S> {
    /// The base law alone.
    #[inline]
    pub fn base() -> Self {
        Self { factor: [S::from(1.0); 2], added: [S::from(0.0); 2] }
    }

    /// Multiplies both factors.
    #[inline]
    pub fn scale(&mut self, factor: S) {
        self.scale_each([factor; 2]);
    }

    /// Multiplies the factors across and along the track.
    #[inline]
    pub fn scale_each(&mut self, [across, along]: [S; 2]) {
        self.factor = [self.factor[0] * across, self.factor[1] * along];
    }
}
