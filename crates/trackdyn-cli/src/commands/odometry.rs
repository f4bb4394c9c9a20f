//! `trackdyn odometry`: dead reckoning of a recording with several parameter sets.

mod summary;

use crate::changes::{say_doubtful, say_removed, written};
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::gyroscope::say_gyroscopes;
use crate::options::{DrivingOptions, GaugeOptions};
use crate::provenance::provenance;
use crate::stderr::{note, say};
use crate::stdout::show;
use clap::{ArgGroup, Args};
use std::path::PathBuf;
use trackdyn::{OdometrySettings, Parameters, odometry, prepare_folder};

/// Options of `trackdyn odometry`.
#[derive(Args)]
#[command(group(ArgGroup::new("known").required(true).args(["vehicle", "gauge"])))]
pub struct Options {
    /// Parameters to replay with (schema trackdyn.kinematics/1); repeatable
    #[arg(long, value_name = "FILE")]
    kinematics: Vec<PathBuf>,
    /// Correct the yaw of the poses by the recording's gyroscope
    #[arg(long)]
    gyroscope: bool,
    /// Folder for odometry.toml, runs.csv, odometry.png and trajectories
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    #[command(flatten)]
    driving: DrivingOptions,
    #[command(flatten)]
    gauge: GaugeOptions,
}

/// Replays, prints the table of errors and writes the files.
pub fn run(options: &Options) -> Outcome {
    let gauge = options.gauge.expect_gauge()?;
    let parameters = options.kinematics.iter().map(Parameters::open);
    let parameters = parameters.collect::<Result<Vec<_>, _>>()?;
    for doubtful in parameters.iter().filter(|of| of.is_doubtful()) {
        say_doubtful(doubtful.name());
    }
    let recording = options.driving.recording()?;
    let settings = OdometrySettings {
        part: options.driving.part(),
        tau: options.driving.tau,
        gyroscope: options.gyroscope,
    };
    let found = odometry(&recording, &gauge, &parameters, &settings)?;
    prepare_folder(&options.out)?;
    if let Some(reason) = found.clock.reason() {
        note(format_args!("{reason}; the clock offset is taken as 0 (set it with --tau)"));
    }
    say_gyroscopes(found.recording().gyroscope());
    for fitted in found.fitted_to_it() {
        note(format_args!(
            "{} was fitted to some of these runs, which makes its errors look smaller \
            (choose \
             others with --runs or --time)",
            fitted.name()
        ));
    }
    let left_out = found.comparison.left_out.len();
    if left_out > 0 {
        note(format_args!(
            "{left_out} runs left out, whose poses lie outside the time of their track speeds"
        ));
    }
    let changes = found.write(&options.out, &provenance())?;
    say_removed(&changes);
    let is_path = |file: &std::path::Path| file.extension().is_some_and(|of| of == "tum");
    say(format_args!(
        "wrote odometry.toml, runs.csv, odometry.png and {} trajectories to {}",
        written(&changes).filter(|file| is_path(file)).count(),
        options.out.display()
    ));
    show(&summary::text(&found))?;
    Ok(Exit::Done)
}
