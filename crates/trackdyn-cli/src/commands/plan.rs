//! `trackdyn plan`: the driving that tells apart what a diagnosis could not.

mod summary;

use crate::changes::{say_removed, say_written};
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::options::finite;
use crate::progress::Progress;
use crate::provenance::provenance;
use crate::stderr::say;
use crate::stdout::show;
use clap::Args;
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
    /// Vehicle file that has what the diagnosis found [default: vehicle.corrected.toml beside the
    /// diagnosis]
    #[arg(long, value_name = "FILE")]
    vehicle: Option<PathBuf>,
    /// Largest track speed, m/s
    #[arg(long, value_name = "SPEED", default_value_t = 1.0, value_parser = speed)]
    fastest: f64,
    /// Time for all manoeuvres together, s
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0, value_parser = time)]
    duration: f64,
    /// Standard deviation of a pose along each axis, m
    #[arg(long, value_name = "M", default_value_t = 0.001, value_parser = noise)]
    noise_xy_m: f64,
    /// Standard deviation of the yaw of a pose, rad
    #[arg(long, value_name = "RAD", default_value_t = 0.001, value_parser = noise)]
    noise_yaw_rad: f64,
    /// Folder for plan.csv, a schedule for `simulate --schedule` and for the robot, and plan.toml
    #[arg(long, value_name = "DIR", default_value = "out/plan")]
    out: PathBuf,
}

/// Plans, prints what the plan separates, and writes it.
pub fn run(options: &Options) -> Outcome {
    let questions = OpenQuestions::open(&options.diagnosis)?;
    if questions.is_empty() {
        say_removed(&remove_earlier(&options.out)?);
        show("nothing to plan: the diagnosis leaves nothing open between several effects\n")?;
        return Ok(Exit::Done);
    }
    let vehicle = vehicle(options)?;
    let settings = PlanSettings {
        fastest: options.fastest,
        duration: options.duration,
        noise_xy: options.noise_xy_m,
        noise_yaw: options.noise_yaw_rad,
        method: questions.method().clone(),
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
    let changes = plan.write(&options.out, &provenance())?;
    say_written(&changes);
    show(&summary::text(plan.found()))?;
    if plan.schedule().is_none() {
        say_removed(&changes);
        say(format_args!("wrote nothing: there is nothing to drive"));
    }
    Ok(Exit::Done)
}

fn vehicle(options: &Options) -> Result<Vehicle, Box<dyn std::error::Error>> {
    match &options.vehicle {
        Some(path) => Ok(Vehicle::choose(path)?),
        None => Vehicle::open(corrected_beside(&options.diagnosis)).map_err(|error| {
            format!("{error}\nexpected beside the diagnosis, or --vehicle").into()
        }),
    }
}

/// A number within limits.
fn between(text: &str, low: f64, high: f64, unit: &str) -> Result<f64, String> {
    let expected = || format!("expected {low} to {high} {unit}");
    let value = finite(text).map_err(|_| expected())?;
    if (low..=high).contains(&value) { Ok(value) } else { Err(expected()) }
}

fn speed(text: &str) -> Result<f64, String> {
    between(text, 0.05, 10.0, "m/s")
}

fn time(text: &str) -> Result<f64, String> {
    between(text, 1.0, 3600.0, "s")
}

fn noise(text: &str) -> Result<f64, String> {
    between(text, 1e-6, 10.0, "m or rad")
}
