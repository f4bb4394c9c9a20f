//! Poses with covariance, and what composing does to it.

use nalgebra::{Matrix3, Vector3};
use trackdyn_core::Pose;
use trackdyn_core::pose::wrap_angle;

/// A pose `a_from_b` with the covariance of its error.
///
/// The error is (δx, δy, δyaw) with δx, δy along the axes of frame a, in m² and rad²; errors of
/// different estimates are taken as independent.
///
/// # Sources
/// Smith, Self and Cheeseman, Estimating uncertain spatial relationships in robotics, 1990.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseEstimate {
    /// The pose, m and rad.
    pub pose: Pose,
    /// Covariance of (x, y, yaw), in m², m rad and rad².
    pub covariance: Matrix3<f64>,
}

impl PoseEstimate {
    /// A pose without error.
    pub fn exact(pose: Pose) -> Self {
        Self { pose, covariance: Matrix3::zeros() }
    }

    /// `a_from_c = a_from_b · b_from_c`.
    pub fn compose(&self, b_from_c: &Self) -> Self {
        let pose = self.pose.compose(&b_from_c.pose);
        let (sin, cos) = self.pose.yaw.sin_cos();
        // δ(a_from_c) = [1 0 −Δy; 0 1 Δx; 0 0 1] δ(a_from_b) + R δ(b_from_c), Δ = place of c from b
        // in a
        let (dx, dy) = (pose.x - self.pose.x, pose.y - self.pose.y);
        let lever = Matrix3::new(1.0, 0.0, -dy, 0.0, 1.0, dx, 0.0, 0.0, 1.0);
        let turn = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
        let covariance = lever * self.covariance * lever.transpose()
            + turn * b_from_c.covariance * turn.transpose();
        Self { pose, covariance }
    }

    /// `robot_from_robot'` of the motion `sensor_from_sensor'` (self) of a sensor that sits at
    /// `robot_from_sensor`.
    pub fn of_carrier(&self, robot_from_sensor: &Pose) -> Self {
        let mount = Self::exact(*robot_from_sensor);
        mount.compose(self).compose(&Self::exact(robot_from_sensor.inverse()))
    }

    /// Normalised estimation error squared, δᵀ P⁻¹ δ with δ = truth − estimate: χ² distributed with
    /// three degrees of freedom where the covariance P is honest. `None` where P is singular.
    pub fn normalised_error_squared(&self, truth: &Pose) -> Option<f64> {
        let error = Vector3::new(
            truth.x - self.pose.x,
            truth.y - self.pose.y,
            wrap_angle(truth.yaw - self.pose.yaw),
        );
        Some(error.dot(&self.covariance.cholesky()?.solve(&error)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Derivatives of `f` by each coordinate of a pose, by central differences.
    fn differences(f: impl Fn(&Pose) -> Pose, at: &Pose) -> Matrix3<f64> {
        let step = 1e-6;
        let column = |k: usize| {
            let moved = |by: f64| {
                let mut v = [at.x, at.y, at.yaw];
                v[k] += by;
                f(&Pose::new(v[0], v[1], v[2]))
            };
            let (up, down) = (moved(step), moved(-step));
            Vector3::new(up.x - down.x, up.y - down.y, up.yaw - down.yaw) / (2.0 * step)
        };
        Matrix3::from_columns(&[column(0), column(1), column(2)])
    }

    #[test]
    fn covariance_composes_by_the_derivatives_of_the_poses() {
        let covariance = |a: f64, b: f64, c: f64| {
            let root = Matrix3::new(a, 0.1, 0.0, 0.0, b, 0.2, 0.3, 0.0, c);
            root * root.transpose()
        };
        let a =
            PoseEstimate { pose: Pose::new(1.0, -2.0, 0.7), covariance: covariance(1.0, 2.0, 0.5) };
        let b =
            PoseEstimate { pose: Pose::new(0.4, 0.3, -1.9), covariance: covariance(0.2, 0.7, 1.5) };
        let by_a = differences(|pose| pose.compose(&b.pose), &a.pose);
        let by_b = differences(|pose| a.pose.compose(pose), &b.pose);
        let expected =
            by_a * a.covariance * by_a.transpose() + by_b * b.covariance * by_b.transpose();
        // Central differences over 1e-6 are good to 1e-9.
        assert!((a.compose(&b).covariance - expected).norm() < 1e-7);
        let mount = Pose::new(0.4, -0.2, 1.1);
        let carried = |motion: &Pose| mount.compose(motion).compose(&mount.inverse());
        let by_motion = differences(carried, &a.pose);
        let expected = by_motion * a.covariance * by_motion.transpose();
        assert!((a.of_carrier(&mount).covariance - expected).norm() < 1e-7);
    }

    #[test]
    fn one_standard_deviation_is_one() {
        let covariance = Matrix3::from_diagonal(&Vector3::new(4.0, 9.0, 0.01));
        let estimate = PoseEstimate { pose: Pose::new(0.0, 0.0, 3.1), covariance };
        // 0.1 rad further, across the wrap.
        let truth = Pose::new(2.0, 0.0, 3.2 - std::f64::consts::TAU);
        let error = estimate.normalised_error_squared(&truth).expect("regular");
        assert!((error - 2.0).abs() < 1e-12);
    }
}
