//! What a trial cannot do.

use crate::failure::Failure;
use std::path::PathBuf;
use trackdyn_core::document::DocumentError;
use trackdyn_core::output::OutputError;

/// A trial that cannot be made, opened or scored.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A robot that cannot be built or whose motion cannot go on.
    #[error("{case}: {reason}")]
    Ground {
        /// The case.
        case: String,
        /// What happened.
        reason: Failure,
    },
    /// A file that cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A file that is not what it should be.
    #[error(transparent)]
    Document(Box<DocumentError>),
    /// A recording that cannot be written or read.
    #[error(transparent)]
    Recording(#[from] trackdyn_recording::Error),
    /// A file or folder that cannot be read or changed.
    #[error("{}: {cause}", path.display())]
    File {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        cause: std::io::Error,
    },
    /// A folder that is no trial.
    #[error("{}: no cases: expected a folder of trial make", path.display())]
    NoCases {
        /// The folder.
        path: PathBuf,
    },
    /// Answers that are not where they were put.
    #[error(
        "{}: not there: expected the answers of SHA-256 {committed}, which trial make puts beside \
         the key",
        path.display()
    )]
    NoAnswers {
        /// The file.
        path: PathBuf,
        /// What was committed to.
        committed: String,
    },
    /// A key that is none.
    #[error("{}: expected 64 hexadecimal digits, the key of a trial", path.display())]
    Key {
        /// The file.
        path: PathBuf,
    },
    /// Bytes that are not those that were committed to.
    #[error("{what}: SHA-256 {found}, and committed to is {committed}: {reason}")]
    Broken {
        /// What was compared.
        what: &'static str,
        /// What it is now.
        found: String,
        /// What it was.
        committed: String,
        /// What this means.
        reason: &'static str,
    },
    /// A recording that is not the one the answers belong to.
    #[error("{case}: the recording has the fingerprint {found}, and the sealed answer {sealed}")]
    OtherRecording {
        /// The case.
        case: String,
        /// What it is now.
        found: String,
        /// What it was.
        sealed: String,
    },
    /// Files that are not those the answers belong to.
    #[error(
        "{case}: recording and vehicle file have the fingerprint {found}, and the sealed answer \
         {sealed}"
    )]
    OtherFiles {
        /// The case.
        case: String,
        /// What it is now.
        found: String,
        /// What it was.
        sealed: String,
    },
    /// A trial that is there already.
    #[error(
        "{} is there already: a trial is made once: expected a new --out",
        path.display()
    )]
    Made {
        /// What is there.
        path: PathBuf,
    },
    /// A trial that was begun, and is another one than is asked for.
    #[error(
        "{}: begun for {begun}, and asked for {asked}: expected what it was begun for, or a new \
         --out and --key",
        folder.display()
    )]
    OtherOrder {
        /// Where it was begun.
        folder: PathBuf,
        /// What it was begun for.
        begun: String,
        /// What is asked for.
        asked: String,
    },
    /// A folder of results that belong to another trial.
    #[error("{}: of another trial: expected another folder by --out", folder.display())]
    OtherTrial {
        /// The folder.
        folder: PathBuf,
    },
    /// A folder with plans for another time.
    #[error(
        "{}: the plans here are for {begun} s: expected --duration {begun}, or another folder by \
         --out",
        folder.display()
    )]
    OtherDuration {
        /// The folder.
        folder: PathBuf,
        /// The time that they are for, s.
        begun: u32,
    },
    /// A schedule that cannot be read.
    #[error(transparent)]
    Schedule(#[from] trackdyn_drive::Error),
    /// A program that cannot be run.
    #[error("{}: cannot be run: {cause}", path.display())]
    Program {
        /// The program.
        path: PathBuf,
        /// What the system says.
        cause: std::io::Error,
    },
    /// A room that cannot be made, or a process that cannot be waited for.
    #[error(transparent)]
    System(std::io::Error),
    /// A number or a name that will not do.
    #[error("{name} = {value}: expected {expected}")]
    Option {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: String,
        /// What would do.
        expected: &'static str,
    },
}

impl Error {
    pub(crate) fn file(path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        move |cause| Self::File { path, cause }
    }
}

impl From<DocumentError> for Error {
    fn from(error: DocumentError) -> Self {
        Self::Document(Box::new(error))
    }
}
