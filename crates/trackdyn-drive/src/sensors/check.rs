//! Values that no sensor has.

use super::stamps::MAX_JITTER;
use super::{Dropout, Encoder, Imu, Outlier, PoseSensor, Sensors};

/// A value that is not accepted.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Problem {
    /// Its key in a file, with the tables it stands in.
    pub(super) key: &'static str,
    pub(super) value: f64,
    pub(super) expected: &'static str,
}

impl Sensors {
    /// The first value that is not accepted.
    pub(super) fn check(&self) -> Result<(), Problem> {
        self.encoder.check()?;
        self.pose.check()?;
        self.imu.map_or(Ok(()), |imu| imu.check())
    }
}

/// Readings faster or slower than this are taken for a wrong unit.
fn interval(key: &'static str, value: f64) -> Result<(), Problem> {
    holds((1e-4..=100.0).contains(&value), key, value, "0.0001 to 100 s")
}

fn jitter(key: &'static str, value: f64, interval: f64) -> Result<(), Problem> {
    let expected = "0 to a quarter of interval_s, so that stamps keep their order";
    holds((0.0..=MAX_JITTER * interval).contains(&value), key, value, expected)
}

/// Standard deviations, strengths and delays.
fn not_negative<const N: usize>(values: [(&'static str, f64); N]) -> Result<(), Problem> {
    values.into_iter().try_for_each(|(key, value)| {
        holds((0.0..=1e6).contains(&value), key, value, "a number from 0 to 1e6")
    })
}

fn finite<const N: usize>(values: [(&'static str, f64); N]) -> Result<(), Problem> {
    values.into_iter().try_for_each(|(key, value)| {
        holds((-1e3..=1e3).contains(&value), key, value, "a number from -1000 to 1000")
    })
}

fn holds(it: bool, key: &'static str, value: f64, expected: &'static str) -> Result<(), Problem> {
    if it { Ok(()) } else { Err(Problem { key, value, expected }) }
}

impl Encoder {
    fn check(&self) -> Result<(), Problem> {
        interval("encoder.interval_s", self.interval)?;
        jitter("encoder.jitter_s", self.jitter, self.interval)?;
        not_negative([("encoder.tick_m", self.tick)])?;
        finite([("encoder.delay_s", self.delay)])?;
        for (key, alpha) in
            [("encoder.alpha_left", self.alpha_left), ("encoder.alpha_right", self.alpha_right)]
        {
            holds((0.01..=100.0).contains(&alpha), key, alpha, "a factor from 0.01 to 100")?;
        }
        Ok(())
    }
}

impl PoseSensor {
    fn check(&self) -> Result<(), Problem> {
        interval("pose.interval_s", self.interval)?;
        jitter("pose.jitter_s", self.jitter, self.interval)?;
        finite([
            ("pose.delay_s", self.delay),
            ("pose.mount.forward_m", self.mount.forward),
            ("pose.mount.left_m", self.mount.left),
            ("pose.mount.yaw_rad", self.mount.yaw),
        ])?;
        not_negative([
            ("pose.white.position_m", self.white.position),
            ("pose.white.yaw_rad", self.white.yaw),
            ("pose.walk.position_m_per_sqrt_s", self.walk.position),
            ("pose.walk.yaw_rad_per_sqrt_s", self.walk.yaw),
        ])?;
        if let Some(memory) = self.walk.memory {
            holds(
                memory > 0.0 && memory <= 1e6,
                "pose.walk.memory_s",
                memory,
                "a positive time, at most 1e6 s",
            )?;
        }
        self.outlier.check()?;
        self.dropout.check()
    }
}

impl Outlier {
    fn check(&self) -> Result<(), Problem> {
        let Self { share, position, yaw } = *self;
        holds((0.0..=1.0).contains(&share), "pose.outlier.share", share, "0 to 1")?;
        not_negative([("pose.outlier.position_m", position), ("pose.outlier.yaw_rad", yaw)])
    }
}

impl Dropout {
    fn check(&self) -> Result<(), Problem> {
        let Self { share, duration } = *self;
        holds((0.0..=0.9).contains(&share), "pose.dropout.share", share, "0 to 0.9")?;
        not_negative([("pose.dropout.duration_s", duration)])?;
        let expected = "a positive time, as pose.dropout.share is not 0";
        holds(share == 0.0 || duration > 0.0, "pose.dropout.duration_s", duration, expected)
    }
}

impl Imu {
    fn check(&self) -> Result<(), Problem> {
        interval("imu.interval_s", self.interval)?;
        jitter("imu.jitter_s", self.jitter, self.interval)?;
        finite([
            ("imu.delay_s", self.delay),
            ("imu.forward_m", self.forward),
            ("imu.left_m", self.left),
        ])?;
        not_negative([
            ("imu.gyro_rad_s", self.gyro),
            ("imu.gyro_bias_rad_s", self.gyro_bias),
            ("imu.acceleration_m_s2", self.acceleration),
            ("imu.acceleration_bias_m_s2", self.acceleration_bias),
        ])
    }
}
