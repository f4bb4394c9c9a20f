//! Yaw rates of an IMU in degrees per second.
//!
//! # Law
//! Turns of the poses and of the gyroscope go together by a factor of 1; in degrees, of 57.3.

use super::Run;
use super::motion::{Line, pieces};
use super::warning::Warning;
use crate::sample::ImuSample;

/// Degrees in a radian.
const DEGREES: f64 = 180.0 / std::f64::consts::PI;

/// Largest factor between the ratio of the turns and this.
const MAX_ERROR: f64 = 1.3;

/// Leaves out the readings of an IMU whose yaw rates are in degrees, and says so.
pub(super) fn leave_out(runs: &mut [Run]) -> Option<Warning> {
    let mut line = Line::default();
    for run in runs.iter().filter(|run| run.has_positions() && !run.imu().is_empty()) {
        for piece in pieces(run) {
            line.add(piece.turn, turned(run.imu(), piece.start, piece.end));
        }
    }
    let ratio = line.slope_where_correlated()?;
    if !(DEGREES / MAX_ERROR..=DEGREES * MAX_ERROR).contains(&ratio) {
        return None;
    }
    for run in runs {
        run.drop_imu();
    }
    Some(Warning::GyroInDegrees { ratio })
}

/// Turn that the yaw rates between two times add up to: a reading holds until the next.
fn turned(imu: &[ImuSample], start: f64, end: f64) -> f64 {
    let first = imu.partition_point(|reading| reading.t < start);
    let within = imu[first..].iter().take_while(|reading| reading.t < end);
    let until = imu[first..].iter().skip(1).map(|reading| reading.t.min(end));
    within.zip(until).map(|(reading, until)| reading.gyro_z * (until - reading.t)).sum()
}
