//! Tables that several documents share, and how numbers are rounded in them.

use crate::{Provenance, Vehicle};
use serde::{Serialize, Serializer};
use trackdyn_core::rounding::Digits;
use trackdyn_estimate::Clock;

/// Digits that documents keep.
const DIGITS: Digits = Digits::Decimals(9);

/// A number that is written with nine decimals: what is below is rounding, and would differ between
/// machines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rounded(pub(crate) f64);

impl Serialize for Rounded {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(DIGITS.round(self.0))
    }
}

/// The TOML of a document.
///
/// # Panics
/// Never: numbers, texts and tables are TOML.
pub(crate) fn to_toml(document: &impl Serialize) -> String {
    toml::to_string(document).expect("numbers, texts and tables are TOML")
}

/// Head of a document: what it is, and the vehicle that it was made from.
#[derive(Serialize)]
pub(crate) struct Head<'a> {
    schema: &'static str,
    command: &'a str,
    version: &'a str,
    vehicle: &'a str,
    vehicle_fingerprint: String,
    effects: Vec<String>,
}

impl<'a> Head<'a> {
    /// The head of a document of this schema.
    pub(crate) fn new(
        schema: &'static str,
        vehicle: &'a Vehicle,
        provenance: &'a Provenance,
    ) -> Self {
        Self {
            schema,
            command: &provenance.command,
            version: &provenance.version,
            vehicle: vehicle.name(),
            vehicle_fingerprint: vehicle.fingerprint(),
            effects: vehicle.effects().iter().map(ToString::to_string).collect(),
        }
    }
}

/// The clock offset of a recording.
#[derive(Serialize)]
pub(crate) struct ClockTable<'a> {
    tau_s: Rounded,
    #[serde(skip_serializing_if = "Option::is_none")]
    standard_error_s: Option<Rounded>,
    origin: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    note: Option<&'a str>,
}

impl<'a> ClockTable<'a> {
    /// The table of an offset.
    pub(crate) fn of(clock: &'a Clock) -> Self {
        Self {
            tau_s: Rounded(clock.tau()),
            standard_error_s: clock.standard_error().map(Rounded),
            origin: clock.origin(),
            note: clock.reason(),
        }
    }
}
