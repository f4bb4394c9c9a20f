//! `trackdyn drive`: a path, followed with the ideal differential drive and with kinematic
//! parameters.

mod summary;

use crate::changes::say_removed;
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::folder::prepare_folder;
use crate::options::{ModelOptions, finite, note_what_no_sensor_reports};
use crate::progress::Progress;
use crate::provenance::provenance;
use crate::stderr::say;
use crate::stdout::show;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use trackdyn::crates::drive::tracking::Estimate;
use trackdyn::drive::Prepared;
use trackdyn::{DriveSettings, Parameters, Path};

/// Options of `trackdyn drive`.
#[derive(Args)]
pub struct Options {
    /// Path to follow, a table x,y in m [default: a square of 3 m, once to the left]
    #[arg(long, value_name = "FILE")]
    path: Option<PathBuf>,
    /// Parameters to drive with beside the ideal drive (schema trackdyn.kinematics/1); repeatable
    #[arg(long, value_name = "FILE")]
    kinematics: Vec<PathBuf>,
    /// Drive by the vehicle's own forces, too: what the best model of it could do
    #[arg(long)]
    forces: bool,
    /// How the robot knows its pose
    #[arg(long, value_enum, default_value_t = Knows::Truth)]
    estimate: Knows,
    /// Speed on open ground, m/s
    #[arg(long, value_name = "SPEED", default_value_t = DriveSettings::default().speed,
          value_parser = finite)]
    speed: f64,
    /// Look-ahead of the path tracker, m
    #[arg(long, value_name = "M", value_parser = finite,
          default_value_t = DriveSettings::default().look_ahead)]
    look_ahead: f64,
    /// Leave inertia out: the robot is at its stationary motion at once
    #[arg(long)]
    quasi_static: bool,
    /// Folder for drive.toml, drive.png and tables of the cross-track error
    #[arg(long, value_name = "DIR", default_value = "out/drive")]
    out: PathBuf,
    #[command(flatten)]
    model: ModelOptions,
}

/// How the robot knows its pose.
#[derive(Clone, Copy, ValueEnum)]
enum Knows {
    /// By a perfect localisation
    Truth,
    /// By dead reckoning with the same kinematics
    Odometry,
}

/// Drives, prints the table of errors and writes the files.
pub fn run(options: &Options) -> Outcome {
    let vehicle = options.model.vehicle()?;
    let settings = DriveSettings {
        speed: options.speed,
        look_ahead: options.look_ahead,
        estimate: match options.estimate {
            Knows::Truth => Estimate::Truth,
            Knows::Odometry => Estimate::Odometry,
        },
        inertia: !options.quasi_static,
        forces: options.forces,
    };
    note_what_no_sensor_reports(vehicle.effects());
    let path = options.path.as_ref().map(|path| Path::read(path)).transpose()?;
    let path = path.unwrap_or_default();
    let parameters = options.kinematics.iter().map(Parameters::open);
    let parameters = parameters.collect::<Result<Vec<_>, _>>()?;
    let prepared = Prepared::new(&vehicle, &path, &parameters, &settings)?;
    prepare_folder(&options.out)?;
    let drives = Progress::over(|observer| prepared.run(observer))?;
    say_removed(&drives.write(&options.out, &provenance())?);
    show(&summary::text(&drives))?;
    say(format_args!("wrote drive.toml, drive.png and tables to {}", options.out.display()));
    Ok(if drives.all_arrived() { Exit::Done } else { Exit::NoResult })
}
