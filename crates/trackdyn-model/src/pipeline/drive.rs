//! Drive: from encoder speeds to belt speeds.

use super::change::done_at;
use trackdyn_core::{PerSide, Scalar};

/// Gain, slip and lag between encoders and belts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Ratio of belt to encoder speed, α, 1; eqs (20)-(21).
    pub gain: PerSide<f64>,
    /// Factor on the gain of a belt that runs backward, β, 1.
    pub backward: PerSide<f64>,
    /// Time at which the gains change, s since the start of the recording.
    pub changes_at: f64,
    /// Factor on the gain of a belt from then on, γ, 1.
    pub later: PerSide<f64>,
    /// Share of its speed that a belt loses per traction over normal load, 1.
    pub slip_per_traction: f64,
    /// Time constant with which each belt follows its encoder, s.
    pub time_constant: PerSide<f64>,
}

/// A factor that changes nothing.
const UNIT_FACTORS: PerSide<f64> = PerSide::new(1.0, 1.0);

impl Drive {
    /// Belts that follow the encoders exactly.
    pub fn direct() -> Self {
        Self {
            gain: UNIT_FACTORS,
            backward: UNIT_FACTORS,
            changes_at: 0.0,
            later: UNIT_FACTORS,
            slip_per_traction: 0.0,
            time_constant: PerSide::new(0.0, 0.0),
        }
    }

    /// Whether the gains are the same in both directions and at all times.
    pub fn has_one_gain(&self) -> bool {
        self.backward == UNIT_FACTORS && self.later == UNIT_FACTORS
    }

    /// Mean of the time constants of both sides, s.
    pub fn mean_lag(&self) -> f64 {
        f64::midpoint(self.time_constant.left, self.time_constant.right)
    }

    /// Steady sprocket speeds, m/s, at these encoder speeds (m/s) and time (s).
    pub fn driven(&self, shown: PerSide<f64>, time: f64) -> PerSide<f64> {
        if self.has_one_gain() {
            // V = α V_e
            return PerSide::from_fn(|side| self.gain[side] * shown[side]);
        }
        let done = done_at(time, self.changes_at);
        PerSide::from_fn(|side| {
            // V = α β (1 + (γ − 1) φ(t)) V_e, β for V_e < 0 alone
            let backward = if shown[side] < 0.0 { self.backward[side] } else { 1.0 };
            let later = 1.0 + (self.later[side] - 1.0) * done;
            self.gain[side] * backward * later * shown[side]
        })
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
