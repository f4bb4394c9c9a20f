//! What can go wrong with a recording.

use crate::doubt::Doubt;
use crate::unit::{self, SpeedUnit};
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use trackdyn_core::PerSide;
use trackdyn_core::document::DocumentError;
use trackdyn_core::output::OutputError;

/// A recording that cannot be read, written or used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// `recording.toml` is not accepted.
    #[error(transparent)]
    Manifest(Box<DocumentError>),
    /// A file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A file cannot be read.
    #[error("{}: cannot be read: {cause}", path.display())]
    Unreadable {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        cause: std::io::Error,
    },
    /// The path holds no recording in any known format.
    #[error("{}: {found}: expected {expected}", path.display())]
    NotARecording {
        /// The file or folder.
        path: PathBuf,
        /// What is there instead.
        found: String,
        /// What would be accepted.
        expected: &'static str,
    },
    /// A table without a column it needs.
    #[error("{}:{line}: columns {found}: expected {expected}", path.display())]
    Header {
        /// The file.
        path: PathBuf,
        /// Line of the header, from 1.
        line: u64,
        /// The columns that are there.
        found: String,
        /// The columns that must be there.
        expected: String,
    },
    /// A row with too many or too few cells.
    #[error("{}:{line}: {found} cells: expected {expected}", path.display())]
    Row {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: u64,
        /// Cells in the row.
        found: u64,
        /// Cells that must be there.
        expected: u64,
    },
    /// A cell that is not what its column holds.
    #[error("{}:{line}:{column}: {name} = {value:?}: expected {expected}", path.display())]
    Cell {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: u64,
        /// Place of the cell in its row, from 1.
        column: usize,
        /// Name of the column.
        name: String,
        /// The cell as written.
        value: String,
        /// What was expected.
        expected: &'static str,
    },
    /// A file with nothing in it that can be used.
    #[error("{}: {message}", path.display())]
    Empty {
        /// The file or folder.
        path: PathBuf,
        /// What is missing.
        message: String,
    },
    /// A bag that cannot be opened.
    #[error("{}: not a readable bag: {message}", path.display())]
    Bag {
        /// The file.
        path: PathBuf,
        /// What its reader says.
        message: String,
    },
    /// No topic, or several, for something that is needed.
    #[error("{}: {what}: {problem}; the bag has {available}", path.display())]
    Topic {
        /// The bag.
        path: PathBuf,
        /// What the topic is needed for.
        what: &'static str,
        /// Why none was taken.
        problem: String,
        /// Topics with their types.
        available: String,
    },
    /// Options that do not go together.
    #[error("{}: {problem}", path.display())]
    Options {
        /// The recording that they are for.
        path: PathBuf,
        /// Which options, and what was expected.
        problem: String,
    },
    /// Yaw rates of steady points that are no radians per second.
    #[error(
        "{}: yaw_rate is {per_speed:.1} for each m/s that one track is faster than the other, more \
         than rad/s can be: degrees per second; expected rad/s, {:.4} times these",
        path.display(), TAU / 360.0
    )]
    PointsInDegrees {
        /// The table.
        path: PathBuf,
        /// The median of all points, in what should be rad/m.
        per_speed: f64,
    },
    /// Tracks and poses that contradict each other.
    #[error("{}: {doubt}: {remedy}; --accept {} reads it all the same, where you know better",
        path.display(), doubt.kind().name())]
    Contradiction {
        /// The file or folder.
        path: PathBuf,
        /// What contradicts what.
        doubt: Doubt,
        /// What is expected, and which option helps.
        remedy: String,
        /// Of a bag: the joints of both sides with which tracks and poses agree, where others are
        /// to blame.
        joints: Option<Box<PerSide<Vec<String>>>>,
    },
    /// A run that the recording does not have.
    #[error("run {run} is not in the recording: expected {expected}")]
    UnknownRun {
        /// The number asked for.
        run: i64,
        /// The numbers that are there.
        expected: String,
    },
    /// No run has anything in the time asked for.
    #[error(
        "no run has track speeds and two poses from {from} to {until} s after its first reading: \
         expected a time within {longest:.1} s, the longest run"
    )]
    NothingWithin {
        /// Beginning of the time, s.
        from: f64,
        /// Its end, s.
        until: f64,
        /// Length of the longest run, s.
        longest: f64,
    },
}

impl Error {
    /// The error of a recording with this doubt, and what can be done about it.
    pub(crate) fn contradiction(path: &Path, doubt: Doubt) -> Self {
        let remedy = doubt.remedy();
        Self::Contradiction { path: path.to_owned(), doubt, remedy, joints: None }
    }

    /// This error where speeds are taken for those of wheels of this radius, m, in this unit; none:
    /// rad/s.
    pub(crate) fn of_wheels(self, unit: Option<SpeedUnit>, radius: Option<f64>) -> Self {
        match (self, radius) {
            (
                Self::Contradiction { path, doubt: Doubt::Travel { ratio, .. }, joints, .. },
                Some(radius),
            ) => {
                let unit = unit.unwrap_or(SpeedUnit::RadiansPerSecond);
                let (units, remedy) = unit::of_wheels(ratio, unit, radius);
                let doubt = Doubt::Travel { ratio, units };
                Self::Contradiction { path, doubt, remedy, joints }
            }
            (error, _) => error,
        }
    }

    /// This error, where track speeds are computed from a twist: no option reads another unit.
    pub(crate) fn of_twist(self) -> Self {
        match self {
            Self::Contradiction { path, doubt: doubt @ Doubt::Travel { .. }, joints, .. } => {
                let remedy = "expected a twist in m/s and rad/s, of what the wheels did; \
                              --left-joint and --right-joint take the encoders themselves";
                Self::Contradiction { path, doubt, remedy: remedy.to_owned(), joints }
            }
            error => error,
        }
    }
}

impl From<DocumentError> for Error {
    fn from(error: DocumentError) -> Self {
        Self::Manifest(Box::new(error))
    }
}
