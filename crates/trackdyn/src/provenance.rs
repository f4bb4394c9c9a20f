//! Who asked for a result: it stands in every file that is written.

use trackdyn_model::kinematics::Source;

/// Who asked for a result. It stands in every file that is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Provenance {
    /// The command line, or another text by which the caller can repeat it.
    pub command: String,
    /// Version of what computed it.
    pub version: String,
}

impl Provenance {
    /// What this version of the library computes at the request of `command`.
    pub fn new(command: impl Into<String>) -> Self {
        Self { command: command.into(), version: crate::VERSION.to_owned() }
    }

    /// Where numbers come from that a file keeps, beside what they were made from.
    pub(crate) fn source(&self) -> Source {
        Source { command: self.command.clone(), version: self.version.clone(), ..Source::default() }
    }
}

impl Default for Provenance {
    /// The library, called by a program that does not say more.
    fn default() -> Self {
        Self::new("the library trackdyn")
    }
}
