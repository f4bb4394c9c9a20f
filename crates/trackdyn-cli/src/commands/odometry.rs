//! `trackdyn odometry`: dead reckoning of a recording with several parameter sets.

mod summary;

use crate::changes::{say_removed, say_written, written};
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::folder::prepare_folder;
use crate::options::ReplayOptions;
use crate::provenance::provenance;
use crate::stderr::say;
use crate::stdout::show;
use clap::Args;
use std::path::PathBuf;

/// Options of `trackdyn odometry`.
#[derive(Args)]
pub struct Options {
    /// Folder for odometry.toml, runs.csv, odometry.png and trajectories
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Write odometry.mcap too, for Foxglove, Rerun and PlotJuggler, and layouts beside it (see
    /// `trackdyn export mcap`)
    #[arg(long)]
    mcap: bool,
    #[command(flatten)]
    replay: ReplayOptions,
}

/// Replays, prints the table of errors and writes the files.
pub fn run(options: &Options) -> Outcome {
    let found = options.replay.replay()?;
    prepare_folder(&options.out)?;
    let changes = found.write(&options.out, &provenance())?;
    let layers =
        if options.mcap { found.write_layers(&options.out, &provenance())? } else { Vec::new() };
    say_removed(&changes);
    let is_path = |file: &std::path::Path| file.extension().is_some_and(|of| of == "tum");
    say(format_args!(
        "wrote odometry.toml, runs.csv, odometry.png and {} trajectories to {}",
        written(&changes).filter(|file| is_path(file)).count(),
        options.out.display()
    ));
    say_written(&layers);
    show(&summary::text(&found))?;
    Ok(Exit::Done)
}
