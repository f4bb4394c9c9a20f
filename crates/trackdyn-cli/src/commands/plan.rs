//! `trackdyn plan`: the driving that tells apart what a diagnosis could not.

mod summary;

use crate::commands::Outcome;
use crate::earlier::remove_of;
use crate::exit::Exit;
use crate::options::{command_line, finite, read_vehicle};
use crate::progress::Progress;
use crate::stderr::say;
use crate::stdout::show;
use clap::Args;
use std::path::PathBuf;
use trackdyn::crates::core::document::Document;
use trackdyn::crates::core::output::{fingerprint, prepare_folder, write_file};
use trackdyn::crates::diagnose::plan::{Options as PlanOptions, Question, STAGES};
use trackdyn::crates::diagnose::{Error, PlanFile, plan};
use trackdyn::crates::drive::schedules::{self, ScheduledRun};
use trackdyn::crates::model::VehicleFile;
use trackdyn::crates::model::kinematics::Source;

/// Options of `trackdyn plan`.
#[derive(Args)]
pub struct Options {
    /// Diagnosis file (schema trackdyn.diagnosis/1)
    #[arg(long, value_name = "FILE")]
    diagnosis: PathBuf,
    /// Vehicle file that has what the diagnosis found [default: vehicle.corrected.toml beside the diagnosis]
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

/// Removes the plan of an earlier run, where this one has none.
fn remove_earlier(options: &Options) -> Result<(), String> {
    let [plan, schedule] = ["plan.toml", "plan.csv"].map(|name| options.out.join(name));
    remove_of(&plan, [schedule, plan.clone()])
}

/// Plans, prints what the plan separates, and writes it.
pub fn run(options: &Options) -> Outcome {
    let document = Document::read(&options.diagnosis)?;
    let questions = Question::of(&document)?;
    if questions.is_empty() {
        remove_earlier(options)?;
        show("nothing to plan: the diagnosis leaves nothing open between several effects\n")?;
        return Ok(Exit::Done);
    }
    let vehicle = vehicle(options)?;
    let settings = PlanOptions {
        fastest: options.fastest,
        duration: options.duration,
        noise_xy: options.noise_xy_m,
        noise_yaw: options.noise_yaw_rad,
    };
    let progress = Progress::new(STAGES.len());
    let plan = plan(&questions, &vehicle, &settings, &|_| progress.advance(1));
    progress.finish();
    let plan = plan.map_err(|error| match error {
        Error::TooShort { .. } => format!("--duration: {error}"),
        _ => format!("{}: {error}", vehicle.vehicle.name),
    })?;
    let Some(schedule) = plan.schedule() else {
        show(&summary::text(&plan))?;
        remove_earlier(options)?;
        say(format_args!("wrote nothing: there is nothing to drive"));
        return Ok(Exit::Done);
    };
    let source = Source {
        command: command_line(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        vehicle: vehicle.vehicle.name.clone(),
        fingerprint: fingerprint(format!("{}{}", document.text(), vehicle.to_toml()).as_bytes()),
        ..Source::default()
    };
    prepare_folder(&options.out)?;
    let csv = schedules::text(&[ScheduledRun { id: 0, schedule }]);
    let toml = PlanFile::new(&plan, &settings, source).to_toml();
    for (name, text) in [("plan.csv", csv), ("plan.toml", toml)] {
        let path = options.out.join(name);
        write_file(&path, text.as_bytes())?;
        say(format_args!("wrote {}", path.display()));
    }
    show(&summary::text(&plan))?;
    Ok(Exit::Done)
}

fn vehicle(options: &Options) -> Result<VehicleFile, Box<dyn std::error::Error>> {
    match &options.vehicle {
        Some(path) => read_vehicle(path),
        None => read_vehicle(&options.diagnosis.with_file_name("vehicle.corrected.toml")).map_err(
            |error| format!("{error}\nexpected beside the diagnosis, or --vehicle").into(),
        ),
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
