//! What turns set-points into track speeds, and track speeds into motion.

use trackdyn_core::frames::{paper_twist_from_ros, ros_twist_from_paper};
use trackdyn_core::{PerSide, Twist};
use trackdyn_model::kinematics::KinematicsFile;
use trackdyn_model::motion_table::Tabulated;
use trackdyn_model::{Icrs, Kinematics, MotionTable};

/// What relates track speeds and steady motion, both ways.
pub trait Steering {
    /// Track speeds as encoders show them, m/s, for a forward speed (m/s) and a yaw rate (rad/s),
    /// eqs (10)-(11); and the constants that give them.
    fn track_speeds(&self, forward: f64, yaw_rate: f64) -> (PerSide<f64>, Kinematics);

    /// Twist in ROS axes at the track speeds that encoders show, m/s, eqs (7)-(9).
    fn twist(&self, measured: PerSide<f64>) -> Twist;
}

impl Steering for Kinematics {
    fn track_speeds(&self, forward: f64, yaw_rate: f64) -> (PerSide<f64>, Kinematics) {
        (Kinematics::track_speeds(self, forward, yaw_rate), *self)
    }

    fn twist(&self, measured: PerSide<f64>) -> Twist {
        ros_twist_from_paper(&Kinematics::twist(self, measured))
    }
}

/// By sector where the map is piecewise.
impl Steering for KinematicsFile {
    fn track_speeds(&self, forward: f64, yaw_rate: f64) -> (PerSide<f64>, Kinematics) {
        KinematicsFile::track_speeds(self, forward, yaw_rate)
    }

    fn twist(&self, measured: PerSide<f64>) -> Twist {
        ros_twist_from_paper(&self.kinematics_at(measured).twist(measured))
    }
}

/// Newton steps towards the track speeds of a motion.
const MAX_STEPS: usize = 20;

/// Difference from a motion that counts as none, m/s and rad/s.
const MOTION_ROUNDING: f64 = 1e-9;

/// Speed of a slow spin, m/s.
const SPIN: f64 = 1e-6;

/// The forces on a vehicle: the constants of a motion are the ICRs that it has.
impl Steering for MotionTable {
    /// The speeds follow from Newton's method, from those by the ICRs of a slow spin. Where no
    /// speeds give the motion, as where a track holds the robot, they are the nearest that were
    /// found.
    fn track_speeds(&self, forward: f64, yaw_rate: f64) -> (PerSide<f64>, Kinematics) {
        let spin = PerSide::new(-SPIN, SPIN);
        // Where a track holds the robot even in a spin, any start does.
        let start = constants(self, spin, &self.at(spin).twist);
        let start = start.unwrap_or_else(|| Kinematics::ideal(1.0));
        let off = |at: &Tabulated| [forward - at.twist.v_x, yaw_rate - at.twist.w];
        let size = |off: [f64; 2]| off[0].hypot(off[1]);
        let mut speeds = start.track_speeds(forward, yaw_rate);
        let mut at = self.at(speeds);
        for _ in 0..MAX_STEPS {
            let [ahead, turn] = off(&at);
            let [[a, b], _, [c, d]] = at.by_speed;
            let step =
                [(d * ahead - b * turn), (a * turn - c * ahead)].map(|part| part / (a * d - b * c));
            if size([ahead, turn]) < MOTION_ROUNDING || !step.iter().all(|part| part.is_finite()) {
                break;
            }
            let moved = |share: f64| {
                PerSide::new(speeds.left + share * step[0], speeds.right + share * step[1])
            };
            let nearer = [1.0, 0.5, 0.25, 0.125].map(moved).into_iter().find_map(|speeds| {
                let at = self.at(speeds);
                (size(off(&at)) < size([ahead, turn])).then_some((speeds, at))
            });
            let Some(next) = nearer else { break };
            (speeds, at) = next;
        }
        let turning = Some(at.twist).filter(|twist| twist.w.abs() > MOTION_ROUNDING);
        let found = turning.and_then(|twist| constants(self, speeds, &twist));
        (speeds, found.unwrap_or(start))
    }

    fn twist(&self, measured: PerSide<f64>) -> Twist {
        self.at(measured).twist
    }
}

/// The constants that a motion (ROS axes) has at these encoder speeds; none without turning.
fn constants(table: &MotionTable, speeds: PerSide<f64>, twist: &Twist) -> Option<Kinematics> {
    let icrs = Icrs::of_motion(table.belts(speeds), &paper_twist_from_ros(twist))?;
    Some(Kinematics { icrs, alpha: table.gain })
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_model::{Effects, Model, VehicleFile};

    #[test]
    fn forces_are_steered_both_ways() {
        let effects: Effects = ["centripetal", "motion-resistance", "encoder-scale:left=1.03"]
            .into_iter()
            .map(|text| text.parse().expect("an effect"))
            .collect();
        let table = MotionTable::of(&Model::new(VehicleFile::auriga_alpha().vehicle, effects), 1.0);
        for k in 0..200_u32 {
            let (a, b) = (f64::from(k) * 0.618_034, f64::from(k) * 0.414_214);
            let (forward, yaw_rate) = (a.fract() - 0.5, 1.2 * b.fract() - 0.6);
            let (speeds, constants) = table.track_speeds(forward, yaw_rate);
            let twist = Steering::twist(&table, speeds);
            assert!((twist.v_x - forward).abs() < 1e-6, "{forward} {yaw_rate}: {twist:?}");
            assert!((twist.w - yaw_rate).abs() < 1e-6, "{forward} {yaw_rate}: {twist:?}");
            let of_constants = Steering::twist(&constants, speeds) - twist;
            let off = of_constants.v_x.hypot(of_constants.v_y).hypot(of_constants.w);
            assert!(off < 1e-6, "{forward} {yaw_rate}: {off:.1e}");
        }
    }
}
