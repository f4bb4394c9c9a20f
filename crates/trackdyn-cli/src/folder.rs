//! Folders that results are written to, by one process at a time.

use std::collections::BTreeMap;
use std::error::Error;
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;
use trackdyn::crates::core::output::TEMPORARY;

/// Folders that are locked until this process ends.
static LOCKED_FOLDERS: Mutex<BTreeMap<PathBuf, File>> = Mutex::new(BTreeMap::new());

/// Age of a temporary file from which no process is writing it any more.
const MIN_ABANDONED_AGE: Duration = Duration::from_secs(600);

/// Makes a folder, makes sure that files can be written into it, and keeps other processes of the
/// program from it until this one ends: results of two would mix. What a process that was killed
/// left there half written is removed.
///
/// # Errors
/// Why nothing can be written there.
pub fn prepare_folder(path: &Path) -> Result<(), Box<dyn Error>> {
    trackdyn::prepare_folder(path)?;
    lock(path)?;
    remove_leftovers(path);
    Ok(())
}

fn lock(path: &Path) -> Result<(), String> {
    let (Ok(place), Ok(folder)) = (path.canonicalize(), File::open(path)) else {
        // some systems open no folders
        return Ok(());
    };
    let mut locked = LOCKED_FOLDERS.lock().unwrap_or_else(PoisonError::into_inner);
    if locked.contains_key(&place) {
        return Ok(());
    }
    match folder.try_lock() {
        Err(TryLockError::WouldBlock) => Err(format!(
            "{}: another process of trackdyn writes there: expected one after the other, or \
             another folder by --out",
            path.display()
        )),
        // some file systems have no locks
        Err(TryLockError::Error(_)) => Ok(()),
        Ok(()) => {
            locked.insert(place, folder);
            Ok(())
        }
    }
}

/// Removes temporary files that nobody writes any more. What cannot be removed does no harm.
fn remove_leftovers(path: &Path) {
    let Ok(entries) = std::fs::read_dir(path) else { return };
    for entry in entries.flatten() {
        let is_temporary = entry.file_name().to_string_lossy().starts_with(TEMPORARY);
        let age = entry.metadata().and_then(|file| file.modified()).map(|time| time.elapsed());
        let is_abandoned = age.is_ok_and(|age| age.is_ok_and(|age| age > MIN_ABANDONED_AGE));
        if is_temporary && is_abandoned && entry.path().is_file() {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}
