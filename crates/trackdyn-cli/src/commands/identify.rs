//! `trackdyn identify`: kinematic parameters from a recording.

mod points;
mod summary;

pub use points::lagging_points;

use crate::changes::{say_undetermined, say_written};
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::folder::prepare_folder;
use crate::options::{DrivingOptions, GaugeOptions, count_within, refuse_for_points, within};
use crate::progress::Progress;
use crate::provenance::provenance;
use crate::stderr::note;
use crate::stdout::show;
use crate::wrapped::wrapped;
use clap::{ArgGroup, Args};
use std::path::PathBuf;
use trackdyn::crates::estimate::{GeneticOptions, Nuisance};
use trackdyn::identify::{Prepared, refuse_other};
use trackdyn::{Identification, IdentifySettings};

/// Heading of options in the help.
const GENETIC: &str = "Genetic algorithm";

/// Options of `trackdyn identify`.
#[derive(Args)]
#[command(group(ArgGroup::new("known").required(true).args(["vehicle", "gauge"])))]
pub struct Options {
    /// Use only segments before which the tracks ran steadily for this many seconds
    #[arg(long, value_name = "SECONDS", value_parser = settle)]
    settle: Option<f64>,
    /// Fit these beside the ICRs, where the recording shows them: time-offset, sensor-yaw
    /// (lever-arm only says why no recording shows it)
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    fit: Vec<Nuisance>,
    /// Correct the yaw of the poses by the recording's gyroscope
    #[arg(long)]
    gyroscope: bool,
    /// Individuals of the genetic algorithm
    #[arg(long, help_heading = GENETIC, value_name = "N",
          default_value_t = GeneticOptions::default().population, value_parser = population)]
    population: usize,
    /// Generations of the genetic algorithm
    #[arg(long, help_heading = GENETIC, value_name = "N",
          default_value_t = GeneticOptions::default().generations, value_parser = generations)]
    generations: usize,
    /// Seed of the genetic algorithm
    #[arg(long, help_heading = GENETIC, value_name = "N",
          default_value_t = GeneticOptions::default().seed)]
    seed: u64,
    /// Write parameters that other parts of the answer contradict as well, marked as doubtful
    #[arg(long)]
    force: bool,
    /// Folder for identification.toml, kinematics.toml and kinematics_alpha.toml
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    #[command(flatten)]
    driving: DrivingOptions,
    #[command(flatten)]
    gauge: GaugeOptions,
}

impl Options {
    fn settings(&self) -> IdentifySettings {
        IdentifySettings {
            tau: self.driving.tau,
            settle: self.settle,
            nuisances: self.fit.clone(),
            gyroscope: self.gyroscope,
            force: self.force,
            genetic: GeneticOptions {
                population: self.population,
                generations: self.generations,
                seed: self.seed,
                ..GeneticOptions::default()
            },
        }
    }

    /// The options given that steady points have nothing to say to.
    fn of_motion(&self) -> Vec<String> {
        let mut given = self.driving.given();
        let own = [
            ("--settle", self.settle.is_some()),
            ("--fit", !self.fit.is_empty()),
            ("--gyroscope", self.gyroscope),
        ];
        given.extend(own.into_iter().filter(|(_, given)| *given).map(|(name, _)| name.to_owned()));
        given
    }
}

fn settle(text: &str) -> Result<f64, String> {
    within(text, IdentifySettings::SETTLE_LIMITS)
}

fn population(text: &str) -> Result<usize, String> {
    count_within(text, IdentifySettings::POPULATION_LIMITS)
}

fn generations(text: &str) -> Result<usize, String> {
    count_within(text, IdentifySettings::GENERATIONS_LIMITS)
}

/// Identifies the parameters, prints them side by side and writes what the recording determines.
pub fn run(options: &Options) -> Outcome {
    let gauge = options.gauge.expect_gauge()?;
    refuse_for_points(&options.of_motion(), options.driving.path())?;
    let recording = options.driving.recording()?.part(&options.driving.part())?;
    refuse_other(&options.out)?;
    prepare_folder(&options.out)?;
    let settings = options.settings();
    let prepared = Prepared::new(&recording, &gauge, &settings)?;
    let found = Progress::over(|observer| prepared.run(observer))?;
    let changes = found.write(&options.out, &provenance())?;
    say_written(&changes);
    say_undetermined(&changes);
    if settings.nuisances.contains(&Nuisance::SensorYaw) {
        note(format_args!(
            "no kinematics file holds the yaw of the sensor's mount: before odometry and \
             export with these parameters, turn the sensor by it, or the frame of the poses"
        ));
    }
    show(&match &found {
        Identification::Motion(fit) => summary::text(&recording, &gauge, fit),
        Identification::Points(fit) => points::text(&recording, &gauge, fit),
        Identification::Turning(fit) => summary::turning(&recording, &gauge, fit),
    })?;
    if let Identification::Motion(fit) = &found
        && let Some(ratio) = fit.found.beyond_noise()
    {
        note(format_args!(
            "residuals are {ratio:.0} times the noise: constant ICRs do not describe all of this \
             drive, or a part of the log is wrong. The intervals allow for both; trackdyn inspect \
             shows where, and trackdyn diagnose which physics is missing"
        ));
    }
    if let Some(separation) = found.separation(&provenance()) {
        show(&summary::separation(&separation))?;
    }
    if let Some(reason) = found.reason_without_separation().filter(|_| !found.is_determined()) {
        show(&wrapped("  turning alone: ", &reason))?;
    }
    Ok(if found.is_determined() { Exit::Done } else { Exit::NoResult })
}
