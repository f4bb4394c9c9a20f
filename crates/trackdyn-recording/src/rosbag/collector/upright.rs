//! Which way is up for an IMU: gravity tells.
//!
//! # Law
//! At rest and on the mean of a drive, the specific force f̄ points up with 9.81 m/s² (REP-145).
//! The yaw rate is the part of the angular velocity along it, ω · f̄/|f̄|, however the IMU is
//! mounted.
//!
//! # Assumes
//! Beyond [`MAX_TILT`] the tilt is that of the mount, below it that of the ground and of the
//! sensor. An IMU whose z axis points down and one that reports gravity in place of specific force
//! read alike: beyond [`MIN_OVERTURNED_TILT`] nothing is turned.

use super::{Received, Rows};
use crate::recording::Warning;
use nalgebra::{Rotation3, Vector3};
use trackdyn_core::real;

/// Angular velocity, rad/s, and specific force, m/s², along the axes of the IMU.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Inertial {
    pub(super) rate: [f64; 3],
    pub(super) force: [f64; 3],
}

/// Gravity, m/s².
const GRAVITY: f64 = 9.81;

/// Largest part by which a mean force may differ from gravity and still be it.
const MAX_DIFFERENCE: f64 = 0.15;

/// Tilt from which on the mount is not upright, rad: 15 degrees.
const MAX_TILT: f64 = 0.26;

/// Tilt from which on up and down cannot be told apart, rad: 150 degrees.
const MIN_OVERTURNED_TILT: f64 = 2.62;

/// Yaw rates and horizontal forces of an IMU, of its readings as they came.
pub(super) fn upright(
    topic: &str,
    readings: Vec<Received<Inertial>>,
    warnings: &mut Vec<Warning>,
) -> Rows {
    let turn = turn(&readings);
    if let Some(turn) = &turn {
        let up = turn.inverse() * Vector3::z();
        warnings.push(Warning::TurnedUpright { topic: topic.to_owned(), up: up.into() });
    }
    let turn = turn.unwrap_or_else(Rotation3::identity);
    let row = |reading: Received<Inertial>| {
        let Inertial { rate, force } = reading.value;
        let [rate, force] = [rate, force].map(|axes| turn * Vector3::from(axes));
        let Received { stamp_ns, log_ns, .. } = reading;
        Received { stamp_ns, log_ns, value: [rate.z, force.x, force.y] }
    };
    readings.into_iter().map(row).collect()
}

/// The turn that brings the mean force of an IMU that is not mounted upright to its z axis.
fn turn(readings: &[Received<Inertial>]) -> Option<Rotation3<f64>> {
    let forces = readings.iter().map(|reading| Vector3::from(reading.value.force));
    let finite = forces.filter(|force| force.iter().all(|part| part.is_finite()));
    let (sum, count) = finite
        .fold((Vector3::zeros(), 0), |(sum, count): (Vector3<f64>, usize), force| {
            (sum + force, count + 1)
        });
    let mean = sum / real(count.max(1));
    let is_gravity = (mean.norm() / GRAVITY - 1.0).abs() < MAX_DIFFERENCE;
    let tilt = mean.angle(&Vector3::z());
    if !is_gravity || !(MAX_TILT..=MIN_OVERTURNED_TILT).contains(&tilt) {
        return None;
    }
    Rotation3::rotation_between(&mean, &Vector3::z())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Readings of a robot that turns by ω about the vertical and drives forward by fits and
    /// starts, of an IMU in this turn from upright.
    fn readings(mount: &Rotation3<f64>) -> Vec<Received<Inertial>> {
        let reading = |k: i64| {
            let time = 0.01 * real(usize::try_from(k).expect("small"));
            let inverse = mount.inverse();
            let rate = inverse * Vector3::new(0.0, 0.0, (0.7 * time).sin());
            let force = inverse * Vector3::new(0.5 * (3.0 * time).sin(), 0.0, GRAVITY);
            let value = Inertial { rate: rate.into(), force: force.into() };
            Received { stamp_ns: Some(10_000_000 * k), log_ns: 0, value }
        };
        (0..2000).map(reading).collect()
    }

    #[test]
    fn yaw_rates_are_about_the_vertical_however_an_imu_is_mounted() {
        let quarter = std::f64::consts::FRAC_PI_2;
        for (mount, is_turned) in [
            (Rotation3::identity(), false),
            (Rotation3::from_euler_angles(0.05, 0.08, 0.0), false),
            (Rotation3::from_euler_angles(quarter, 0.0, 0.0), true),
            (Rotation3::from_euler_angles(-quarter, 0.0, 1.0), true),
            (Rotation3::from_euler_angles(0.0, quarter, 0.0), true),
            (Rotation3::from_euler_angles(0.5, 0.3, 0.0), true),
        ] {
            let mut warnings = Vec::new();
            let rows = upright("/imu", readings(&mount), &mut warnings);
            assert_eq!(warnings.len(), usize::from(is_turned), "{mount}");
            for (k, row) in rows.iter().enumerate() {
                let expected = (0.007 * real(k)).sin();
                let allowed = if is_turned { 1e-3 } else { 5e-3 };
                assert!((row.value[0] - expected).abs() < allowed, "{mount} {k}: {:?}", row.value);
            }
        }
    }

    /// Upside down, or gravity in place of specific force: nobody can tell.
    #[test]
    fn what_reads_gravity_downward_or_not_at_all_stays() {
        let upside_down = Rotation3::from_euler_angles(std::f64::consts::PI, 0.0, 0.0);
        let mut without = readings(&Rotation3::identity());
        for reading in &mut without {
            reading.value.force = [0.0; 3];
        }
        for readings in [readings(&upside_down), without] {
            let rates: Vec<f64> = readings.iter().map(|of| of.value.rate[2]).collect();
            let mut warnings = Vec::new();
            let rows = upright("/imu", readings, &mut warnings);
            assert!(warnings.is_empty());
            assert!(rows.iter().map(|row| row.value[0]).eq(rates));
        }
    }
}
