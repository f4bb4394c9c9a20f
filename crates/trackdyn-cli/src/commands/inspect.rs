//! `trackdyn inspect`: what a recording holds, and what it is good for.

mod next;
mod summary;

use crate::changes::{say_removed, say_written};
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::options::{DrivingOptions, GaugeOptions, refuse_for_points};
use crate::provenance::provenance;
use crate::stdout::show;
use clap::Args;
use next::Asked;
use std::path::PathBuf;
use trackdyn::{InspectSettings, Parameters, inspect};

/// Options of `trackdyn inspect`.
#[derive(Args)]
pub struct Options {
    /// Parameters that predict the yaw rate (schema trackdyn.kinematics/1) [default: the distance
    /// of the ICRs that fits best]
    #[arg(long, value_name = "FILE")]
    kinematics: Option<PathBuf>,
    /// Folder for inspect.png
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    #[command(flatten)]
    driving: DrivingOptions,
    #[command(flatten)]
    gauge: GaugeOptions,
}

/// Judges a recording, prints the judgement with the commands to go on with, and writes a picture.
pub fn run(options: &Options) -> Outcome {
    refuse_for_points(&options.driving.given(), options.driving.path())?;
    let settings = InspectSettings {
        read: options.driving.read_options(),
        part: options.driving.part(),
        tau: options.driving.tau,
        gauge: options.gauge.gauge()?,
        parameters: options.kinematics.as_ref().map(Parameters::open).transpose()?,
    };
    let found = inspect(options.driving.path(), &settings)?;
    let changes = found.write(&options.out, &provenance())?;
    say_written(&changes);
    say_removed(&changes);
    let asked = Asked {
        path: options.driving.path(),
        gauge: &options.gauge,
        part: &settings.part,
        tau: settings.tau,
        out: &options.out,
    };
    show(&(summary::text(&found) + &next::text(&found, &asked)))?;
    Ok(Exit::Done)
}
