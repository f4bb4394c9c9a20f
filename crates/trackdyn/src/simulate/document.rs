//! What a simulated recording was made from, schema `trackdyn.simulation/1`.

use super::Simulation;
use crate::Provenance;
use crate::document::{Head, to_toml};
use serde::Serialize;
use trackdyn_core::output::fingerprint;

#[derive(Serialize)]
struct File<'a> {
    #[serde(flatten)]
    head: Head<'a>,
    ground: &'a str,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    mechanisms: &'a [String],
    sensors: &'a str,
    sensors_fingerprint: String,
    schedule: String,
    seed: u64,
    longest_step_s: f64,
    recording_fingerprint: &'a str,
}

/// The text of `simulation.toml`.
pub(super) fn text(simulation: &Simulation, provenance: &Provenance) -> String {
    let settings = &simulation.made_from.settings;
    to_toml(&File {
        head: Head::new("trackdyn.simulation/1", simulation.vehicle(), provenance),
        ground: &simulation.ground,
        mechanisms: &simulation.mechanisms,
        sensors: &settings.sensors.name,
        sensors_fingerprint: fingerprint(settings.sensors.to_toml().as_bytes()),
        schedule: settings.driving.to_string(),
        seed: settings.seed,
        longest_step_s: settings.longest_step,
        recording_fingerprint: simulation.recording.fingerprint(),
    })
}
