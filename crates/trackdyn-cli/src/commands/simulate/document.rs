//! What a simulated recording was made from, and its summary.

use super::{Driven, Options};
use crate::tables::Head;
use serde::Serialize;
use std::fmt::Write;
use trackdyn::crates::core::output::fingerprint;
use trackdyn::crates::drive::Sensors;
use trackdyn::crates::model::VehicleFile;
use trackdyn::crates::recording::Recording;

#[derive(Serialize)]
struct File<'a> {
    #[serde(flatten)]
    head: Head<'a>,
    ground: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    mechanisms: Vec<String>,
    sensors: &'a str,
    sensors_fingerprint: String,
    schedule: &'a str,
    seed: u64,
    longest_step_s: f64,
    recording_fingerprint: &'a str,
}

/// The text of `simulation.toml`.
pub fn text(
    file: &VehicleFile,
    sensors: &Sensors,
    recording: &Recording,
    options: &Options,
) -> Result<String, toml::ser::Error> {
    toml::to_string(&File {
        head: Head::new("trackdyn.simulation/1", file),
        ground: format!("{:?}", options.ground).to_lowercase(),
        mechanisms: options.mechanisms.iter().map(ToString::to_string).collect(),
        sensors: &sensors.name,
        sensors_fingerprint: fingerprint(sensors.to_toml().as_bytes()),
        schedule: &options.schedule,
        seed: options.seed,
        longest_step_s: options.step,
        recording_fingerprint: recording.fingerprint(),
    })
}

/// What the user sees.
pub fn summary(
    file: &VehicleFile,
    sensors: &Sensors,
    recording: &Recording,
    runs: &[Driven],
    options: &Options,
) -> String {
    let mut text = format!("{}, sensors: {}\n", file.vehicle.name, sensors.name);
    let effects: Vec<String> = file.effects.iter().map(ToString::to_string).collect();
    let effects = if effects.is_empty() { "none".to_owned() } else { effects.join("\n          ") };
    let _ = writeln!(text, "effects   {effects}");
    for mechanism in &options.mechanisms {
        let _ = writeln!(text, "ground    {mechanism}");
    }
    text.push('\n');
    let _ = writeln!(text, "run      time     path  readings  poses");
    // runs without readings are none of the recording's
    let of = |id| runs.iter().find(|driven| driven.id == id);
    for (run, driven) in recording.runs().iter().filter_map(|run| Some((run, of(run.id())?))) {
        let _ = writeln!(
            text,
            "{:3}  {:6.1} s  {:5.1} m  {:8}  {:5}",
            run.id(),
            run.duration(),
            driven.length(),
            run.tracks().len(),
            run.poses().len()
        );
    }
    text
}
