//! Tables that the documents of several commands share.

use crate::options::command_line;
use serde::Serialize;
use trackdyn::crates::core::output::fingerprint;
use trackdyn::crates::model::VehicleFile;
use trackdyn::crates::recording::Clock;

/// Head of a document: what it is, and the vehicle it was made from.
#[derive(Serialize)]
pub struct Head<'a> {
    schema: &'static str,
    command: String,
    version: &'static str,
    vehicle: &'a str,
    vehicle_fingerprint: String,
    effects: Vec<String>,
}

impl<'a> Head<'a> {
    /// The head of a document of this schema.
    pub fn new(schema: &'static str, file: &'a VehicleFile) -> Self {
        Self {
            schema,
            command: command_line(),
            version: env!("CARGO_PKG_VERSION"),
            vehicle: &file.vehicle.name,
            vehicle_fingerprint: fingerprint(file.to_toml().as_bytes()),
            effects: file.effects.iter().map(ToString::to_string).collect(),
        }
    }
}

/// The clock offset of a recording.
#[derive(Serialize)]
pub struct ClockTable<'a> {
    tau_s: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    standard_error_s: Option<f64>,
    origin: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    note: Option<&'a str>,
}

impl<'a> ClockTable<'a> {
    /// The table of an offset.
    pub fn of(clock: &'a Clock) -> Self {
        Self {
            tau_s: rounded(clock.tau()),
            standard_error_s: clock.standard_error().map(rounded),
            origin: clock.origin(),
            note: clock.reason(),
        }
    }
}

/// The number to nine decimals: what is below is rounding.
pub fn rounded(value: f64) -> f64 {
    (value * 1e9).round() / 1e9
}
