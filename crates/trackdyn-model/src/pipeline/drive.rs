//! Drive: from encoder speeds to belt speeds.

use trackdyn_core::{PerSide, Scalar};

/// Gain, slip and lag between encoders and belts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Ratio of belt to encoder speed, α, 1; eqs (20)-(21).
    pub gain: PerSide<f64>,
    /// Share of its speed that a belt loses per traction over normal load, 1.
    pub slip_per_traction: f64,
    /// Time constant with which the belts follow the encoders, s.
    pub time_constant: f64,
}

impl Drive {
    /// Belts that follow the encoders exactly.
    pub fn direct() -> Self {
        Self { gain: PerSide::new(1.0, 1.0), slip_per_traction: 0.0, time_constant: 0.0 }
    }

    /// Steady sprocket speeds, m/s, at these encoder speeds (m/s).
    pub fn driven(&self, shown: PerSide<f64>) -> PerSide<f64> {
        // V = α V_e
        PerSide::from_fn(|side| self.gain[side] * shown[side])
    }

    /// Belt speeds, m/s, for these sprocket speeds (m/s) and the traction of each side over its
    /// normal load, forward positive, 1.
    pub fn belt_speed<S: Scalar>(&self, driven: PerSide<f64>, traction: PerSide<S>) -> PerSide<S> {
        PerSide::from_fn(|side| {
            // V = V_d − κ |V_d| T/N
            -traction[side] * (self.slip_per_traction * driven[side].abs()) + driven[side]
        })
    }
}
