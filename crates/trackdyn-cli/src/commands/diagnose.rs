//! `trackdyn diagnose`: where model and recording differ, and what was left out.

mod summary;

use crate::changes::{say_removed, say_written, written};
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::folder::prepare_folder;
use crate::gyroscope::{say_gyroscopes, say_unused_gyroscopes};
use crate::options::{
    MethodOptions, PART, PartOptions, RecordingOptions, held_out, refuse_for_points, seconds,
};
use crate::progress::Progress;
use crate::provenance::provenance;
use crate::stderr::{say, warn};
use crate::stdout::show;
use clap::Args;
use std::path::PathBuf;
use trackdyn::diagnose::Prepared;
use trackdyn::{Change, DiagnoseSettings, Vehicle};

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
    #[command(flatten)]
    method: MethodOptions,
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
    /// Time in s by which poses lag behind the track speeds [default: estimated]
    #[arg(long, help_heading = PART, value_name = "SECONDS", value_parser = seconds,
          allow_hyphen_values = true)]
    tau: Option<f64>,
}

/// Diagnoses, prints the answer in one screen and writes it.
pub fn run(options: &Options) -> Outcome {
    let vehicle = Vehicle::choose(&options.vehicle)?;
    let mcap = options.mcap.then(|| "--mcap".to_owned());
    let tau = options.tau.map(|_| "--tau".to_owned());
    let given = options.recording.given().into_iter().chain(options.part.given());
    let given: Vec<String> = given.chain(options.method.given()).chain(mcap).chain(tau).collect();
    refuse_for_points(&given, &options.recording.recording)?;
    let paths = std::iter::once(&options.recording.recording).chain(&options.more);
    let recordings = options.recording.read_all(paths, &options.part.part())?;
    let settings = DiagnoseSettings {
        held_out: held_out("--held-out", options.held_out.as_deref())?,
        tau: options.tau,
        gyroscope: options.method.gyroscope,
        resampling: options.method.resampling(),
        method: options.method.method()?,
        laws: Vec::new(),
    };
    let prepared = Prepared::new(&recordings, &vehicle, &settings)?;
    for contradiction in prepared.contradictions() {
        warn(format_args!("{contradiction}"));
    }
    say_gyroscopes(prepared.evidence().gyroscope());
    if !settings.gyroscope {
        say_unused_gyroscopes(&recordings, settings.tau);
    }
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
