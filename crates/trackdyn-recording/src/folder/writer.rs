//! Writing a recording folder.

use super::{MANIFEST, Manifest};
use crate::Error;
use crate::recording::{Recording, Run};
use crate::sample::{Cells, Sample, Series};
use std::fmt::Write;
use std::io::ErrorKind;
use std::path::Path;
use trackdyn_core::output;

/// Writes a recording folder; numbers are printed so that reading gives the same bits.
///
/// An old `recording.toml` is removed first and the new one written last: a folder without it is
/// not a recording. Other files are replaced. Those of an IMU are removed where the recording has
/// none.
///
/// # Errors
/// [`Error::Output`], [`Error::Unreadable`] when an old file cannot be removed.
pub fn write(recording: &Recording, folder: &Path) -> Result<(), Error> {
    output::prepare_folder(folder)?;
    let runs = recording.runs();
    let file = |name: &str| folder.join(name);
    let remove = |name: &str| match std::fs::remove_file(file(name)) {
        Err(cause) if cause.kind() != ErrorKind::NotFound => {
            Err(Error::Unreadable { path: file(name), cause })
        }
        _ => Ok(()),
    };
    for old in [MANIFEST, "imu.csv", "imu.parquet"] {
        remove(old)?;
    }
    output::write_file(&file("tracks.csv"), table(runs, Run::track_series).as_bytes())?;
    output::write_file(&file("poses.csv"), table(runs, Run::pose_series).as_bytes())?;
    if runs.iter().any(|run| !run.imu().is_empty()) {
        output::write_file(&file("imu.csv"), table(runs, Run::imu_series).as_bytes())?;
    }
    let manifest = Manifest {
        name: recording.name().to_owned(),
        robot: recording.robot().to_owned(),
        noise: recording.stated_noise(),
        pose_frame: recording.pose_frame(),
    };
    output::write_file(&file(MANIFEST), manifest.to_toml().as_bytes())?;
    Ok(())
}

/// The text of one table; a column `run` only where there is more than run 0.
fn table<'a, S: Sample + 'a>(runs: &'a [Run], series_of: fn(&'a Run) -> &'a Series<S>) -> String {
    let with_runs = runs.len() > 1 || runs.iter().any(|run| run.id() != 0);
    let mut further: Vec<&str> = Vec::new();
    for column in runs.iter().flat_map(|run| &series_of(run).extra) {
        if !further.contains(&column.name.as_str()) {
            further.push(&column.name);
        }
    }
    let mut header: Vec<String> = Vec::new();
    if with_runs {
        header.push("run".to_owned());
    }
    header.extend(S::COLUMNS.iter().map(|&name| name.to_owned()));
    header.extend(further.iter().map(|name| quoted(name)));
    let mut text = header.join(",");
    text.push('\n');
    for run in runs {
        push_run(&mut text, with_runs.then_some(run.id()), series_of(run), &further);
    }
    text
}

fn push_run<S: Sample>(text: &mut String, id: Option<i64>, series: &Series<S>, further: &[&str]) {
    let cells: Vec<Option<&Cells>> = further
        .iter()
        .map(|name| {
            let column = series.extra.iter().find(|column| column.name == *name);
            column.map(|column| &column.cells)
        })
        .collect();
    let mut columns = Vec::new();
    for (row, sample) in series.samples.iter().enumerate() {
        if let Some(id) = id {
            push(text, format_args!("{id},"));
        }
        columns.clear();
        sample.push_columns(&mut columns);
        for (place, value) in columns.iter().enumerate() {
            let comma = if place == 0 { "" } else { "," };
            push(text, format_args!("{comma}{value}"));
        }
        for cells in &cells {
            match cells {
                Some(Cells::Numbers(numbers)) if !numbers[row].is_nan() => {
                    push(text, format_args!(",{}", numbers[row]));
                }
                Some(Cells::Texts(texts)) => push(text, format_args!(",{}", quoted(&texts[row]))),
                _ => text.push(','),
            }
        }
        text.push('\n');
    }
}

fn push(text: &mut String, part: std::fmt::Arguments) {
    text.write_fmt(part).expect("a string takes every text");
}

/// A cell in quotes where the text would break the row (RFC 4180).
fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_owned()
    }
}
