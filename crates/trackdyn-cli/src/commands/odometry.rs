//! `trackdyn odometry`: dead reckoning of a recording with several parameter sets.

mod document;
mod inputs;
mod runs_table;
mod summary;

use crate::commands::Outcome;
use crate::earlier::remove_of;
use crate::exit::Exit;
use crate::options::{DrivingOptions, command_line};
use crate::stderr::say;
use crate::stdout::show;
use clap::Args;
use inputs::Inputs;
use std::collections::BTreeSet;
use std::error::Error;
use std::path::{Path, PathBuf};
use trackdyn::crates::core::output::{prepare_folder, write_file};
use trackdyn::crates::estimate::odometry::{Comparison, tum};
use trackdyn::crates::recording::Clock;

/// Options of `trackdyn odometry`.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    driving: DrivingOptions,
    /// Parameters to replay with (schema trackdyn.kinematics/1); repeatable
    #[arg(long, value_name = "FILE")]
    kinematics: Vec<PathBuf>,
    /// Vehicle file (schema trackdyn.vehicle/1), whose gauge is that of the ideal drive
    #[arg(long, value_name = "FILE")]
    vehicle: PathBuf,
    /// Folder for odometry.toml, runs.csv, odometry.png and trajectories
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
}

/// Replays, prints the table of errors and writes the files.
pub fn run(options: &Options) -> Outcome {
    let inputs = Inputs::read(options)?;
    let part = options.driving.part(&inputs.recording)?;
    // All of the recording tells most of its clocks.
    let clock = Clock::of(&inputs.recording, options.driving.tau);
    let named = |error| format!("{}: {error}", options.driving.path().display());
    let result = Comparison::new(&part, inputs.sets(), clock.tau()).map_err(named)?;
    prepare_folder(&options.out)?;
    if let Some(reason) = clock.reason() {
        say(format_args!("note: {reason}; the clock offset is taken as 0 (set it with --tau)"));
    }
    for file in &inputs.files {
        if !inputs.is_held_out(file, &result) {
            say(format_args!(
                "note: {} was fitted to some of these runs, which makes its errors look smaller (choose \
                 others with --runs or --time)",
                file.path.display()
            ));
        }
    }
    if !result.left_out.is_empty() {
        say(format_args!(
            "note: {} runs left out, whose poses lie outside the time of their track speeds",
            result.left_out.len()
        ));
    }
    write(options, &inputs, &clock, &result)?;
    show(&summary::text(&inputs, &clock, &result))?;
    Ok(Exit::Done)
}

fn write(
    options: &Options,
    inputs: &Inputs,
    clock: &Clock,
    result: &Comparison,
) -> Result<(), Box<dyn Error>> {
    let out = &options.out;
    let caption = format!(
        "trackdyn {}, recording {}, vehicle {}",
        env!("CARGO_PKG_VERSION"),
        inputs.recording.fingerprint(),
        inputs.vehicle_fingerprint
    );
    let picture = trackdyn::crates::report::odometry(result, inputs.recording.name(), &caption)?;
    write_file(&out.join("odometry.png"), &picture)?;
    write_file(&out.join("runs.csv"), runs_table::text(result).as_bytes())?;
    let count = trajectories(&out.join("trajectories"), &out.join("odometry.toml"), result)?;
    let document = document::text(inputs, clock, result, &command_line())?;
    write_file(&out.join("odometry.toml"), document.as_bytes())?;
    say(format_args!(
        "wrote odometry.toml, runs.csv, odometry.png and {count} trajectories to {}",
        out.display()
    ));
    Ok(())
}

/// Writes recorded and predicted paths; returns how many.
///
/// Those of an earlier run, which `written` shows, go where this one has none.
fn trajectories(
    folder: &Path,
    written: &Path,
    result: &Comparison,
) -> Result<usize, Box<dyn Error>> {
    prepare_folder(folder)?;
    let mut files = BTreeSet::new();
    for path in &result.paths {
        let predicted = result.sets.iter().zip(&path.trajectories);
        let named = predicted.map(|(set, trajectory)| (set.name(), &trajectory.poses));
        for (name, poses) in std::iter::once(("recorded", &path.recorded)).chain(named) {
            let file = folder.join(format!("{name}-run{}.tum", path.run));
            write_file(&file, tum::text(&path.stamps, poses).as_bytes())?;
            files.insert(file);
        }
    }
    let there = std::fs::read_dir(folder)?.filter_map(|entry| Some(entry.ok()?.path()));
    let is_other = |file: &PathBuf| {
        file.extension().is_some_and(|extension| extension == "tum") && !files.contains(file)
    };
    remove_of(written, there.filter(is_other))?;
    Ok(files.len())
}
