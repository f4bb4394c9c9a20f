//! Direct and inverse kinematics with constant ICRs, eqs (7)-(11).

mod file;
mod separation;

pub use file::{BagSource, GridSource, KinematicsFile, Source};
pub use separation::SeparationFile;

use crate::icr::Icrs;
use trackdyn_core::{PerSide, Twist};

/// The kinematic model of a tracked vehicle: constant ICRs, and factors on the measured speeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kinematics {
    /// ICRs of the tracks, m.
    pub icrs: Icrs,
    /// Factors α_l, α_r from measured to true track speeds, eqs (20)-(21); 1 where not fitted.
    pub alpha: PerSide<f64>,
}

impl Kinematics {
    /// Constant ICRs, speeds as measured.
    pub fn new(icrs: Icrs) -> Self {
        Self { icrs, alpha: PerSide::new(1.0, 1.0) }
    }

    /// Ideal differential drive: ICRs on the track centre-lines.
    pub fn ideal(gauge: f64) -> Self {
        Self::new(Icrs { x_left: -gauge / 2.0, x_right: gauge / 2.0, y: 0.0 })
    }

    /// Twist (paper's frame) at measured track speeds, m/s: direct kinematics.
    pub fn twist(&self, measured: PerSide<f64>) -> Twist {
        let Icrs { x_left, x_right, y } = self.icrs;
        // V = α V_measured, eqs (20)-(21)
        let (v_l, v_r) = (self.alpha.left * measured.left, self.alpha.right * measured.right);
        let gap = x_right - x_left;
        // ω = (V_r − V_l)/(x_r − x_l), eq. (9)
        let w = (v_r - v_l) / gap;
        Twist {
            // v_x = (V_r − V_l)/(x_r − x_l) · y, eq. (7)
            v_x: w * y,
            // v_y = (V_r + V_l)/2 − (V_r − V_l)/(x_r − x_l) · (x_r + x_l)/2, eq. (8)
            v_y: f64::midpoint(v_r, v_l) - w * f64::midpoint(x_right, x_left),
            w,
        }
    }

    /// Measured track speeds, m/s, for a forward speed and a yaw rate: inverse kinematics. The
    /// lateral speed v_x = ω y follows and cannot be chosen.
    pub fn track_speeds(&self, forward: f64, yaw_rate: f64) -> PerSide<f64> {
        let Icrs { x_left, x_right, .. } = self.icrs;
        PerSide {
            // V_l = v_y + x_l ω, eq. (10)
            left: (forward + x_left * yaw_rate) / self.alpha.left,
            // V_r = v_y + x_r ω, eq. (11)
            right: (forward + x_right * yaw_rate) / self.alpha.right,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asymmetric() -> Kinematics {
        Kinematics {
            icrs: Icrs { x_left: -0.375, x_right: 0.457, y: 0.049 },
            alpha: PerSide::new(0.97, 1.02),
        }
    }

    #[test]
    fn inverse_undoes_direct() {
        for (left, right) in [(0.3, 0.9), (-0.5, 0.5), (0.4, 0.4), (0.0, -1.0)] {
            let kinematics = asymmetric();
            let twist = kinematics.twist(PerSide::new(left, right));
            let back = kinematics.track_speeds(twist.v_y, twist.w);
            assert!((back.left - left).abs() < 1e-15 && (back.right - right).abs() < 1e-15);
        }
    }

    #[test]
    fn each_belt_rolls_at_its_icr() {
        let Kinematics { icrs, .. } = asymmetric();
        let twist = Kinematics::new(icrs).twist(PerSide::new(0.3, 0.9));
        for (x, speed) in [(icrs.x_left, 0.3), (icrs.x_right, 0.9)] {
            let [v_x, v_y] = twist.velocity_at([x, icrs.y]);
            assert!(v_x.abs() < 1e-15 && (v_y - speed).abs() < 1e-15);
        }
    }

    #[test]
    fn ideal_drive_spins_with_the_gauge() {
        let twist = Kinematics::ideal(0.42).twist(PerSide::new(-0.21, 0.21));
        assert!((twist.w - 1.0).abs() < 1e-15 && twist.v_y == 0.0 && twist.v_x == 0.0);
    }
}
