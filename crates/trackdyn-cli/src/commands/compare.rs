//! `trackdyn compare`: what differs between a simulator's recordings and the robot's.

mod summary;

use crate::changes::{say_removed, say_written};
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::options::{PartOptions, RecordingOptions, refuse_for_points};
use crate::progress::Progress;
use crate::provenance::provenance;
use crate::stdout::show;
use clap::Args;
use std::path::PathBuf;
use trackdyn::compare::Prepared;
use trackdyn::{
    CompareSettings, Error, HeldOut, MethodSettings, Recording, Resampling, Vehicle, prepare_folder,
};

/// Heading of options in the help.
const BOOTSTRAP: &str = "Bootstrap";

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
    /// Draws of the bootstrap behind the tests
    #[arg(long, help_heading = BOOTSTRAP, value_name = "N", default_value_t = 2000,
          value_parser = clap::value_parser!(u32).range(1000..=100_000))]
    draws: u32,
    /// Seed of the bootstrap
    #[arg(long, help_heading = BOOTSTRAP, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Numbers of the method that differ from their defaults: a table such as `[verdict]` with
    /// max_p = 0.001
    #[arg(long, value_name = "FILE")]
    settings: Option<PathBuf>,
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
    let given: Vec<String> =
        options.recording.given().into_iter().chain(options.part.given()).collect();
    for first in [&options.recording.recording, &options.with[0]] {
        refuse_for_points(&given, first)?;
    }
    let sim = std::iter::once(&options.recording.recording).chain(&options.more);
    let sim = recordings(options, sim)?;
    let real = recordings(options, &options.with)?;
    let method = options.settings.as_deref().map(MethodSettings::open).transpose()?;
    let settings = CompareSettings {
        held_out: held_out(options)?,
        resampling: Resampling { draws: options.draws as usize, seed: options.seed },
        method: method.unwrap_or_default(),
        laws: Vec::new(),
    };
    let prepared = Prepared::new(&sim, &real, &vehicle, &settings)?;
    prepare_folder(&options.out)?;
    let comparison = Progress::over(|observer| prepared.run(observer))?;
    let changes = comparison.write(&options.out, &provenance())?;
    say_removed(&changes);
    say_written(&changes);
    show(&summary::text(&comparison))?;
    Ok(Exit::Done)
}

/// Recordings, each read in one way, and of each the part that counts.
fn recordings<'a>(
    options: &Options,
    paths: impl IntoIterator<Item = &'a PathBuf>,
) -> Result<Vec<Recording>, Error> {
    let part = options.part.part();
    paths.into_iter().map(|path| options.recording.read_path(path)?.part(&part)).collect()
}

fn held_out(options: &Options) -> Result<[HeldOut; 2], String> {
    match options.held_out.as_deref() {
        None => Ok([HeldOut::EveryFourth, HeldOut::EveryFourth]),
        Some("none") => Ok([HeldOut::None, HeldOut::None]),
        Some(list) => {
            let runs = list.parse().map_err(|error| format!("--held-out-real {list}: {error}"))?;
            Ok([HeldOut::EveryFourth, HeldOut::Runs(runs)])
        }
    }
}
