//! `trackdyn diagnose`: where model and recording differ, and what was left out.

mod report;
mod summary;

use crate::commands::Outcome;
use crate::exit::Exit;
use crate::options::{RecordingOptions, command_line, read_vehicle, refuse_for_points};
use crate::progress::Progress;
use crate::stderr::say;
use crate::stdout::show;
use clap::Args;
use std::path::PathBuf;
use trackdyn::crates::core::output::{fingerprint, prepare_folder, write_file};
use trackdyn::crates::diagnose::diagnosis::STAGES;
use trackdyn::crates::diagnose::{Diagnosis, DiagnosisFile, Evidence, diagnose};
use trackdyn::crates::model::VehicleFile;
use trackdyn::crates::model::kinematics::Source;
use trackdyn::crates::recording::{OperatingPoints, Recording, RunList};

/// Options of `trackdyn diagnose`.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    recording: RecordingOptions,
    /// More recordings of the same robot
    more: Vec<PathBuf>,
    /// Vehicle file (schema trackdyn.vehicle/1); its effects are part of the model, and what its *_sd say is
    /// taken as known
    #[arg(long, value_name = "FILE")]
    vehicle: PathBuf,
    /// Runs to judge the result on, which nothing is fitted or chosen on: a list such as 9-11, or `none`
    /// [default: every fourth run where there are eight or more, every fourth point of a table]
    #[arg(long, value_name = "RUNS|none")]
    held_out: Option<String>,
    /// Draws of the bootstrap behind the tests
    #[arg(long, value_name = "N", default_value_t = 2000,
          value_parser = clap::value_parser!(u32).range(1000..=100_000))]
    draws: u32,
    /// Seed of the bootstrap
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Folder for diagnosis.toml, vehicle.corrected.toml, report.html and the figures
    #[arg(long, value_name = "DIR", default_value = "out/diagnosis")]
    out: PathBuf,
}

/// What is diagnosed, and where it comes from.
struct Subject {
    name: String,
    fingerprint: String,
    runs: Option<String>,
    evidence: Evidence,
    held_out: Vec<usize>,
}

/// Diagnoses, prints the answer in one screen and writes it.
pub fn run(options: &Options) -> Outcome {
    let vehicle = read_vehicle(&options.vehicle)?;
    let subject = subject(options, &vehicle)?;
    prepare_folder(&options.out)?;
    let progress = Progress::new(2 * STAGES.len());
    let settings = trackdyn::crates::diagnose::Options {
        held_out: subject.held_out.clone(),
        draws: options.draws as usize,
        seed: options.seed,
    };
    let diagnosis = diagnose(&subject.evidence, &vehicle, &settings, &|_| progress.advance(1))
        .map_err(|error| about(options, &error))?;
    progress.finish();
    write(&diagnosis, &subject, &vehicle, options)?;
    show(&summary::text(&diagnosis, &subject.evidence, &subject.name))?;
    Ok(Exit::Done)
}

fn write(
    diagnosis: &Diagnosis,
    subject: &Subject,
    vehicle: &VehicleFile,
    options: &Options,
) -> Result<(), Box<dyn std::error::Error>> {
    let source = Source {
        command: command_line(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        vehicle: vehicle.vehicle.name.clone(),
        fingerprint: subject.fingerprint.clone(),
        recording: Some(subject.name.clone()),
        runs: subject.runs.clone(),
        seed: Some(options.seed),
        ..Source::default()
    };
    let file = DiagnosisFile::new(diagnosis, &source);
    let head = format!(
        "{} as a diagnosis of {} corrects it (trackdyn {}, vehicle {}, recording {}).",
        vehicle.vehicle.name,
        subject.name,
        env!("CARGO_PKG_VERSION"),
        fingerprint(vehicle.to_toml().as_bytes()),
        subject.fingerprint,
    );
    // a name may hold a line break, which would end the comment
    let head = head.replace(char::is_control, " ");
    let corrected = format!("# {head}\n{}", diagnosis.corrected.to_toml());
    for (name, text) in [("diagnosis.toml", file.to_toml()), ("vehicle.corrected.toml", corrected)]
    {
        let path = options.out.join(name);
        write_file(&path, text.as_bytes())?;
        say(format_args!("wrote {}", path.display()));
    }
    report::write(diagnosis, subject, vehicle, &file, &options.out)
}

fn subject(
    options: &Options,
    vehicle: &VehicleFile,
) -> Result<Subject, Box<dyn std::error::Error>> {
    if let Some(table) = OperatingPoints::file_of(&options.recording.recording) {
        if !options.more.is_empty() {
            return Err("a table of steady points is diagnosed alone: expected one".into());
        }
        refuse_for_points(&options.recording.given(), &table)?;
        let held_out = options.held_out.as_deref();
        if let Some(list) = held_out.filter(|list| *list != "none") {
            return Err(format!(
                "--held-out {list}: a table of steady points has no runs: expected none"
            )
            .into());
        }
        let points = OperatingPoints::read(&table)?;
        let evidence =
            Evidence::of_points(&points.points).map_err(|error| about(options, &error))?;
        let held_out = every_fourth(evidence.runs().len(), held_out.is_some());
        let read = std::fs::read(&table);
        let read = read.map_err(|cause| format!("{}: {cause}", table.display()))?;
        let fingerprint = fingerprint(&read);
        return Ok(Subject { name: points.name, fingerprint, runs: None, evidence, held_out });
    }
    let mut recordings = vec![options.recording.read()?];
    for path in &options.more {
        let next = options.recording.read_path(path)?;
        if recordings.iter().any(|other| other.fingerprint() == next.fingerprint()) {
            let name = path.display();
            return Err(format!(
                "{name}: expected each recording once: its runs count as evidence of their own"
            )
            .into());
        }
        recordings.push(next);
    }
    let recording = match recordings.as_slice() {
        [one] => one.clone(),
        several => Recording::joined(several)?,
    };
    let runs = recording.runs().len();
    let held_out = match options.held_out.as_deref() {
        None => every_fourth(runs, false),
        Some("none") => Vec::new(),
        Some(list) => {
            let list: RunList =
                list.parse().map_err(|error| format!("--held-out {list}: {error}"))?;
            recording.indices_of(&list).map_err(|error| format!("--held-out {list}: {error}"))?
        }
    };
    if held_out.len() == runs {
        return Err("--held-out: expected at least one run to fit".into());
    }
    let evidence = Evidence::of_recording(&recording, vehicle.vehicle.gauge)
        .map_err(|error| about(options, &error))?;
    Ok(Subject {
        name: recording.name().to_owned(),
        fingerprint: recording.fingerprint().to_owned(),
        runs: Some(recording.run_list().to_string()),
        evidence,
        held_out,
    })
}

/// Why a recording cannot be diagnosed, after its name.
fn about(options: &Options, error: &trackdyn::crates::diagnose::Error) -> String {
    format!("{}: {error}", options.recording.recording.display())
}

/// Every fourth of many runs.
fn every_fourth(runs: usize, none: bool) -> Vec<usize> {
    const MANY: usize = 8;
    if none || runs < MANY { Vec::new() } else { (3..runs).step_by(4).collect() }
}
