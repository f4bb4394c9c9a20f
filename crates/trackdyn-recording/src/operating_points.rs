//! Tables of steady motion: a measured map of instantaneous centres of rotation.

use crate::Error;
use crate::folder::MANIFEST;
use crate::robust::deviation_about_zero;
use crate::table::Table;
use std::path::{Path, PathBuf};
use trackdyn_core::real;

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

/// Three neighbours on a line of one track speed.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LineTriple {
    /// Their other track speed, ascending, m/s.
    across: [f64; 3],
    /// How far the middle one lies off the straight line through the outer two, in the channel's unit and such
    /// that it scatters as a single reading does.
    off: f64,
}

/// The triples of neighbours on all lines of one track speed, in a channel; no model enters.
fn line_triples(
    points: &[OperatingPoint],
    channel: impl Fn(&OperatingPoint) -> Option<f64>,
) -> Vec<LineTriple> {
    let mut triples = Vec::new();
    for shared in [|point: &OperatingPoint| point.v_right, |point: &OperatingPoint| point.v_left] {
        let across = |point: &OperatingPoint| point.v_left + point.v_right - shared(point);
        let mut line: Vec<(f64, f64, f64)> = points
            .iter()
            .filter_map(|point| Some((shared(point), across(point), channel(point)?)))
            .collect();
        line.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        for triple in line.windows(3) {
            let [(a, x, left), (b, y, middle), (c, z, right)] = [triple[0], triple[1], triple[2]];
            if a != b || b != c || x >= y || y >= z {
                continue;
            }
            let part = (y - x) / (z - x);
            let off = middle - (1.0 - part) * left - part * right;
            let gain = (1.0 + part * part + (1.0 - part) * (1.0 - part)).sqrt();
            triples.push(LineTriple { across: [x, y, z], off: off / gain });
        }
    }
    triples
}

/// Triples of neighbours that a scatter needs.
const FEWEST_TRIPLES: usize = 10;

/// Standard deviation of a channel, in its unit, from neighbours on lines of one track speed; no model enters. None without enough of them.
pub fn scatter(
    points: &[OperatingPoint],
    channel: impl Fn(&OperatingPoint) -> Option<f64>,
) -> Option<f64> {
    // The ICRs may jump where a track changes its direction.
    let jumps = |[x, y, z]: [f64; 3]| x * y < 0.0 || y * z < 0.0 || x.abs().min(z.abs()) < 1e-9;
    let triples = line_triples(points, channel).into_iter();
    let smooth = triples.filter(|triple| !jumps(triple.across));
    let mut off: Vec<f64> = smooth.map(|triple| triple.off).collect();
    if off.len() < FEWEST_TRIPLES {
        return None;
    }
    let rms = (off.iter().map(|off| off * off).sum::<f64>() / real(off.len())).sqrt();
    let median = deviation_about_zero(&mut off)?;
    // Where most readings are rounded away the median says nothing.
    Some(if median > 0.0 { median } else { rms }).filter(|scatter| *scatter > 0.0)
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
    /// The table that a path stands for: a CSV file, or `operating_points.csv` in a folder that is no
    /// recording.
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
    /// empty track speed), [`Error::Empty`] without rows.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let mut table = Table::open(path, &COLUMNS)?;
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
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Self { name, points })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line at one speed of the right track, whose yaw rates lie in turn on both sides of a straight line, and jump where the left track turns back.
    fn line(count: i32) -> Vec<OperatingPoint> {
        let point = |k: i32| {
            let v_left = 0.1 * f64::from(k) - 0.55;
            let off = if k % 2 == 0 { 1e-3 } else { -1e-3 };
            let jump = if v_left < 0.0 { 0.5 } else { 0.0 };
            let yaw_rate = Some(0.4 - v_left + jump + off);
            OperatingPoint { v_left, v_right: 0.4, yaw_rate, ..OperatingPoint::default() }
        };
        (0..count).map(point).collect()
    }

    #[test]
    fn scatter_is_of_smooth_lines_that_are_long_enough() {
        let found = scatter(&line(18), |point| point.yaw_rate).expect("a scatter");
        // 2e-3 off, over √1.5, in place of a standard deviation: 1.48 times the median
        assert!((found / (1.4826 * 2e-3 / 1.5_f64.sqrt()) - 1.0).abs() < 0.01, "{found}");
        assert_eq!(scatter(&line(6), |point| point.yaw_rate), None);
    }
}
