//! `trackdyn plan`: the driving that tells apart what a diagnosis could not.

mod next;
mod summary;

use crate::changes::{say_removed, say_written};
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::folder::prepare_folder;
use crate::options::within;
use crate::progress::Progress;
use crate::provenance::provenance;
use crate::stderr::say;
use crate::stdout::show;
use crate::wrapped::wrapped;
use clap::Args;
use next::Place;
use std::path::PathBuf;
use trackdyn::crates::diagnose;
use trackdyn::diagnose::corrected_beside;
use trackdyn::plan::remove_earlier;
use trackdyn::{Error, OpenQuestions, Plan, PlanSettings, Vehicle};

/// Options of `trackdyn plan`.
#[derive(Args)]
pub struct Options {
    /// Diagnosis file (schema trackdyn.diagnosis/1)
    #[arg(long, value_name = "FILE")]
    diagnosis: PathBuf,
    /// Vehicle that has what the diagnosis found [default: vehicle.corrected.toml beside the
    /// diagnosis]
    #[arg(long, value_name = "FILE|NAME")]
    vehicle: Option<PathBuf>,
    /// Largest track speed, m/s
    #[arg(long, value_name = "SPEED", default_value_t = PlanSettings::default().fastest,
          value_parser = speed)]
    fastest: f64,
    /// Time for all manoeuvres together, s
    #[arg(long, value_name = "SECONDS", default_value_t = PlanSettings::default().duration,
          value_parser = time)]
    duration: f64,
    /// Standard deviation of a pose along each axis, m [default: as the diagnosis measured it, else
    /// 0.001]
    #[arg(long, value_name = "M", alias = "noise-xy-m", value_parser = noise)]
    noise_xy: Option<f64>,
    /// Standard deviation of the yaw of a pose, rad [default: as the diagnosis measured it, else
    /// 0.001]
    #[arg(long, value_name = "RAD", alias = "noise-yaw-rad", value_parser = noise)]
    noise_yaw: Option<f64>,
    /// Folder for plan.csv, a schedule for `simulate --schedule` and for the robot, and plan.toml
    #[arg(long, value_name = "DIR", default_value = "out/plan")]
    out: PathBuf,
}

/// Plans, prints what the plan separates, and writes it.
pub fn run(options: &Options) -> Outcome {
    let questions = OpenQuestions::open(&options.diagnosis)?;
    if questions.is_empty() {
        say_removed(&remove_earlier(&options.out)?);
        let name = questions.vehicle().unwrap_or("vehicle not told by the diagnosis");
        show(&wrapped(
            "",
            &format!(
                "nothing to plan: the diagnosis leaves nothing open between several effects; {name}"
            ),
        ))?;
        return Ok(Exit::Done);
    }
    let vehicle = vehicle(options)?;
    let settings = PlanSettings {
        fastest: options.fastest,
        duration: options.duration,
        noise_xy: options.noise_xy,
        noise_yaw: options.noise_yaw,
    };
    let plan = Progress::over(|observer| Plan::new(&questions, &vehicle, &settings, observer));
    let plan = plan.map_err(|error| -> Box<dyn std::error::Error> {
        match error {
            Error::Plan { cause: cause @ diagnose::Error::TooShort { .. }, .. } => {
                format!("--duration: {cause}").into()
            }
            other => other.into(),
        }
    })?;
    if plan.schedule().is_some() {
        prepare_folder(&options.out)?;
    }
    let changes = plan.write(&options.out, &provenance())?;
    say_written(&changes);
    let place = Place {
        diagnosis: &options.diagnosis,
        vehicle: &options.vehicle_file(),
        out: &options.out,
    };
    let text = summary::text(&plan);
    show(&(text + &next::text(&plan, &questions, &place)))?;
    if plan.schedule().is_none() {
        say_removed(&changes);
        say(format_args!("wrote nothing: there is nothing to drive"));
    }
    Ok(Exit::Done)
}

impl Options {
    /// The vehicle as an argument.
    fn vehicle_file(&self) -> PathBuf {
        let beside = || corrected_beside(&self.diagnosis);
        self.vehicle.clone().unwrap_or_else(beside)
    }
}

fn vehicle(options: &Options) -> Result<Vehicle, Box<dyn std::error::Error>> {
    match &options.vehicle {
        Some(path) => Ok(Vehicle::choose(path)?),
        None => Vehicle::open(corrected_beside(&options.diagnosis)).map_err(|error| {
            format!("{error}\nexpected beside the diagnosis, or --vehicle").into()
        }),
    }
}

fn speed(text: &str) -> Result<f64, String> {
    within(text, PlanSettings::SPEED_LIMITS)
}

fn time(text: &str) -> Result<f64, String> {
    within(text, PlanSettings::DURATION_LIMITS)
}

fn noise(text: &str) -> Result<f64, String> {
    within(text, PlanSettings::NOISE_LIMITS)
}
