//! What a user knows of tables of track speeds and poses, and the tables do not state.

use crate::Error;
use crate::doubt::DoubtKind;
use crate::recording::{PoseAxes, UncheckedRun};
use crate::unit::{PoseUnit, SpeedUnit};
use std::path::Path;

/// How tables of track speeds and poses are read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TableOptions {
    /// Unit of the track speeds; none: m/s.
    pub speed_unit: Option<SpeedUnit>,
    /// Belt travel per radian, m, where these are speeds of wheels.
    pub wheel_radius: Option<f64>,
    /// Unit of the positions of poses.
    pub pose_unit: PoseUnit,
    /// Axes in which the poses are told.
    pub pose_axes: PoseAxes,
    /// Yaw of the x axis of the pose sensor on the robot, rad: π where it faces backwards.
    pub mount_yaw: Option<f64>,
    /// Whether the yaw rates of the IMU are in degrees per second.
    pub gyro_in_degrees: bool,
    /// Doubts that do not stop the reader, because the user knows better.
    pub accepted: Vec<DoubtKind>,
}

impl TableOptions {
    /// Takes the rows of a table from these units.
    ///
    /// # Errors
    /// [`Error::Options`] for a unit of wheels without their radius, and the reverse.
    pub(crate) fn convert(&self, path: &Path, runs: &mut [UncheckedRun]) -> Result<(), Error> {
        let scale = scale_of_table(path, self.speed_unit, self.wheel_radius)?;
        for reading in runs.iter_mut().flat_map(|run| &mut run.tracks.samples) {
            reading.v_left *= scale;
            reading.v_right *= scale;
        }
        for sample in runs.iter_mut().flat_map(|run| &mut run.poses.samples) {
            sample.pose.x *= self.pose_unit.factor();
            sample.pose.y *= self.pose_unit.factor();
        }
        for reading in runs.iter_mut().flat_map(|run| &mut run.imu.samples) {
            if self.gyro_in_degrees {
                reading.gyro_z = reading.gyro_z.to_radians();
            }
        }
        Ok(())
    }
}

/// m/s per number in a table of track speeds: of the unit given, or m/s.
///
/// # Errors
/// [`Error::Options`] for a unit of wheels without their radius, and for a radius without one.
pub(crate) fn scale_of_table(
    path: &Path,
    unit: Option<SpeedUnit>,
    wheel_radius: Option<f64>,
) -> Result<f64, Error> {
    let refuse = |problem: String| Err(Error::Options { path: path.to_owned(), problem });
    match (unit.unwrap_or(SpeedUnit::MetresPerSecond), wheel_radius) {
        (unit, Some(radius)) if unit.is_of_wheels() => Ok(radius * unit.factor()),
        (unit, None) if unit.is_of_wheels() => refuse(format!(
            "--speed-unit {unit} is of wheels: expected --wheel-radius METRES beside it"
        )),
        (unit, Some(_)) => refuse(format!(
            "--wheel-radius: speeds in {unit} are those of the tracks already: expected no radius, \
             or --speed-unit rad/s, rpm, turns/s or deg/s"
        )),
        (unit, None) => Ok(unit.factor()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn a_table_of_wheels_needs_their_radius() {
        let scale = |unit, radius| scale_of_table(Path::new("t"), unit, radius);
        let rpm = Some(SpeedUnit::TurnsPerMinute);
        let of_rpm = scale(rpm, Some(0.3)).expect("a scale");
        assert!((of_rpm - 0.3 * TAU / 60.0).abs() < 1e-15);
        assert_eq!(scale(None, None).expect("a scale"), 1.0);
        let text = scale(rpm, None).expect_err("no radius").to_string();
        assert!(text.contains("--wheel-radius METRES"), "{text}");
        let text = scale(None, Some(0.3)).expect_err("m/s").to_string();
        assert!(text.contains("--speed-unit rad/s"), "{text}");
    }
}
