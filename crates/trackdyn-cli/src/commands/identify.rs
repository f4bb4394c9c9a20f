//! `trackdyn identify`: kinematic parameters from a recording.

mod document;
mod points;
mod summary;

pub use points::lagging_points;

use crate::commands::Outcome;
use crate::earlier::remove_earlier;
use crate::exit::Exit;
use crate::options::{DrivingOptions, command_line, not_negative, read_vehicle};
use crate::progress::Progress;
use crate::stderr::say;
use crate::stdout::show;
use clap::Args;
use std::path::{Path, PathBuf};
use trackdyn::crates::core::output::{prepare_folder, write_file};
use trackdyn::crates::estimate::genetic::GeneticOptions;
use trackdyn::crates::estimate::identification::{self, Fit};
use trackdyn::crates::estimate::{Free, Nuisance, identify};
use trackdyn::crates::model::VehicleFile;
use trackdyn::crates::model::kinematics::{KinematicsFile, Source};
use trackdyn::crates::recording::{OperatingPoints, Recording};

/// Options of `trackdyn identify`.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    driving: DrivingOptions,
    /// Vehicle file (schema trackdyn.vehicle/1), for its gauge
    #[arg(long, value_name = "FILE")]
    vehicle: PathBuf,
    /// Use only segments before which the tracks ran steadily for this many seconds
    #[arg(long, value_name = "SECONDS", value_parser = not_negative)]
    settle: Option<f64>,
    /// Fit these beside the ICRs, where the recording shows them: time-offset, sensor-yaw (lever-arm only says why no
    /// recording shows it)
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    fit: Vec<Nuisance>,
    /// Individuals of the genetic algorithm
    #[arg(long, value_name = "N", default_value_t = 100,
          value_parser = clap::value_parser!(u32).range(4..=100_000))]
    population: u32,
    /// Generations of the genetic algorithm
    #[arg(long, value_name = "N", default_value_t = 200,
          value_parser = clap::value_parser!(u32).range(1..=100_000))]
    generations: u32,
    /// Seed of the genetic algorithm
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Folder for identification.toml, kinematics.toml and kinematics_alpha.toml
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
}

impl Options {
    /// What to fit beside, each once.
    fn nuisances(&self) -> Vec<Nuisance> {
        let mut nuisances = self.fit.clone();
        nuisances.sort_unstable();
        nuisances.dedup();
        nuisances
    }

    /// The options given that steady points have nothing to say to.
    fn of_motion(&self) -> Vec<&'static str> {
        let mut given = self.driving.given();
        let own = [("--settle", self.settle.is_some()), ("--fit", !self.fit.is_empty())];
        given.extend(own.into_iter().filter_map(|(name, given)| given.then_some(name)));
        given
    }
}

/// Identifies the parameters, prints them side by side and writes what the recording determines.
pub fn run(options: &Options) -> Outcome {
    let vehicle = read_vehicle(&options.vehicle)?;
    if let Some(table) = OperatingPoints::file_of(options.driving.path()) {
        return points::run(&table, &vehicle, options);
    }
    let whole = options.driving.recording()?;
    let recording = options.driving.part(&whole)?;
    prepare_folder(&options.out)?;
    let genetic = GeneticOptions {
        population: options.population as usize,
        generations: options.generations as usize,
        seed: options.seed,
        ..GeneticOptions::default()
    };
    let gauge = vehicle.vehicle.gauge;
    let progress = Progress::new(2 * genetic.generations);
    let identify_options = identification::Options {
        gauge,
        tau: options.driving.tau,
        settle: options.settle,
        nuisances: options.nuisances(),
        genetic,
    };
    let found = identify(&recording, &identify_options, &|_| progress.advance(1));
    progress.finish();
    let found = found.map_err(|error| format!("{}: {error}", options.driving.path().display()))?;

    let source = source(&recording, &vehicle, options);
    let document = document::text(&recording, &vehicle, &source, &found)?;
    let path = options.out.join("identification.toml");
    write_file(&path, document.as_bytes())?;
    say(format_args!("wrote {}", path.display()));
    if identify_options.nuisances.contains(&Nuisance::SensorYaw) {
        say(format_args!(
            "note: no kinematics file holds the yaw of the sensor's mount: before odometry and export with these \
             parameters, turn the sensor by it, or the frame of the poses"
        ));
    }
    let files = found.fits.iter().map(|fit| file(fit, gauge, &source));
    let exit = keep(&options.out, files)?;
    show(&summary::text(&recording, &vehicle.vehicle, &found))?;
    Ok(exit)
}

/// Writes the files of the fits that are determined. That of an earlier fit goes where this one is not: it would be taken for
/// this one's. A map's stays.
fn keep(out: &Path, files: impl IntoIterator<Item = Option<KinematicsFile>>) -> Outcome {
    let mut written = 0;
    for (file, name) in files.into_iter().zip(document::FILES) {
        let path = out.join(name);
        if let Some(file) = file {
            write_file(&path, file.to_toml().as_bytes())?;
            say(format_args!("wrote {}", path.display()));
            written += 1;
        } else {
            remove_earlier(&path, |source| source.recording.is_some())?;
            if path.exists() {
                say(format_args!("note: {} is not of this recording, and stays", path.display()));
            }
        }
    }
    Ok(if written > 0 { Exit::Done } else { Exit::NoResult })
}

/// Where the numbers come from.
fn source(recording: &Recording, vehicle: &VehicleFile, options: &Options) -> Source {
    Source {
        command: command_line(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        vehicle: vehicle.vehicle.name.clone(),
        fingerprint: recording.fingerprint().to_owned(),
        pose_fingerprint: Some(recording.pose_fingerprint().to_owned()),
        recording: Some(recording.name().to_owned()),
        runs: Some(recording.run_list().to_string()),
        time_s: options.driving.time(),
        seed: Some(options.seed),
        ..Source::default()
    }
}

/// The file of a fit, where the recording determines it.
fn file(fit: &Fit, gauge: f64, source: &Source) -> Option<KinematicsFile> {
    let estimate = fit.least_squares.as_ref().ok().filter(|_| fit.doubts.is_empty())?;
    let rows = estimate.covariance_of_parameters();
    let with_alphas = fit.free == Free::IcrsAndAlphas;
    let kinematics = estimate.parameters.kinematics();
    Some(KinematicsFile::of_fit(&kinematics, gauge, with_alphas, rows, source.clone()))
}
