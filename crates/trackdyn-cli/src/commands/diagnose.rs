//! `trackdyn diagnose`: where model and recording differ, and what was left out.

mod summary;

use crate::changes::{say_removed, say_written, written};
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::folder::prepare_folder;
use crate::options::{PartOptions, RecordingOptions, refuse_for_points};
use crate::progress::Progress;
use crate::provenance::provenance;
use crate::stderr::say;
use crate::stdout::show;
use clap::Args;
use std::path::PathBuf;
use trackdyn::diagnose::Prepared;
use trackdyn::{
    Change, DiagnoseSettings, Error, HeldOut, MethodSettings, Recording, Resampling, Vehicle,
};

/// Heading of options in the help.
const BOOTSTRAP: &str = "Bootstrap";

/// Options of `trackdyn diagnose`.
#[derive(Args)]
pub struct Options {
    /// Vehicle: a file (schema trackdyn.vehicle/1), or a name such as husky-a200; its effects are
    /// part of the model, and what its *_sd say is taken as known
    #[arg(long, value_name = "FILE|NAME")]
    vehicle: PathBuf,
    /// Runs to judge the result on, which nothing is fitted or chosen on: a list such as 9-11, or
    /// `none` [default: every fourth run where there are eight or more, every fourth point of a
    /// table]
    #[arg(long, value_name = "RUNS|none")]
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
    /// Folder for diagnosis.toml, vehicle.corrected.toml, report.html and the figures
    #[arg(long, value_name = "DIR", default_value = "out/diagnosis")]
    out: PathBuf,
    /// Write diagnosis.mcap too, for Foxglove, Rerun and PlotJuggler, and layouts beside it: paths,
    /// ICRs and whitened residuals before and after
    #[arg(long)]
    mcap: bool,
    #[command(flatten)]
    recording: RecordingOptions,
    /// More recordings of the same robot
    #[arg(help_heading = None::<&str>)]
    more: Vec<PathBuf>,
    #[command(flatten)]
    part: PartOptions,
}

/// Diagnoses, prints the answer in one screen and writes it.
pub fn run(options: &Options) -> Outcome {
    let vehicle = Vehicle::choose(&options.vehicle)?;
    let mcap = options.mcap.then(|| "--mcap".to_owned());
    let given: Vec<String> =
        options.recording.given().into_iter().chain(options.part.given()).chain(mcap).collect();
    refuse_for_points(&given, &options.recording.recording)?;
    let recordings = recordings(options)?;
    let settings = DiagnoseSettings {
        held_out: held_out(options)?,
        resampling: Resampling { draws: options.draws as usize, seed: options.seed },
        method: method(options)?,
        laws: Vec::new(),
    };
    let prepared = Prepared::new(&recordings, &vehicle, &settings)?;
    prepare_folder(&options.out)?;
    let diagnosis = Progress::over(|observer| prepared.run(observer))?;
    let changes = diagnosis.write(&options.out, &provenance())?;
    say_changes(&changes);
    if options.mcap {
        say_written(&diagnosis.write_layers(&options.out, &provenance())?);
    }
    show(&summary::text(&diagnosis))?;
    Ok(Exit::Done)
}

/// All recordings, each read in one way, and of each the part that counts.
fn recordings(options: &Options) -> Result<Vec<Recording>, Error> {
    let more = options.more.iter().map(|path| options.recording.read_path(path));
    let all = std::iter::once(options.recording.read()).chain(more);
    let part = options.part.part();
    all.map(|recording| recording?.part(&part)).collect()
}

fn method(options: &Options) -> Result<MethodSettings, Error> {
    let method = options.settings.as_deref().map(MethodSettings::open).transpose()?;
    Ok(method.unwrap_or_default())
}

fn held_out(options: &Options) -> Result<HeldOut, String> {
    match options.held_out.as_deref() {
        None => Ok(HeldOut::EveryFourth),
        Some("none") => Ok(HeldOut::None),
        Some(list) => {
            let runs = list.parse().map_err(|error| format!("--held-out {list}: {error}"))?;
            Ok(HeldOut::Runs(runs))
        }
    }
}

/// Names the files that were written; figures are counted.
fn say_changes(changes: &[Change]) {
    let (figures, files): (Vec<_>, Vec<_>) =
        written(changes).partition(|file| file.extension().is_some_and(|of| of == "png"));
    let (report, others) = files.split_last().expect("a diagnosis writes a report");
    for file in others {
        say(format_args!("wrote {}", file.display()));
    }
    say_removed(changes);
    let count = figures.len();
    say(format_args!("wrote {} and {count} figures beside it", report.display()));
}
