//! What writing results does to a folder.

use crate::Error;
use crate::kinematics::source_of;
use std::fs::File;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use trackdyn_core::document::Document;
use trackdyn_core::output::{OutputError, write_file, write_stream};
use trackdyn_model::kinematics::Source;

/// What was done to a file of a folder of results.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Change {
    /// It was written.
    Wrote(PathBuf),
    /// It was of an earlier run and would be taken for this one's, which has none: it was removed.
    Removed(PathBuf),
}

impl Change {
    /// The file.
    pub fn path(&self) -> &Path {
        match self {
            Self::Wrote(path) | Self::Removed(path) => path,
        }
    }
}

/// Files that are being written into a folder.
pub(crate) struct Folder<'a> {
    path: &'a Path,
    changes: Vec<Change>,
}

impl<'a> Folder<'a> {
    /// The folder, made where it is missing.
    ///
    /// # Errors
    /// [`Error::Output`].
    pub(crate) fn prepare(path: &'a Path) -> Result<Self, Error> {
        trackdyn_core::output::prepare_folder(path)?;
        Ok(Self::existing(path))
    }

    /// The folder as it is, be it there or not.
    pub(crate) fn existing(path: &'a Path) -> Self {
        Self { path, changes: Vec::new() }
    }

    /// The path of a file in it.
    pub(crate) fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Writes a file.
    pub(crate) fn write(&mut self, name: &str, contents: &[u8]) -> Result<(), Error> {
        let path = self.file(name);
        write_file(&path, contents)?;
        self.changes.push(Change::Wrote(path));
        Ok(())
    }

    /// Writes a file piece by piece.
    pub(crate) fn write_stream(
        &mut self,
        name: &str,
        fill: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
    ) -> Result<(), Error> {
        let path = self.file(name);
        write_stream(&path, fill)?;
        self.changes.push(Change::Wrote(path));
        Ok(())
    }

    /// Notes a file that was written by others.
    pub(crate) fn wrote(&mut self, name: &str) {
        self.changes.push(Change::Wrote(self.file(name)));
    }

    /// Refuses to replace a kinematics file that another use case wrote, or a hand.
    pub(crate) fn refuse_other(
        &self,
        name: &'static str,
        is_own: impl FnOnce(&Source) -> bool,
    ) -> Result<(), Error> {
        let path = self.file(name);
        if !path.exists() {
            return Ok(());
        }
        let source = Document::read(&path).ok().and_then(|document| source_of(&document).ok());
        if source.as_ref().is_some_and(is_own) {
            return Ok(());
        }
        let command = source.map(|source| source.command).filter(|command| !command.is_empty());
        let origin = command.map_or("of another origin".to_owned(), |of| format!("of `{of}`"));
        Err(Error::OtherOrigin { folder: self.path.to_owned(), file: name, origin })
    }

    /// Removes a file of an earlier run, of which this one has none.
    pub(crate) fn remove_if_there(&mut self, name: &str) -> Result<(), Error> {
        let path = self.file(name);
        if path.exists() { self.remove(path) } else { Ok(()) }
    }

    /// Removes those of these files that are there, where the file `written`, which every run of a
    /// use case writes, shows that there was an earlier one.
    pub(crate) fn remove_earlier(
        &mut self,
        written: &str,
        files: impl IntoIterator<Item = PathBuf>,
    ) -> Result<(), Error> {
        let written = self.file(written);
        for path in files.into_iter().filter(|path| written.exists() && path.exists()) {
            self.remove(path)?;
        }
        Ok(())
    }

    /// What was done.
    pub(crate) fn changes(self) -> Vec<Change> {
        self.changes
    }

    fn remove(&mut self, path: PathBuf) -> Result<(), Error> {
        if let Err(cause) = std::fs::remove_file(&path) {
            return Err(Error::NotRemoved { path, cause });
        }
        self.changes.push(Change::Removed(path));
        Ok(())
    }
}

/// Makes a folder and its parents where they are missing, and makes sure that files can be written
/// into it: before work that takes long.
///
/// # Errors
/// [`Error::Output`].
pub fn prepare_folder(path: &Path) -> Result<(), Error> {
    trackdyn_core::output::prepare_folder(path).map_err(|error: OutputError| error.into())
}
