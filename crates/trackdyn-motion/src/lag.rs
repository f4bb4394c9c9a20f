//! How far a motion stays behind the stationary one.
//!
//! # Law
//! Near a stationary motion u_s the balance of forces (14)-(15) is linear in what the twist departs by, δ, and in
//! the acceleration: F_u δ + F_a (u̇_s + δ̇) = 0, so Λ (u̇_s + δ̇) + δ = 0 with Λ = F_u⁻¹ F_a, a matrix of time
//! constants. Friction with its full value at any slip has a short Λ, m |s|/(µ N); friction that grows with the slip
//! speed has a long one.

use crate::transient::{CREEP, net_force};
use nalgebra::Matrix3;
use trackdyn_core::{Dual, PerSide, Twist};
use trackdyn_physics::{Ground, Model, Motion};

/// The matrix Λ (s; by v_x, v_y in m/s and w in rad/s, paper's frame) at a stationary motion; none where no force
/// stands against a change of the twist. A robot that a sticking track holds does not depart: Λ = 0.
///
/// Belts that slip on their sprockets are taken at these speeds, m/s.
pub fn lag(
    model: &Model,
    ground: &Ground,
    belt_speed: PerSide<f64>,
    twist: &Twist,
) -> Option<Matrix3<f64>> {
    if is_held(model, belt_speed, twist) {
        return Some(Matrix3::zeros());
    }
    let [v_x, v_y, w, a_x, a_y, a_w] =
        Dual::<6>::variables([twist.v_x, twist.v_y - belt_speed.left, twist.w, 0.0, 0.0, 0.0]);
    let departure = Twist { v_x, v_y, w };
    let acceleration = Twist { v_x: a_x, v_y: a_y, w: a_w };
    let belts = belt_speed.map(Dual::from);
    let motion = Motion::departing(belts, departure, acceleration, model.extent());
    let sum = net_force(model, ground, &motion, CREEP);
    let rows = [sum.force_x, sum.force_y, sum.moment];
    let by_twist = Matrix3::from_fn(|row, column| rows[row].gradient[column]);
    let by_acceleration = Matrix3::from_fn(|row, column| rows[row].gradient[column + 3]);
    by_twist.try_inverse().map(|inverse| inverse * by_acceleration)
}

/// Whether a track that sticks, or both, keep the robot straight.
fn is_held(model: &Model, belt_speed: PerSide<f64>, twist: &Twist) -> bool {
    /// Slip over the difference of the belt speeds that is none but for rounding.
    const ROUNDING: f64 = 1e-9;
    let turn = model.vehicle().gauge * twist.w.abs();
    belt_speed.left != belt_speed.right
        && turn + twist.v_x.abs() <= ROUNDING * (belt_speed.right - belt_speed.left).abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Stationary, Transient};
    use trackdyn_core::{Plant, Pose, Trajectory};
    use trackdyn_physics::{ActiveEffect, Circumstance, Effects, VehicleFile};

    /// A slow, steady acceleration: the motion in time must lag by Λ u̇, but for what is of second order in it.
    #[test]
    fn it_is_that_of_the_motion_in_time() {
        const CHANGE: f64 = 0.02;
        const STEP: f64 = 0.001;
        const STEPS: u32 = 600;
        for law in ["", "friction-creep:speed_m_per_s=0.1", "viscous-friction:growth_s_per_m=1"] {
            let mut texts = vec!["yaw-inertia:strength=1,gyration_m=0.3"];
            texts.extend((!law.is_empty()).then_some(law));
            let effects: Effects =
                texts.iter().map(|text| text.parse::<ActiveEffect>().expect("an effect")).collect();
            let model = Model::new(VehicleFile::auriga_alpha().vehicle, effects);
            let solver = Stationary::new(&model, &Circumstance::default());
            let speeds = |t: f64| PerSide::new(0.2 + CHANGE * t, 0.5 + 3.0 * CHANGE * t);
            let steady = |t: f64| solver.solve(speeds(t)).twist;
            let start = steady(0.0);
            let mut robot = Transient::at_rest(&model, 0.0, Pose::default()).with_twist(start);
            let mut path = Trajectory::default();
            for k in 0..STEPS {
                let t = f64::from(k) * STEP;
                robot.drive(speeds(t + STEP), t + STEP, &mut path).expect("it moves");
            }
            let (t, reached) =
                (f64::from(STEPS) * STEP, path.moments().last().expect("moments").twist);
            let reached = trackdyn_core::frames::paper_twist_from_ros(&reached);
            let (now, later) = (steady(t), steady(t + STEP));
            let rate = |f: fn(&Twist) -> f64| (f(&later) - f(&now)) / STEP;
            let rates = nalgebra::Vector3::new(rate(|u| u.v_x), rate(|u| u.v_y), rate(|u| u.w));
            let ground = model.ground(&Circumstance::default());
            let lag = lag(&model, &ground, speeds(t), &now).expect("friction");
            let expected = -(lag * rates);
            let found = nalgebra::Vector3::new(
                reached.v_x - now.v_x,
                reached.v_y - now.v_y,
                reached.w - now.w,
            );
            // Readings that hold for a step are half a step ahead of the ramp.
            let error = (found - expected).norm() / expected.norm();
            assert!(error < 0.05, "{law}: {found:?} for {expected:?}");
        }
    }

    /// Where friction at rest is much larger than that of a track that slips, one track holds the robot: a small turn of it
    /// has died away long before a lag of some milliseconds would matter.
    #[test]
    fn a_robot_that_is_held_does_not_depart() {
        let law = "stribeck-friction:excess=1.9,speed_m_per_s=0.2";
        let effects: Effects = ["yaw-inertia:strength=1,gyration_m=0.3", law]
            .iter()
            .map(|text| text.parse::<ActiveEffect>().expect("an effect"))
            .collect();
        let model = Model::new(VehicleFile::auriga_alpha().vehicle, effects);
        let solver = Stationary::new(&model, &Circumstance::default());
        let ground = model.ground(&Circumstance::default());
        let lag_at = |speeds: PerSide<f64>| {
            let twist = solver.solve(speeds).twist;
            (twist, lag(&model, &ground, speeds, &twist).expect("friction"))
        };
        let (turns, lags) = lag_at(PerSide::new(0.3, 0.6));
        assert!(turns.w > 0.1 && lags.norm() > 1e-3);

        let speeds = PerSide::new(0.0, 0.6);
        let (held, none) = lag_at(speeds);
        assert!(held.w == 0.0 && none == Matrix3::zeros(), "{held:?}: {none}");
        let departed = Twist { w: 1e-4, ..held };
        let mut robot = Transient::at_rest(&model, 0.0, Pose::default()).with_twist(departed);
        let mut path = Trajectory::default();
        for step in 1..=20_u32 {
            robot.drive(speeds, 1e-3 * f64::from(step), &mut path).expect("it moves");
        }
        let end = path.moments().last().expect("moments").twist;
        assert!(end.w.abs() < 1e-5, "{end:?}");
    }

    /// Belts that slip take up the difference of the sprockets: both tracks stick, though neither belt runs as its sprocket.
    #[test]
    fn a_robot_whose_belts_take_up_the_difference_does_not_lag() {
        let texts = ["yaw-inertia", "viscous-friction", "belt-slip:slip=0.1"];
        let effects: Effects =
            texts.iter().map(|text| text.parse::<ActiveEffect>().expect("an effect")).collect();
        let model = Model::new(VehicleFile::auriga_alpha().vehicle, effects);
        let solution =
            Stationary::new(&model, &Circumstance::default()).solve(PerSide::new(0.5, 0.505));
        assert_eq!(solution.status, crate::Status::Straight);
        let ground = model.ground(&Circumstance::default());
        let lag = lag(&model, &ground, solution.track_speed, &solution.twist);
        assert_eq!(lag, Some(Matrix3::zeros()));
    }
}
