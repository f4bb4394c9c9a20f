//! Sum of all forces on the body at a motion, and its derivatives.

use crate::newton::gradients;
use crate::transient::gripping;
use crate::{Ground, Model, Motion};
use nalgebra::{Matrix3, Vector3};
use trackdyn_core::{Dual, PerSide, Scalar, Twist, Wrench};

/// The forces on the body of a model at one place, heading and time. Rows are force across and
/// along (N) and moment (N·m), columns v_x, v_y (m/s) and w (rad/s) or their rates, paper's frame.
#[derive(Clone, Copy, Debug)]
pub struct Forces<'a> {
    /// The robot's model.
    pub model: &'a Model,
    /// The ground under it.
    pub ground: &'a Ground,
    /// Slip velocity below which a track sticks, m/s.
    pub creep: f64,
}

impl Forces<'_> {
    /// Sum at belt speeds (m/s), a twist and its rate: zero for a motion of the model.
    pub fn sum(&self, belts: PerSide<f64>, twist: &Twist, rate: &Twist) -> Vector3<f64> {
        let Twist { v_x, v_y, w } = *twist;
        Vector3::from(self.at(belts, [v_x, v_y, w], *rate))
    }

    /// Derivatives of the sum by the twist.
    pub fn by_twist(&self, belts: PerSide<f64>, twist: &Twist, rate: &Twist) -> Matrix3<f64> {
        let Twist { v_x, v_y, w } = *rate;
        let rate = Twist { v_x: v_x.into(), v_y: v_y.into(), w: w.into() };
        gradients(&self.at(belts, Dual::variables([twist.v_x, twist.v_y, twist.w]), rate))
    }

    /// Derivatives of the sum by the rate of the twist.
    pub fn by_rate(&self, belts: PerSide<f64>, twist: &Twist, rate: &Twist) -> Matrix3<f64> {
        let [v_x, v_y, w] = Dual::variables([rate.v_x, rate.v_y, rate.w]);
        let twist = [twist.v_x, twist.v_y, twist.w].map(Dual::from);
        gradients(&self.at(belts, twist, Twist { v_x, v_y, w }))
    }

    fn at<S: Scalar>(&self, belts: PerSide<f64>, [v_x, v_y, w]: [S; 3], rate: Twist<S>) -> [S; 3] {
        let departure = Twist { v_x, v_y: v_y - belts.left, w };
        let motion = Motion::departing(belts.map(S::from), departure, rate, self.model.extent());
        let Wrench { force_x, force_y, moment } =
            gripping(self.model, self.ground, &motion, self.creep).sum();
        [force_x, force_y, moment]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transient::{GAMMA, Instant, STICKING_SLIP_VELOCITY};
    use crate::{ActiveEffect, Circumstance, Effects, VehicleFile};
    use crate::{Stationary, Transient};
    use trackdyn_core::frames::ros_twist_from_paper;
    use trackdyn_core::{Plant, Pose, Trajectory};

    #[test]
    fn they_balance_in_stationary_motion_and_their_derivatives_are_quotients_of_differences() {
        const STEP: f64 = 1e-6;
        let texts = ["yaw-inertia:strength=1,gyration_m=0.3", "viscous-friction"];
        let effects: Effects =
            texts.iter().map(|text| text.parse::<ActiveEffect>().expect("an effect")).collect();
        let model = Model::new(VehicleFile::auriga_alpha().vehicle, effects);
        let ground = model.ground(&Circumstance::default());
        let forces = Forces { model: &model, ground: &ground, creep: 1e-6 };
        let belts = PerSide::new(-0.2, 0.7);
        let twist = Stationary::new(&model, &Circumstance::default()).solve(belts).twist;
        let still = Twist::zero();
        let weight = model.vehicle().weight();
        assert!(forces.sum(belts, &twist, &still).norm() < 1e-9 * weight);

        let moved = |twist: &Twist, column: usize, step: f64| {
            let mut values = [twist.v_x, twist.v_y, twist.w];
            values[column] += step;
            Twist { v_x: values[0], v_y: values[1], w: values[2] }
        };
        let by_twist = forces.by_twist(belts, &twist, &still);
        let by_rate = forces.by_rate(belts, &twist, &still);
        for column in 0..3 {
            let [ahead, behind] =
                [STEP, -STEP].map(|step| forces.sum(belts, &moved(&twist, column, step), &still));
            let quotient = (ahead - behind) / (2.0 * STEP);
            assert!((by_twist.column(column) - quotient).norm() < 1e-5 * quotient.norm());
            let [ahead, behind] =
                [STEP, -STEP].map(|step| forces.sum(belts, &twist, &moved(&still, column, step)));
            let quotient = (ahead - behind) / (2.0 * STEP);
            assert!((by_rate.column(column) - quotient).norm() < 1e-5 * quotient.norm());
        }
    }

    /// The forces balance in all stages of a transient motion; the last stage of each step is its
    /// end, and the weighted stages move the body.
    #[test]
    fn they_balance_in_every_stage_of_a_motion_in_time() {
        let texts = ["yaw-inertia:strength=1,gyration_m=0.3", "centripetal"];
        let effects: Effects =
            texts.iter().map(|text| text.parse::<ActiveEffect>().expect("an effect")).collect();
        let model = Model::new(VehicleFile::auriga_alpha().vehicle, effects);
        let ground = model.ground(&Circumstance::default());
        let forces = Forces { model: &model, ground: &ground, creep: STICKING_SLIP_VELOCITY };
        let mut path = Trajectory::default();
        let mut robot =
            Transient::at_rest(&model, 0.0, Pose::default()).with_step(0.03).with_steps();
        path.push(robot.moment());
        for (until, speeds) in [(0.3, PerSide::new(0.2, 0.8)), (0.6, PerSide::new(0.5, -0.5))] {
            robot.drive(speeds, until, &mut path).expect("it moves");
        }
        let steps = robot.into_steps();
        assert_eq!(steps.len() + 1, path.moments().len());
        for (step, pair) in steps.iter().zip(path.moments().windows(2)) {
            for Instant { belt_speed, twist, rate, .. } in step.stages {
                let sum = forces.sum(belt_speed, &twist, &rate);
                assert!(sum.norm() < 1e-6 * model.vehicle().weight(), "{sum}");
            }
            let [first, second] = step.stages.map(|instant| ros_twist_from_paper(&instant.twist));
            assert_eq!(second, pair[1].twist);
            let mean = |a: f64, b: f64| (1.0 - GAMMA) * a + GAMMA * b;
            let turned = pair[0].pose.relative(&pair[1].pose).yaw;
            assert!((turned - mean(first.w, second.w) * step.duration).abs() < 1e-9);
        }
    }
}
