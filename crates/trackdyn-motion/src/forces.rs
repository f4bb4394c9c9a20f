//! The sum of all forces on the body at a motion, and how it changes with the motion.

use crate::transient::gripping;
use nalgebra::{Matrix3, Vector3};
use trackdyn_core::{Dual, PerSide, Scalar, Twist, Wrench};
use trackdyn_physics::{Ground, Model, Motion};

/// The forces on the body of a model at one place, heading and time. Rows are force across and along (N) and moment
/// (N·m), columns v_x, v_y (m/s) and w (rad/s) or their rates, paper's frame.
#[derive(Clone, Copy, Debug)]
pub struct Forces<'a> {
    /// The robot.
    pub model: &'a Model,
    /// The ground under it.
    pub ground: &'a Ground,
    /// Slip velocity below which a track sticks, m/s.
    pub creep: f64,
}

impl Forces<'_> {
    /// Their sum at belt speeds (m/s), a twist and its rate: zero where the motion is one of the model.
    pub fn sum(&self, belts: PerSide<f64>, twist: &Twist, rate: &Twist) -> Vector3<f64> {
        let Twist { v_x, v_y, w } = *twist;
        Vector3::from(self.at(belts, [v_x, v_y, w], *rate))
    }

    /// Their sum, and its derivatives by the twist and by its rate.
    pub fn near(
        &self,
        belts: PerSide<f64>,
        twist: &Twist,
        rate: &Twist,
    ) -> (Vector3<f64>, [Matrix3<f64>; 2]) {
        let [v_x, v_y, w, a_x, a_y, a_w] =
            Dual::<6>::variables([twist.v_x, twist.v_y, twist.w, rate.v_x, rate.v_y, rate.w]);
        let sum = self.at(belts, [v_x, v_y, w], Twist { v_x: a_x, v_y: a_y, w: a_w });
        let by = |first: usize| Matrix3::from_fn(|row, column| sum[row].gradient[first + column]);
        (Vector3::from(sum.map(|row| row.value)), [by(0), by(3)])
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
    use crate::Stationary;
    use trackdyn_physics::{ActiveEffect, Circumstance, Effects, VehicleFile};

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
        let still = Twist { v_x: 0.0, v_y: 0.0, w: 0.0 };
        let weight = model.vehicle().weight();
        assert!(forces.sum(belts, &twist, &still).norm() < 1e-9 * weight);

        let moved = |twist: &Twist, column: usize, step: f64| {
            let mut values = [twist.v_x, twist.v_y, twist.w];
            values[column] += step;
            Twist { v_x: values[0], v_y: values[1], w: values[2] }
        };
        let (sum, [by_twist, by_rate]) = forces.near(belts, &twist, &still);
        assert!((sum - forces.sum(belts, &twist, &still)).norm() < 1e-12 * weight);
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
}
