//! Tables that several documents share, and how numbers are rounded in them.

use crate::{Provenance, Vehicle};
use serde::{Serialize, Serializer};
use trackdyn_core::rounding::Digits;
use trackdyn_estimate::gyroscope::Unfit;
use trackdyn_estimate::{Clock, Gyroscope};

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

/// A gyroscope, and what it adds.
#[derive(Default, Serialize)]
pub(crate) struct GyroscopeTable {
    used: bool,
    /// Why it is not used.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    scale: Option<Rounded>,
    #[serde(skip_serializing_if = "Option::is_none")]
    poses_late_s: Option<Rounded>,
    #[serde(skip_serializing_if = "Option::is_none")]
    turn_error_of_poses_rad: Option<Rounded>,
    #[serde(skip_serializing_if = "Option::is_none")]
    turn_error_with_it_rad: Option<Rounded>,
    /// Standard error of x_r - x_l by the ICRs alone without it, where they are fitted.
    #[serde(skip_serializing_if = "Option::is_none")]
    gap_standard_error_without_it_m: Option<Rounded>,
}

impl GyroscopeTable {
    /// The table of a gyroscope.
    pub(crate) fn of(found: &Result<Gyroscope, Unfit>) -> Self {
        match found {
            Ok(found) => Self {
                used: true,
                scale: Some(Rounded(found.scale)),
                poses_late_s: Some(Rounded(found.lag)),
                turn_error_of_poses_rad: Some(Rounded(found.error_of_poses)),
                turn_error_with_it_rad: Some(Rounded(found.error_with_it)),
                ..Self::default()
            },
            Err(reason) => Self { reason: Some(reason.to_string()), ..Self::default() },
        }
    }

    /// The table with the standard error of x_r − x_l (m) without the gyroscope.
    pub(crate) fn with_error_without_it(self, deviation: Option<f64>) -> Self {
        Self { gap_standard_error_without_it_m: deviation.map(Rounded), ..self }
    }
}

impl From<GyroscopeTable> for toml::Table {
    fn from(table: GyroscopeTable) -> Self {
        Self::try_from(table).expect("numbers and texts are TOML")
    }
}
