//! Reading a file of a bag from its start to its end, however early that comes.

use super::part::Part;
use crate::Error;
use crate::recording::Warning;
use crate::table::unreadable;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

/// Largest size of a piece that is looked into, bytes: a longer one is damage. Chunks of recorders
/// hold 1 to 64 MiB, and an image some 25.
pub(super) const MAX_SIZE: u64 = 1 << 28;

/// What is wrong with a file whose records end before it says that they do.
pub(super) const EARLY_END: &str = "it ends early, or is damaged from there on";

/// The content of a file as a stream.
pub(super) struct Stream {
    path: PathBuf,
    file: Box<dyn Read>,
}

impl Stream {
    pub(super) fn open(part: &Part) -> Result<Self, Error> {
        Ok(Self { path: part.path().to_owned(), file: part.open()? })
    }

    /// The next bytes; none where the file has fewer.
    pub(super) fn bytes<const N: usize>(&mut self) -> Result<Option<[u8; N]>, Error> {
        let mut bytes = [0; N];
        match self.file.read_exact(&mut bytes) {
            Ok(()) => Ok(Some(bytes)),
            Err(cause) => self.ended(cause).map(|()| None),
        }
    }

    /// Replaces a content by the next bytes; false where the file has fewer.
    pub(super) fn fill(&mut self, content: &mut Vec<u8>, length: u64) -> Result<bool, Error> {
        content.clear();
        match (&mut self.file).take(length).read_to_end(content) {
            Ok(count) => Ok(count as u64 == length),
            Err(cause) => self.ended(cause).map(|()| false),
        }
    }

    /// Passes over bytes; false where the file has fewer.
    pub(super) fn skip(&mut self, length: u64) -> Result<bool, Error> {
        match std::io::copy(&mut (&mut self.file).take(length), &mut std::io::sink()) {
            Ok(count) => Ok(count == length),
            Err(cause) => self.ended(cause).map(|()| false),
        }
    }

    /// Whether the file ends, or its packing is damaged, where more was to come; else the system
    /// cannot read it.
    fn ended(&self, cause: std::io::Error) -> Result<(), Error> {
        match cause.kind() {
            ErrorKind::UnexpectedEof | ErrorKind::InvalidData | ErrorKind::Other => Ok(()),
            _ => Err(unreadable(&self.path, cause)),
        }
    }
}

/// Chunks of a file that are left out because they are damaged.
#[derive(Default)]
pub(super) struct Dropped {
    pub(super) chunks: u64,
    /// Time from the first to the last of their messages, summed over the chunks, ns.
    missing_ns: u64,
    /// What is wrong with the first of them.
    problem: String,
}

impl Dropped {
    pub(super) fn note(&mut self, problem: String) {
        if self.chunks == 0 {
            self.problem = problem;
        }
        self.chunks += 1;
    }

    /// Adds the time that a chunk spans.
    pub(super) fn add_time(&mut self, first_ns: u64, last_ns: u64) {
        let span = last_ns.saturating_sub(first_ns);
        self.missing_ns = self.missing_ns.saturating_add(span);
    }

    /// What is to be said of them.
    #[expect(clippy::cast_precision_loss, reason = "recordings last less than 2⁵³ ns, 104 days")]
    pub(super) fn warning(&self, path: &Path) -> Option<Warning> {
        (self.chunks > 0).then(|| Warning::ChunksDropped {
            path: path.to_owned(),
            chunks: self.chunks,
            seconds: self.missing_ns as f64 / 1e9,
            problem: self.problem.clone(),
        })
    }
}

/// Messages whose topic no record of their file tells.
pub(super) fn without_topic(path: &Path, count: u64) -> Option<Warning> {
    (count > 0).then(|| Warning::MessagesSkipped {
        topic: path.display().to_string(),
        count,
        reason: "no record of the file says what its topic is".to_owned(),
    })
}
