//! The rows of a table whose columns are named.

use super::place::Places;
use super::time::Times;
use super::{Columns, Key, Unit, units};
use crate::recording::{Recording, Source, UncheckedRun, Warning};
use crate::recording::{divide, turn_by_gyroscope, turn_sensor};
use crate::rosbag::yaw_of_quaternion;
use crate::sample::{ImuSample, PoseSample, TrackSample};
use crate::table::Table;
use crate::table_options::scale_of_table;
use crate::{Error, Format, TableOptions};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::path::Path;
use trackdyn_core::Pose;
use trackdyn_core::input::name_of;

/// What a time may be.
const TIME: &str = "a number, a date such as 2024-03-31T00:59:30.05 or 31.03.2024 00:59:30.05, or \
                    a time of day such as 00:59:30.05";

/// Reads a table of these columns.
///
/// # Errors
/// [`Error::Header`] for a column that is not there, [`Error::Cell`] with line and column,
/// [`Error::Options`] for units and a radius that do not go together, those of [`Recording::new`].
pub fn read(path: &Path, columns: &Columns, options: &TableOptions) -> Result<Recording, Error> {
    let names: Vec<&str> = columns.columns.values().map(|column| column.name.as_str()).collect();
    let mut table = Table::open_any(path, &names)?.of_log(&names);
    let mut has_row = table.advance()?;
    let units = if has_row { units::of_row(columns, &table)? } else { None };
    if units.is_some() {
        has_row = table.advance()?;
    }
    let columns = units.as_ref().unwrap_or(columns);
    let unit = |key: Key| match columns.columns[&key].unit {
        Unit::Speed(unit) => Some(unit),
        _ => options.speed_unit,
    };
    let scales = [Key::Left, Key::Right].map(|key| -> Result<f64, Error> {
        let scale = scale_of_table(path, unit(key), options.wheel_radius)?;
        Ok(columns.columns[&key].sign * scale)
    });
    let [left, right] = scales;
    let scales = [left?, right?];
    if !has_row {
        let message = "no rows below the header".to_owned();
        return Err(Error::Empty { path: path.to_owned(), message });
    }
    let runs = rows(&mut table, columns, scales, options)?;
    let mut warnings = table.left_out();
    let mut runs = divide(runs, &mut warnings);
    let gyroscope = columns.columns.get(&Key::Gyro);
    if let Some(gyroscope) = gyroscope.filter(|_| !columns.has_poses()) {
        runs.iter_mut().for_each(turn_by_gyroscope);
        warnings.push(Warning::YawOfGyroscope { gyroscope: gyroscope.name.clone() });
    }
    turn_sensor(&mut runs, options.pose_axes, options.mount_yaw);
    for run in &mut runs {
        warnings.extend(thin_out(&mut run.poses.samples));
    }
    let name = name_of(path);
    let source =
        Source { format: Format::Table, path: Some(path.to_owned()), ..Source::computed() };
    Recording::accepting(name, "unknown", runs, source, warnings, &options.accepted)
        .map_err(|error| error.of_wheels(unit(Key::Left), options.wheel_radius))
}

/// The rows of all runs, from the current one on.
fn rows(
    table: &mut Table,
    columns: &Columns,
    scales: [f64; 2],
    options: &TableOptions,
) -> Result<Vec<UncheckedRun>, Error> {
    let at = |key: Key| columns.at(key, table);
    let [left, right] = [Key::Left, Key::Right].map(|key| at(key).map(|(place, _)| place));
    let [seconds, nanoseconds] = [Key::Time, Key::Nanoseconds]
        .map(|key| at(key).map(|(place, column)| (place, column.factor())));
    let quaternion = [Key::Qx, Key::Qy, Key::Qz, Key::Qw].map(at);
    let run = at(Key::Run).map(|(place, _)| place);
    let mut places = Places::of(table, columns, options.pose_unit);
    let yaw = at(Key::Yaw).map(|(place, column)| (place, column.unit, column.factor()));
    let quaternion = quaternion.map(|of| of.map(|(place, column)| (place, column.sign)));
    let gyroscope = at(Key::Gyro).map(|(place, column)| {
        let is_open = column.unit == Unit::Open;
        let unit = if is_open && options.gyro_in_degrees { TAU / 360.0 } else { 1.0 };
        (place, unit * column.factor())
    });
    let mut runs: BTreeMap<i64, UncheckedRun> = BTreeMap::new();
    let mut times = Times::default();
    let mut has_row = true;
    while has_row {
        let number = |place: Option<usize>| place.map_or(Ok(f64::NAN), |at| table.number(at));
        let id = run.map_or(Ok(0), |at| table.integer(at))?;
        let of_run = runs.entry(id).or_insert_with(|| UncheckedRun { id, ..Default::default() });
        let stamp = match seconds {
            Some((at, _)) if table.value(at).is_none() => {
                times.read(table.cell(at)).ok_or_else(|| table.cell_error(at, TIME))?
            }
            Some((at, factor)) => factor * table.number(at)?,
            None => f64::NAN,
        };
        let stamp = match nanoseconds {
            Some((at, factor)) => stamp + 1e-9 * factor * table.number(at)?,
            None => stamp,
        };
        let [v_left, v_right] = [number(left)?, number(right)?];
        if !(v_left.is_nan() && v_right.is_nan()) {
            let (v_left, v_right) = (scales[0] * v_left, scales[1] * v_right);
            of_run.tracks.samples.push(TrackSample { t: stamp, v_left, v_right });
        }
        let [x, y] = places.read(table)?;
        let yaw = match yaw {
            Some((place, Unit::Compass, sign)) => {
                FRAC_PI_2 - sign * table.number(place)? * TAU / 360.0
            }
            Some((place, _, factor)) => factor * table.number(place)?,
            None => {
                let mut parts = [0.0; 4];
                for (part, of) in parts.iter_mut().zip(quaternion) {
                    if let Some((place, sign)) = of {
                        *part = sign * table.number(place)?;
                    }
                }
                yaw_of_quaternion(parts)
            }
        };
        if !(x.is_nan() && y.is_nan() && yaw.is_nan()) {
            of_run.poses.samples.push(PoseSample { t: stamp, pose: Pose::new(x, y, yaw) });
        }
        if let Some((place, factor)) = gyroscope {
            let gyro_z = factor * table.number(place)?;
            if !gyro_z.is_nan() {
                let [acc_x, acc_y] = [f64::NAN; 2];
                of_run.imu.samples.push(ImuSample { t: stamp, gyro_z, acc_x, acc_y });
            }
        }
        has_row = table.advance()?;
    }
    Ok(runs.into_values().collect())
}

/// Leaves out poses that a table repeats because its rows come more often than poses: of every
/// usual number of equal rows, the first stays.
fn thin_out(poses: &mut Vec<PoseSample>) -> Option<Warning> {
    // A position that is not known is so in all rows.
    let is_repeated = |a: &PoseSample, b: &PoseSample| {
        let same = |a: f64, b: f64| a == b || (a.is_nan() && b.is_nan());
        let (a, b) = (&a.pose, &b.pose);
        same(a.x, b.x) && same(a.y, b.y) && a.yaw == b.yaw
    };
    let groups = || poses.chunk_by(is_repeated).map(<[PoseSample]>::len);
    let mut lengths: Vec<usize> = groups().collect();
    lengths.sort_unstable();
    let usual = lengths.get(lengths.len() / 2).copied().filter(|usual| *usual > 1)?;
    let kept: Vec<PoseSample> = poses
        .chunk_by(is_repeated)
        .flat_map(|equal| equal.iter().step_by(usual))
        .copied()
        .collect();
    let (of, all) = (kept.len(), poses.len());
    *poses = kept;
    let taken = format!("{of} of {all} rows: the others repeat the one before");
    Some(Warning::Chosen { what: "poses", taken })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_that_repeat_a_pose_are_left_out_and_rests_stay() {
        let pose = |t: f64, x: f64| PoseSample { t, pose: Pose::new(x, 0.0, 0.0) };
        let held: Vec<PoseSample> =
            (0..30).map(|k| pose(f64::from(k), f64::from(k / 3).min(6.0))).collect();
        let mut poses = held.clone();
        let warning = thin_out(&mut poses).expect("told").to_string();
        assert_eq!(poses, held.iter().step_by(3).copied().collect::<Vec<_>>());
        assert!(warning.contains("10 of 30 rows"), "{warning}");
        let mut changing: Vec<PoseSample> =
            (0..30).map(|k| pose(f64::from(k), f64::from(k).min(20.0))).collect();
        assert!(thin_out(&mut changing).is_none() && changing.len() == 30);
    }
}
