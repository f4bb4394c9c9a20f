//! Tables of steady motion: a measured map of instantaneous centres of rotation.

use crate::Error;
use crate::folder::MANIFEST;
use crate::table::Table;
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
    ///
    /// # Errors
    /// [`Error::Header`], [`Error::Cell`] with line and column (also for NaN, an infinity, or an
    /// empty track speed), [`Error::Empty`] without rows, [`Error::PointsInDegrees`] for yaw rates
    /// that are no radians.
    pub fn read(path: &Path) -> Result<Self, Error> {
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
                v_left: speed(0)?,
                v_right: speed(1)?,
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
