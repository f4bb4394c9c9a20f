//! `trackdyn compare`: what differs between a simulator's recordings and the robot's.

mod summary;

use crate::changes::{say_removed, say_written};
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::folder::prepare_folder;
use crate::gyroscope::say_gyroscopes;
use crate::options::{MethodOptions, PartOptions, RecordingOptions, held_out, refuse_for_points};
use crate::progress::Progress;
use crate::provenance::provenance;
use crate::stderr::warn;
use crate::stdout::show;
use clap::Args;
use std::path::PathBuf;
use trackdyn::compare::Prepared;
use trackdyn::crates::diagnose::Evidence;
use trackdyn::{CompareSettings, Vehicle};

/// Options of `trackdyn compare`.
#[derive(Args)]
pub struct Options {
    /// Vehicle: a file (schema trackdyn.vehicle/1), or a name such as husky-a200; its effects are
    /// part of the model, and what its *_sd say is taken as known
    #[arg(long, value_name = "FILE|NAME")]
    vehicle: PathBuf,
    /// Recordings of the robot, read as those of the simulator; their schedules may differ
    #[arg(long, value_name = "REAL", num_args = 1.., required = true)]
    with: Vec<PathBuf>,
    /// Runs of the robot to judge the result on, which nothing is fitted or chosen on: a list such
    /// as 9-11, or `none` for both sets [default: every fourth run where there are eight or more]
    #[arg(long = "held-out-real", value_name = "RUNS|none")]
    held_out: Option<String>,
    #[command(flatten)]
    method: MethodOptions,
    /// Folder for compare.toml and compare.html
    #[arg(long, value_name = "DIR", default_value = "out/compare")]
    out: PathBuf,
    #[command(flatten)]
    recording: RecordingOptions,
    /// More recordings of the simulator
    #[arg(help_heading = None::<&str>)]
    more: Vec<PathBuf>,
    #[command(flatten)]
    part: PartOptions,
}

/// Compares, prints the answer in one screen and writes it.
pub fn run(options: &Options) -> Outcome {
    let vehicle = Vehicle::choose(&options.vehicle)?;
    let given = options.recording.given().into_iter().chain(options.part.given());
    let given: Vec<String> = given.chain(options.method.given()).collect();
    for first in [&options.recording.recording, &options.with[0]] {
        refuse_for_points(&given, first)?;
    }
    let sim = std::iter::once(&options.recording.recording).chain(&options.more);
    let part = options.part.part();
    let sim = options.recording.read_all(sim, &part)?;
    let real = options.recording.read_all(&options.with, &part)?;
    let settings = CompareSettings {
        held_out: held_out("--held-out-real", options.held_out.as_deref())?,
        gyroscope: options.method.gyroscope,
        resampling: options.method.resampling(),
        method: options.method.method()?,
        laws: Vec::new(),
    };
    let prepared = Prepared::new(&sim, &real, &vehicle, &settings)?;
    for (name, found) in prepared.names().into_iter().zip(prepared.contradictions()) {
        for contradiction in found {
            warn(format_args!("{name}: {contradiction}"));
        }
    }
    say_gyroscopes(prepared.evidence().into_iter().filter_map(Evidence::gyroscope));
    prepare_folder(&options.out)?;
    let comparison = Progress::over(|observer| prepared.run(observer))?;
    let changes = comparison.write(&options.out, &provenance())?;
    say_removed(&changes);
    say_written(&changes);
    show(&summary::text(&comparison))?;
    Ok(Exit::Done)
}
