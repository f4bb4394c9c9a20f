//! The project's own format: a folder with `recording.toml` and one CSV per series.
//!
//! `tracks.csv` (`t,v_left,v_right`) must be there, and `poses.csv` (`t,x,y,yaw`) or `imu.csv`
//! (`t,gyro_z,acc_x,acc_y`), whose gyroscope alone tells the yaw. An integer column `run` splits
//! all of them into runs. Further columns are kept. Where a CSV file is not there, a Parquet file
//! of the same columns may be (`tracks.parquet`; needs the feature `parquet`).

use crate::recording::{
    Recording, Source, UncheckedRun, Warning, divide, turn_by_gyroscope, turn_sensor,
};
use crate::sample::{Sample, Series, TrackSample};
use crate::{Error, Format, TableOptions};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

mod manifest;
#[cfg(feature = "parquet")]
mod parquet_table;
mod rows;
mod writer;

use manifest::Manifest;
use rows::{Rows, read_rows};
pub use writer::write;

/// Name of the file that makes a folder a recording.
pub const MANIFEST: &str = "recording.toml";

/// Reads a recording folder, speeds in m/s.
///
/// # Errors
/// [`Error::NotARecording`] without `recording.toml`, and errors that name file, line and column.
pub fn read(folder: &Path) -> Result<Recording, Error> {
    read_by(folder, &TableOptions::default())
}

/// Reads a recording folder.
///
/// # Errors
/// Those of [`read`]; [`Error::Options`] for options that do not go together.
pub fn read_by(folder: &Path, options: &TableOptions) -> Result<Recording, Error> {
    let path = folder.join(MANIFEST);
    if !path.is_file() {
        return Err(Error::NotARecording {
            path: folder.to_owned(),
            found: format!("no {MANIFEST}"),
            expected: "recording.toml (schema, name, robot, frame) beside tracks.csv and \
                       poses.csv; a table of steady operating points is not a recording",
        });
    }
    let manifest = Manifest::read(&path)?;
    let mut runs: BTreeMap<i64, UncheckedRun> = BTreeMap::new();
    let mut split = None;
    let mut warnings =
        fill(&table(folder, "tracks"), &mut runs, &mut split, |run| &mut run.tracks)?;
    let (poses, imu) = (table(folder, "poses"), table(folder, "imu"));
    let by_gyroscope = imu.exists() && !poses.exists();
    if !by_gyroscope {
        warnings.extend(fill(&poses, &mut runs, &mut split, |run| &mut run.poses)?);
    }
    if imu.exists() {
        warnings.extend(fill(&imu, &mut runs, &mut split, |run| &mut run.imu)?);
    }
    let source =
        Source { format: Format::Folder, path: Some(folder.to_owned()), ..Source::computed() };
    let mut runs = divide(runs.into_values().collect(), &mut warnings);
    options.convert(folder, &mut runs)?;
    if by_gyroscope {
        runs.iter_mut().for_each(turn_by_gyroscope);
        warnings.push(Warning::YawOfGyroscope { gyroscope: imu.display().to_string() });
    }
    turn_sensor(&mut runs, options.pose_axes, options.mount_yaw);
    let Manifest { name, robot, noise, pose_frame } = manifest;
    Recording::accepting(name, robot, runs, source, warnings, &options.accepted)
        .map_err(|error| error.of_wheels(options.speed_unit, options.wheel_radius))
        .map(|recording| recording.with_stated_noise(noise).with_pose_frame(pose_frame))
}

/// The CSV file of a table, or the Parquet file where only that is there.
fn table(folder: &Path, name: &str) -> PathBuf {
    let (csv, parquet) = (folder.join(name).with_extension("csv"), folder.join(name));
    let parquet = parquet.with_extension("parquet");
    if !csv.exists() && parquet.exists() { parquet } else { csv }
}

/// The rows of a table in either format.
fn read_table<S: Sample>(path: &Path) -> Result<Rows<S>, Error> {
    if path.extension().is_none_or(|extension| extension != "parquet") {
        return read_rows(path);
    }
    #[cfg(feature = "parquet")]
    return parquet_table::read_rows(path);
    #[cfg(not(feature = "parquet"))]
    Err(Error::NotARecording {
        path: path.to_owned(),
        found: "a Parquet file".to_owned(),
        expected: "a CSV file, or a program that reads Parquet, which is built with `cargo build \
                   --release --features parquet`",
    })
}

/// The series of one file, put into their runs, and what was left out of it. `split` says whether
/// the files so far have a column `run`.
fn fill<S: Sample>(
    path: &Path,
    runs: &mut BTreeMap<i64, UncheckedRun>,
    split: &mut Option<bool>,
    series_of: impl Fn(&mut UncheckedRun) -> &mut Series<S>,
) -> Result<Vec<Warning>, Error> {
    let rows = read_table::<S>(path)?;
    if *split.get_or_insert(rows.has_runs) != rows.has_runs {
        let (found, expected) = if rows.has_runs {
            ("with run", "no column run, as in tracks.csv")
        } else {
            ("without run", "a column run, as in tracks.csv")
        };
        return Err(Error::Header {
            path: path.to_owned(),
            line: 1,
            found: found.to_owned(),
            expected: expected.to_owned(),
        });
    }
    for (id, series) in rows.runs {
        let run = runs.entry(id).or_insert_with(|| UncheckedRun { id, ..Default::default() });
        *series_of(run) = series;
    }
    Ok(rows.warnings)
}

/// Track speeds that go with poses from elsewhere, and what was left out.
///
/// # Errors
/// [`Error::Header`] when the table has runs, and those of the table.
pub(crate) fn read_single_tracks(
    path: &Path,
) -> Result<(Series<TrackSample>, Vec<Warning>), Error> {
    let rows = read_table::<TrackSample>(path)?;
    if rows.has_runs {
        return Err(Error::Header {
            path: path.to_owned(),
            line: 1,
            found: "with run".to_owned(),
            expected: "one run beside one trajectory, without a column run".to_owned(),
        });
    }
    Ok((rows.runs.into_values().next().unwrap_or_default(), rows.warnings))
}
