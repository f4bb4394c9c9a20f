//! Files of an earlier run that would be taken for this one's.

use crate::stderr::say;
use std::path::{Path, PathBuf};
use trackdyn::crates::core::document::Document;
use trackdyn::crates::model::kinematics::{KinematicsFile, Source};

/// Removes a kinematics file where this run gives none, if it comes from an earlier run of the same kind.
///
/// # Errors
/// A file that cannot be removed.
pub fn remove_earlier(path: &Path, is_own: impl FnOnce(&Source) -> bool) -> Result<(), String> {
    let file = Document::read(path).ok();
    let file = file.and_then(|document| KinematicsFile::from_document(&document).ok());
    if file.is_some_and(|file| is_own(&file.source)) {
        std::fs::remove_file(path).map_err(|cause| format!("{}: {cause}", path.display()))?;
        say(format_args!(
            "removed {}, of an earlier run: this one determines none",
            path.display()
        ));
    }
    Ok(())
}

/// Removes those of these files that are there, where a file that each run of a command writes shows that there was one.
///
/// # Errors
/// A file that cannot be removed.
pub fn remove_of(written: &Path, files: impl IntoIterator<Item = PathBuf>) -> Result<(), String> {
    for file in files.into_iter().filter(|file| written.exists() && file.exists()) {
        std::fs::remove_file(&file).map_err(|cause| format!("{}: {cause}", file.display()))?;
        say(format_args!("removed {}, of an earlier run", file.display()));
    }
    Ok(())
}
