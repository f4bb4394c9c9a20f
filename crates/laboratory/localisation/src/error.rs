//! What can go wrong with rooms, scans and their series.

use trackdyn_core::document::DocumentError;
use trackdyn_core::output::OutputError;

/// A room, a scan or an option that cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A room file is not accepted.
    #[error(transparent)]
    Document(#[from] DocumentError),
    /// A file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// An outline that cannot be drawn.
    #[error("outline {outline:?}: {found}: expected {expected}")]
    Outline {
        /// Name of the outline.
        outline: String,
        /// What it has.
        found: String,
        /// What would be accepted.
        expected: &'static str,
    },
    /// A number that cannot be.
    #[error("{name} = {value}: expected {expected}")]
    Value {
        /// What it is.
        name: &'static str,
        /// The value.
        value: f64,
        /// What would be accepted.
        expected: &'static str,
    },
    /// A range that no laser returns.
    #[error(
        "beam {beam}: range {range} m: expected a positive range, or no finite number for no return"
    )]
    Range {
        /// Index of the beam, from 0.
        beam: usize,
        /// Its range, m.
        range: f64,
    },
    /// Odometry that does not belong to the scans.
    #[error("{found} odometry poses: expected {expected}, one for each scan")]
    Odometry {
        /// Poses given.
        found: usize,
        /// Scans given.
        expected: usize,
    },
    /// Scans out of order.
    #[error(
        "scan {index} is stamped {stamp} s: expected a time after {before} s, that of the scan \
         before"
    )]
    Order {
        /// Index of the scan, from 0.
        index: usize,
        /// Its stamp, s.
        stamp: f64,
        /// The stamp before, s.
        before: f64,
    },
}

/// The value, if it is positive and finite.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<f64, Error> {
    accept(name, value, value.is_finite() && value > 0.0, "a positive number")
}

/// The value, if it is finite and not negative.
pub(crate) fn not_negative(name: &'static str, value: f64) -> Result<f64, Error> {
    accept(name, value, value.is_finite() && value >= 0.0, "a number that is not negative")
}

/// The value, if it is a number.
pub(crate) fn finite(name: &'static str, value: f64) -> Result<f64, Error> {
    accept(name, value, value.is_finite(), "a finite number")
}

/// The value, if it is good.
pub(crate) fn accept(
    name: &'static str,
    value: f64,
    good: bool,
    expected: &'static str,
) -> Result<f64, Error> {
    if good { Ok(value) } else { Err(Error::Value { name, value, expected }) }
}
