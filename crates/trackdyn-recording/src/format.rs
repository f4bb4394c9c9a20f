//! The formats of recordings.

use crate::recording::Recording;
use crate::rosbag::{self, RosbagOptions};
use crate::{Error, folder};
use std::path::Path;

/// Where a recording can come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// A folder with `recording.toml` and CSV files.
    Folder,
    /// A rosbag2: a `.mcap` or `.db3` file, or the folder around them.
    Rosbag,
    /// A trajectory of the TUM benchmark and a CSV of track speeds.
    Tum,
    /// Computed.
    Memory,
}

impl Format {
    /// The format of a file or folder that holds all of a recording.
    ///
    /// # Errors
    /// [`Error::NotARecording`], [`Error::Unreadable`].
    pub fn of(path: &Path) -> Result<Self, Error> {
        let place = std::fs::metadata(path)
            .map_err(|cause| Error::Unreadable { path: path.to_owned(), cause })?;
        if place.is_dir() && path.join(folder::MANIFEST).is_file() {
            return Ok(Self::Folder);
        }
        if rosbag::is_bag(path) {
            return Ok(Self::Rosbag);
        }
        if place.is_dir() {
            return Err(Error::NotARecording {
                path: path.to_owned(),
                found: "neither recording.toml nor .mcap or .db3 files".to_owned(),
                expected: "a folder with recording.toml, tracks.csv and poses.csv, or a rosbag2; \
                           a table of steady operating points is not a recording",
            });
        }
        Err(Error::NotARecording {
            path: path.to_owned(),
            found: "a file of another kind".to_owned(),
            expected: "a recording folder, a .mcap or a .db3 file",
        })
    }
}

/// Reads the recording at a path, whatever its format; `options` count for a rosbag.
///
/// # Errors
/// Those of [`folder::read`] and [`rosbag::read`].
pub fn read(path: &Path, options: &RosbagOptions) -> Result<Recording, Error> {
    match Format::of(path)? {
        Format::Rosbag => rosbag::read(path, options),
        _ => folder::read(path),
    }
}
