//! An inertial sensor in the axes of the body.

use super::stamps::{Stamper, moments};
use crate::random::{Purpose, normal, stream};
use serde::{Deserialize, Serialize};
use trackdyn_core::Trajectory;
use trackdyn_recording::ImuSample;

/// An IMU on level ground.
///
/// # Law
/// A reading is the mean over its interval, as the filters before the sampling make it: the yaw
/// rate (ψ_k − ψ_{k−1})/T, and the change of the sensor's velocity over the ground, v_p = v + ω ×
/// r, per T in the body's axes at the middle. That contains r ω' , ω × (ω × r) and ω × v. A bias
/// drawn for the run and white noise are added.
///
/// # Assumes
/// Level ground: gravity has no part in the plane. Twists between moments are linear in time, so
/// that a motion with steps of speed must have moments on both sides of them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Imu {
    /// T, s.
    #[serde(rename = "interval_s")]
    pub interval: f64,
    /// Time by which stamps are late after the end of the interval, s.
    #[serde(rename = "delay_s")]
    pub delay: f64,
    /// Standard deviation of stamps, uniform, s.
    #[serde(rename = "jitter_s")]
    pub jitter: f64,
    /// Place before the centre of the contact area, m.
    #[serde(rename = "forward_m")]
    pub forward: f64,
    /// Place left of it, m.
    #[serde(rename = "left_m")]
    pub left: f64,
    /// White noise of the yaw rate: standard deviation of a reading, rad/s.
    #[serde(rename = "gyro_rad_s")]
    pub gyro: f64,
    /// Bias of the yaw rate: standard deviation over runs, rad/s.
    #[serde(rename = "gyro_bias_rad_s")]
    pub gyro_bias: f64,
    /// White noise of accelerations: standard deviation of a reading, m/s².
    #[serde(rename = "acceleration_m_s2")]
    pub acceleration: f64,
    /// Bias of accelerations: standard deviation over runs, m/s².
    #[serde(rename = "acceleration_bias_m_s2")]
    pub acceleration_bias: f64,
}

impl Default for Imu {
    fn default() -> Self {
        Self {
            interval: 0.01,
            delay: 0.0,
            jitter: 2e-4,
            forward: 0.0,
            left: 0.0,
            gyro: 2e-3,
            gyro_bias: 1e-3,
            acceleration: 0.05,
            acceleration_bias: 0.02,
        }
    }
}

impl Imu {
    pub(super) fn observe(
        &self,
        run: i64,
        trajectory: &Trajectory,
        span: [f64; 2],
        seed: u64,
    ) -> Vec<ImuSample> {
        let mut biases = stream(seed, run, Purpose::ImuBias);
        let deviations = [self.gyro_bias, self.acceleration_bias, self.acceleration_bias];
        let bias = deviations.map(|deviation| deviation * normal(&mut biases));
        let mut white = stream(seed, run, Purpose::ImuWhite);
        let (jitter, delay) = (self.jitter, self.delay);
        let mut stamper = Stamper::new(seed, run, Purpose::ImuStamp, delay, jitter);
        let mut before: Option<(f64, [f64; 2])> = None;
        let mut readings = Vec::new();
        for t in moments(span, self.interval) {
            let yaw = trajectory.pose_at(t).yaw;
            let velocity = self.ground_velocity(trajectory, t, yaw);
            if let Some((yaw_before, velocity_before)) = before.replace((yaw, velocity)) {
                let change = std::array::from_fn(|k| velocity[k] - velocity_before[k]);
                let body = turned(change, -f64::midpoint(yaw, yaw_before));
                let truth = [yaw - yaw_before, body[0], body[1]].map(|value| value / self.interval);
                let deviations = [self.gyro, self.acceleration, self.acceleration];
                let [gyro_z, acc_x, acc_y] = std::array::from_fn(|k| {
                    truth[k] + bias[k] + deviations[k] * normal(&mut white)
                });
                readings.push(ImuSample { t: stamper.stamp(t), gyro_z, acc_x, acc_y });
            }
        }
        readings
    }

    /// Velocity of the sensor in the world's axes, m/s.
    fn ground_velocity(&self, trajectory: &Trajectory, t: f64, yaw: f64) -> [f64; 2] {
        turned(trajectory.twist_at(t).velocity_at([self.forward, self.left]), yaw)
    }
}

/// The vector turned counter-clockwise.
fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}
