//! Tables of steady motion: a measured map of instantaneous centres of rotation.

use crate::folder::MANIFEST;
use crate::table::Table;
use crate::table_options::scale_of_table;
use crate::{Error, TableOptions};
use std::path::{Path, PathBuf};
use trackdyn_core::input::name_of;
use trackdyn_core::robust::median;

const COLUMNS: [&str; 5] = ["v_left", "v_right", "v_forward", "v_lateral", "yaw_rate"];

/// Steady motion at constant track speeds; what was not measured is `None`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OperatingPoint {
    /// Speed of the left track, m/s.
    pub v_left: f64,
    /// Speed of the right track, m/s.
    pub v_right: f64,
    /// Velocity of the origin forward, m/s.
    pub v_forward: Option<f64>,
    /// Velocity of the origin to the left, m/s.
    pub v_lateral: Option<f64>,
    /// Yaw rate, counter-clockwise positive, rad/s.
    pub yaw_rate: Option<f64>,
}

/// A table of steady motions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OperatingPoints {
    /// Name for titles and outputs: that of the file.
    pub name: String,
    /// The points, in the order of the file.
    pub points: Vec<OperatingPoint>,
}

impl OperatingPoints {
    /// The table that a path stands for: a CSV file, or `operating_points.csv` in a folder that is
    /// no recording.
    pub fn file_of(path: &Path) -> Option<PathBuf> {
        if path.is_dir() {
            let table = path.join("operating_points.csv");
            return (table.is_file() && !path.join(MANIFEST).exists()).then_some(table);
        }
        path.extension().is_some_and(|extension| extension == "csv").then(|| path.to_owned())
    }

    /// Reads a table `v_left,v_right,v_forward,v_lateral,yaw_rate`; an empty cell was not measured.
    /// All is in SI units.
    ///
    /// # Errors
    /// Those of [`Self::read_by`].
    pub fn read(path: &Path) -> Result<Self, Error> {
        Self::read_by(path, &TableOptions::default())
    }

    /// Reads a table whose track speeds have the unit, and the radius of the wheels, of the
    /// options; of these, no others count.
    ///
    /// # Errors
    /// [`Error::Options`] for a unit of wheels without their radius, and the reverse;
    /// [`Error::Header`], [`Error::Cell`] with line and column (also for NaN, an infinity, or an
    /// empty track speed), [`Error::Empty`] without rows, [`Error::PointsInDegrees`] for yaw rates
    /// that are no radians.
    pub fn read_by(path: &Path, options: &TableOptions) -> Result<Self, Error> {
        let scale = scale_of_table(path, options.speed_unit, options.wheel_radius)?;
        let mut table = Table::open(path, &COLUMNS).map_err(|error| match error {
            Error::Header { path, line, found, expected } => {
                let expected = format!(
                    "{expected}, of steady points; a log of motion in one table is read by \
                     --columns t=COLUMN,v_l=COLUMN,v_r=COLUMN,x=COLUMN,y=COLUMN,yaw=COLUMN"
                );
                Error::Header { path, line, found, expected }
            }
            other => other,
        })?;
        let places = COLUMNS.map(|name| table.column(name).unwrap_or_default());
        let mut points = Vec::new();
        while table.advance()? {
            let speed = |place: usize| table.finite(places[place]);
            let measured = |place: usize| {
                let empty = table.cell(places[place]).is_empty();
                if empty { Ok(None) } else { speed(place).map(Some) }
            };
            points.push(OperatingPoint {
                v_left: scale * speed(0)?,
                v_right: scale * speed(1)?,
                v_forward: measured(2)?,
                v_lateral: measured(3)?,
                yaw_rate: measured(4)?,
            });
        }
        if points.is_empty() {
            let message = "no rows below the header".to_owned();
            return Err(Error::Empty { path: path.to_owned(), message });
        }
        if let Some(per_speed) = turn_in_degrees(&points) {
            return Err(Error::PointsInDegrees { path: path.to_owned(), per_speed });
        }
        let name = name_of(path);
        Ok(Self { name, points })
    }
}

/// Least yaw rate per m/s that one track is faster than the other that is in degrees: of ICRs 4.8 m
/// apart; in radians, of ICRs 83 mm apart, which no robot has.
const MIN_DEGREES: f64 = 12.0;

/// Yaw rate per m/s that one track is faster than the other, where it is more than radians can be.
fn turn_in_degrees(points: &[OperatingPoint]) -> Option<f64> {
    let ratios = points.iter().filter_map(|point| {
        let difference = point.v_right - point.v_left;
        Some((point.yaw_rate? / difference).abs()).filter(|_| difference != 0.0)
    });
    let mut ratios: Vec<f64> = ratios.collect();
    median(&mut ratios).filter(|per_speed| *per_speed > MIN_DEGREES)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SpeedUnit;

    #[test]
    fn track_speeds_have_the_unit_of_the_options() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("points.csv");
        std::fs::write(&path, format!("{}\n-60,30,0.5,,0.4\n", COLUMNS.join(",")))
            .expect("written");
        let read = |unit, wheel_radius| {
            let options =
                TableOptions { speed_unit: Some(unit), wheel_radius, ..Default::default() };
            OperatingPoints::read_by(&path, &options)
        };
        let points = read(SpeedUnit::MillimetresPerSecond, None).expect("points").points;
        let (v_left, v_right) = (-0.06, 0.03);
        let expected = OperatingPoint {
            v_left,
            v_right,
            v_forward: Some(0.5),
            v_lateral: None,
            yaw_rate: Some(0.4),
        };
        assert_eq!(points, [expected]);
        let points = read(SpeedUnit::TurnsPerMinute, Some(0.2)).expect("points").points;
        assert!((points[0].v_left + 0.2 * std::f64::consts::TAU).abs() < 1e-12, "{points:?}");
        let text = read(SpeedUnit::TurnsPerMinute, None).expect_err("no radius").to_string();
        assert!(text.contains("--wheel-radius METRES"), "{text}");
    }
}
