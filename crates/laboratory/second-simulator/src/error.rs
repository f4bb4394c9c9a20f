//! What cannot be simulated.

use crate::sheet::{Parameter, Sheet};
use trackdyn_model::VehicleError;

/// A robot that cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// No mechanism of this id.
    #[error("no mechanism \"{id}\": expected one of {known}")]
    UnknownMechanism {
        /// The id that was asked for.
        id: String,
        /// Those that there are, separated by commas.
        known: String,
    },
    /// No such parameter.
    #[error("{} has no parameter \"{key}\"; it has {}", sheet.id, sheet.keys())]
    UnknownParameter {
        /// The mechanism.
        sheet: &'static Sheet,
        /// The key that was given.
        key: String,
    },
    /// A value outside its physical range.
    #[error(
        "{}.{} = {value}: expected {} to {} {}",
        sheet.id, parameter.key, parameter.range[0], parameter.range[1], parameter.unit
    )]
    OutOfRange {
        /// The mechanism.
        sheet: &'static Sheet,
        /// Its parameter.
        parameter: &'static Parameter,
        /// The value that was given.
        value: f64,
    },
    /// A parameter of an effect whose law has a constant here.
    #[error(
        "effect {id}:{key} = {value}: expected it left out on the independent ground, whose law \
         has no such parameter"
    )]
    Constant {
        /// The effect.
        id: String,
        /// The key of its parameter.
        key: String,
        /// The value that was given.
        value: f64,
    },
    /// A parameter given twice.
    #[error("{}.{}: given twice", sheet.id, parameter.key)]
    RepeatedParameter {
        /// The mechanism.
        sheet: &'static Sheet,
        /// Its parameter.
        parameter: &'static Parameter,
    },
    /// Text that does not name a mechanism.
    #[error("\"{0}\": expected ID or ID:PARAMETER=VALUE,..., of which form=NUMBER draws a form")]
    Malformed(String),
    /// A drawn form of a mechanism that has one law only.
    #[error("{} has one form of its law: expected no form=NUMBER", sheet.id)]
    NoFamily {
        /// The mechanism.
        sheet: &'static Sheet,
    },
    /// A mechanism that is switched on twice.
    #[error("{0} is switched on twice")]
    Repeated(&'static str),
    /// A vehicle that cannot be.
    #[error(transparent)]
    Vehicle(#[from] VehicleError),
    /// A setting of the simulation that cannot be.
    #[error("{key} = {value}: expected {expected}")]
    Setup {
        /// Its name.
        key: &'static str,
        /// Its value.
        value: f64,
        /// What was expected.
        expected: &'static str,
    },
}
