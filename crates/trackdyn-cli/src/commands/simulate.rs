//! `trackdyn simulate`: a drive in time over a ground with effects, as a recording.

mod ground;
mod summary;

use crate::commands::Outcome;
use crate::exit::Exit;
use crate::folder::prepare_folder;
use crate::options::{ModelOptions, PlaceOptions, count, finite};
use crate::progress::Progress;
use crate::provenance::provenance;
use crate::stderr::{note, say};
use crate::stdout::show;
use clap::{Args, ValueEnum};
use ground::Independent;
use std::path::PathBuf;
use trackdyn::SimulateSettings;
use trackdyn::simulate::{Driving, Prepared, refuse_other, sensors};
use trackdyn_second_simulator::ActiveMechanism;

/// Options of `trackdyn simulate`.
#[derive(Args)]
pub struct Options {
    /// What the tracks do: manual, validation, designed, square, or a file t,v_left,v_right
    #[arg(long, value_name = "NAME|FILE", default_value_t = Driving::default().to_string())]
    schedule: String,
    /// Runs of a schedule that is generated [default: what is usual for it]
    #[arg(long = "run-count", alias = "runs", value_name = "N", value_parser = count)]
    runs: Option<usize>,
    /// Time of each run of a schedule that is generated, s, with a second at rest before and after:
    /// a square or a plan that has begun is driven to its end [default: as long as the schedule
    /// takes]
    #[arg(long, value_name = "SECONDS", value_parser = finite)]
    duration: Option<f64>,
    /// Largest track speed of a schedule that is generated, m/s [default: 1]
    #[arg(long, value_name = "SPEED", value_parser = finite)]
    fastest: Option<f64>,
    /// Sensors: perfect, laboratory, field, or a file (schema trackdyn.sensors/1)
    #[arg(long, value_name = "NAME|FILE",
          default_value_t = SimulateSettings::default().sensors.name)]
    sensors: String,
    /// Leave inertia out: the robot is at its stationary motion at once
    #[arg(long)]
    quasi_static: bool,
    /// Which simulator moves the robot: the project's own, or the independent one of proofs, which
    /// shares no code with it
    #[arg(long, value_enum, default_value_t = Ground::Own)]
    ground: Ground,
    /// Independent ground: a mechanism of it, those outside the catalogue of effects among them
    /// (listed in docs/trials/forms.md); repeatable
    #[arg(long = "mechanism", value_name = "ID[:PARAMETER=VALUE,...]")]
    mechanisms: Vec<ActiveMechanism>,
    /// Longest step of the integration, s
    #[arg(long, value_name = "SECONDS", value_parser = step,
          default_value_t = SimulateSettings::default().longest_step)]
    step: f64,
    /// Seed of schedules and noise
    #[arg(long, value_name = "N", default_value_t = SimulateSettings::default().seed)]
    seed: u64,
    /// Folder for the recording, the true motion (truth.csv) and what it was made from
    #[arg(long, value_name = "DIR", default_value = "out/recording")]
    out: PathBuf,
    #[command(flatten)]
    model: ModelOptions,
    #[command(flatten)]
    place: PlaceOptions,
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
    let vehicle = options.model.vehicle()?;
    if options.ground == Ground::Own && !options.mechanisms.is_empty() {
        return Err("--mechanism: expected with --ground independent only; the effects of the \
                    project's own simulator are switched on by --effect"
            .into());
    }
    let settings = settings(options)?;
    let prepared = Prepared::new(&vehicle, &settings)?;
    refuse_other(&options.out)?;
    prepare_folder(&options.out)?;
    let simulation = Progress::over(|observer| match options.ground {
        Ground::Own => prepared.run(observer),
        Ground::Independent => {
            let ground = Independent::new(prepared.vehicle(), &settings, &options.mechanisms);
            prepared.run_on(&ground, observer)
        }
    })?;
    for warning in simulation.recording.warnings() {
        note(format_args!("{warning}"));
    }
    simulation.write(&options.out, &provenance())?;
    show(&summary::text(&simulation, &options.mechanisms))?;
    say(format_args!(
        "wrote the recording, truth.csv and simulation.toml to {}",
        options.out.display()
    ));
    Ok(Exit::Done)
}

fn settings(options: &Options) -> Result<SimulateSettings, trackdyn::Error> {
    Ok(SimulateSettings {
        sensors: sensors(&options.sensors)?,
        driving: options.schedule.parse()?,
        runs: options.runs,
        duration: options.duration,
        fastest: options.fastest,
        start: options.place.pose(),
        inertia: !options.quasi_static,
        longest_step: options.step,
        seed: options.seed,
    })
}

/// A step that an integration can take.
pub fn step(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(step) if (1e-5..=0.1).contains(&step) => Ok(step),
        _ => Err("expected a time between 0.00001 and 0.1 s".to_owned()),
    }
}
