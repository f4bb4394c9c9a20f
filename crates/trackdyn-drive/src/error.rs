//! What can go wrong around a drive.

use std::path::PathBuf;
use trackdyn_core::document::DocumentError;

/// Schedules, sensors or paths that cannot be read or used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A table that cannot be read, or recorded samples that make no recording.
    #[error(transparent)]
    Recording(#[from] trackdyn_recording::Error),
    /// A file of sensors that is not accepted.
    #[error(transparent)]
    Document(Box<DocumentError>),
    /// A file that holds too little.
    #[error("{}: {found}: expected {expected}", path.display())]
    TooLittle {
        /// The file.
        path: PathBuf,
        /// What is there.
        found: String,
        /// What would be enough.
        expected: &'static str,
    },
    /// An option that is not accepted.
    #[error("{name} = {value}: expected {expected}")]
    Option {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: String,
        /// What was expected.
        expected: String,
    },
    /// A way that cannot be followed.
    #[error("a path of {0}: expected two points or more, finite, no two neighbours in one place")]
    NoPath(String),
    /// A motion without moments.
    #[error("run {run} has no motion to observe")]
    NoMotion {
        /// Number of the run.
        run: i64,
    },
}

impl From<DocumentError> for Error {
    fn from(error: DocumentError) -> Self {
        Self::Document(Box::new(error))
    }
}

impl Error {
    /// An option that is not accepted.
    pub(crate) fn option(
        name: &'static str,
        value: &impl ToString,
        expected: impl Into<String>,
    ) -> Self {
        Self::Option { name, value: value.to_string(), expected: expected.into() }
    }
}
