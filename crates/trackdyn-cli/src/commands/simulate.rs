//! `trackdyn simulate`: a drive in time over a ground with effects, as a recording.

mod document;
mod ground;

use crate::commands::Outcome;
use crate::exit::Exit;
use crate::options::{ModelOptions, PlaceOptions, count, finite, in_time, model, of_drive};
use crate::progress::Progress;
use crate::stderr::say;
use crate::stdout::show;
use clap::{Args, ValueEnum};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use trackdyn::crates::core::output::{prepare_folder, write_file};
use trackdyn::crates::core::{PerSide, Trajectory};
use trackdyn::crates::drive::schedules::{
    self, ScheduleKind, ScheduleOptions, ScheduledRun, as_commanded,
};
use trackdyn::crates::drive::sensors::{Preset, Sensors, Views};
use trackdyn::crates::drive::truth;
use trackdyn::crates::model::{Circumstance, Model, VehicleFile};
use trackdyn::crates::model::{Stationary, Transient};
use trackdyn::crates::recording::{Recording, Source, UncheckedRun, folder};
use trackdyn_second_simulator::ActiveMechanism;

/// Options of `trackdyn simulate`.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    #[command(flatten)]
    place: PlaceOptions,
    /// What the tracks do: manual, validation, designed, square, or a file t,v_left,v_right
    #[arg(long, value_name = "NAME|FILE", default_value = "manual")]
    schedule: String,
    /// Runs of a schedule that is generated [default: what is usual for it]
    #[arg(long, value_name = "N", value_parser = count)]
    runs: Option<usize>,
    /// Time of each run of a schedule that is generated, s, with a second at rest before and after: a square or a plan that has
    /// begun is driven to its end [default: as long as the schedule takes]
    #[arg(long, value_name = "SECONDS", value_parser = finite)]
    duration: Option<f64>,
    /// Largest track speed of a schedule that is generated, m/s [default: 1]
    #[arg(long, value_name = "SPEED", value_parser = finite)]
    fastest: Option<f64>,
    /// Sensors: perfect, laboratory, field, or a file (schema trackdyn.sensors/1)
    #[arg(long, value_name = "NAME|FILE", default_value = "laboratory")]
    sensors: String,
    /// Leave inertia out: the robot is at its stationary motion at once
    #[arg(long)]
    quasi_static: bool,
    /// Which simulator moves the robot: the project's own, or the independent one of proofs, which shares
    /// no code with it
    #[arg(long, value_enum, default_value_t = Ground::Own)]
    ground: Ground,
    /// Independent ground: a mechanism of it, those outside the catalogue of effects among them (listed in
    /// docs/theory/independent-ground.md); repeatable
    #[arg(long = "mechanism", value_name = "ID[:PARAMETER=VALUE,...]")]
    mechanisms: Vec<ActiveMechanism>,
    /// Longest step of the integration, s
    #[arg(long, value_name = "SECONDS", default_value_t = Transient::STEP, value_parser = step)]
    step: f64,
    /// Seed of schedules and noise
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Folder for the recording, the true motion (truth.csv) and what it was made from
    #[arg(long, value_name = "DIR", default_value = "out/recording")]
    out: PathBuf,
}

/// Which simulator moves the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Ground {
    /// The laws of the catalogue
    Own,
    /// Shoes on springs, with laws of their own under the same names
    Independent,
}

/// Simulates, prints what was driven and writes the recording.
pub fn run(options: &Options) -> Outcome {
    let mut file = options.model.vehicle_file()?;
    file.effects = in_time(file.effects, options.quasi_static);
    if options.ground == Ground::Own && !options.mechanisms.is_empty() {
        return Err("--mechanism: expected with --ground independent only; the effects of the \
                    project's own simulator are switched on by --effect"
            .into());
    }
    let sensors = sensors(&options.sensors)?;
    let model = model(&file);
    let schedules = scheduled(options, &model)?;
    refuse_other(&options.out)?;
    prepare_folder(&options.out)?;

    // Laws that know the time begin where the recording begins, whatever its clock shows.
    let starts = schedules.iter().map(|run| run.schedule.span()[0]);
    let origin = starts.fold(f64::INFINITY, f64::min).floor();
    let progress = Progress::new(schedules.len());
    let runs: Vec<Result<Driven, String>> = schedules
        .par_iter()
        .map(|run| {
            let driven = Driven::new(&file, &model, run, origin, options, &sensors);
            progress.advance(1);
            driven
        })
        .collect();
    progress.finish();
    // of several errors that of the first run, on any number of threads
    let runs: Vec<Driven> = runs.into_iter().collect::<Result<_, _>>()?;

    let name = format!("simulated {}", file.vehicle.name);
    let observed = runs.iter().map(|run| run.observed.clone()).collect();
    let recording =
        Recording::new(name, &file.vehicle.name, observed, Source::computed(), Vec::new())?;
    for warning in recording.warnings() {
        say(format_args!("note: {warning}"));
    }
    // It comes first: it says that all others may be replaced.
    let text = document::text(&file, &sensors, &recording, options)?;
    write_file(&options.out.join("simulation.toml"), text.as_bytes())?;
    truth::write(&options.out, runs.iter().map(|run| (run.id, &run.path)))?;
    schedules::write(&options.out.join("schedule.csv"), &schedules)?;
    write_file(&options.out.join("vehicle.toml"), file.to_toml().as_bytes())?;
    write_file(&options.out.join("sensors.toml"), sensors.to_toml().as_bytes())?;
    folder::write(&recording, &options.out)?;
    show(&document::summary(&file, &sensors, &recording, &runs, options))?;
    say(format_args!(
        "wrote the recording, truth.csv and simulation.toml to {}",
        options.out.display()
    ));
    Ok(Exit::Done)
}

/// What no simulation wrote, be it a recording or the vehicle's own file, is not replaced.
fn refuse_other(out: &Path) -> Result<(), String> {
    const WRITTEN: [&str; 8] = [
        "recording.toml",
        "tracks.csv",
        "poses.csv",
        "imu.csv",
        "truth.csv",
        "vehicle.toml",
        "sensors.toml",
        "schedule.csv",
    ];
    let is_there = |name: &&str| out.join(name).exists();
    match WRITTEN.into_iter().find(is_there).filter(|_| !is_there(&"simulation.toml")) {
        Some(name) => Err(format!(
            "--out {}: holds a {name} that was not simulated: expected another folder",
            out.display()
        )),
        None => Ok(()),
    }
}

/// One run, driven and seen.
pub struct Driven {
    id: i64,
    path: Trajectory,
    observed: UncheckedRun,
}

impl Driven {
    fn new(
        file: &VehicleFile,
        model: &Model,
        run: &ScheduledRun,
        origin: f64,
        options: &Options,
        sensors: &Sensors,
    ) -> Result<Self, String> {
        let ScheduledRun { id, schedule } = run;
        let from_origin = schedule.clone().later(-origin);
        let motion = match options.ground {
            Ground::Own => ground::own(model, &from_origin, options),
            Ground::Independent => ground::independent(file, &from_origin, options),
        };
        let (path, poses) = motion.map_err(|error| format!("run {id}: {error}"))?;
        let (path, poses) = (path.later(origin), poses.later(origin));
        let encoders = as_commanded(schedule, &path);
        let views = Views { encoders: &encoders, body: &path, poses: &poses };
        let observed = sensors
            .observe_views(*id, &views, options.seed)
            .map_err(|error| format!("run {id}: {error}"))?;
        Ok(Self { id: *id, path, observed })
    }

    /// Length of the path, m.
    fn length(&self) -> f64 {
        self.path
            .moments()
            .windows(2)
            .map(|pair| (pair[1].pose.x - pair[0].pose.x).hypot(pair[1].pose.y - pair[0].pose.y))
            .sum()
    }
}

/// The schedules of a name, or of a file, for which there is nothing to generate.
fn scheduled(
    options: &Options,
    model: &Model,
) -> Result<Vec<ScheduledRun>, Box<dyn std::error::Error>> {
    let given = [
        ("--runs", options.runs.is_some()),
        ("--duration", options.duration.is_some()),
        ("--fastest", options.fastest.is_some()),
    ];
    if options.schedule.parse::<ScheduleKind>().is_err()
        && Path::new(&options.schedule).exists()
        && let Some((name, _)) = given.into_iter().find(|(_, given)| *given)
    {
        let file = &options.schedule;
        return Err(
            format!("{name}: {file} says it: expected with a schedule that is generated").into()
        );
    }
    let usual = ScheduleOptions::default();
    let fastest = options.fastest.unwrap_or(usual.fastest);
    // Turns of squares are measured by the ICRs of this very robot.
    let spin = PerSide::new(-fastest / 2.0, fastest / 2.0);
    let icrs = Stationary::new(model, &Circumstance::default()).solve(spin).icrs;
    let icr_distance = icrs.map_or(usual.icr_distance, |icrs| icrs.x_right - icrs.x_left);
    let (runs, seed, duration) = (options.runs, options.seed, options.duration);
    let schedule = ScheduleOptions { runs, seed, fastest, duration, icr_distance, ..usual };
    Ok(schedules::load(&options.schedule, &schedule).map_err(|error| of_drive(&error))?)
}

/// The sensors of a name or a file.
pub fn sensors(choice: &str) -> Result<Sensors, Box<dyn std::error::Error>> {
    match Preset::named(choice) {
        Some(preset) => Ok(preset.sensors()),
        None if Path::new(choice).exists() => Ok(Sensors::read(Path::new(choice))?),
        None => {
            let names = Preset::ALL.map(Preset::name).join(", ");
            Err(format!("--sensors {choice}: expected {names} or a file that exists").into())
        }
    }
}

/// A step that an integration can take.
pub fn step(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(step) if (1e-5..=0.1).contains(&step) => Ok(step),
        _ => Err("expected a time between 0.00001 and 0.1 s".to_owned()),
    }
}
