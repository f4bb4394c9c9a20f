//! Which format a path holds, and its reader.

use crate::recording::{Format, Recording};
use crate::rosbag::{self, RosbagOptions};
use crate::{Error, folder};
use std::path::Path;

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
        if rosbag::is_bag(path)? {
            return Ok(Self::Rosbag);
        }
        if !place.is_dir() && is_trajectory(path) {
            return Ok(Self::Tum);
        }
        if place.is_dir() {
            return Err(Error::NotARecording {
                path: path.to_owned(),
                found: "neither recording.toml nor .mcap, .db3 or .bag files".to_owned(),
                expected: "a folder with recording.toml, tracks.csv and poses.csv, or a bag of \
                           ROS; a table of steady operating points is not a recording",
            });
        }
        Err(Error::NotARecording {
            path: path.to_owned(),
            found: "a file of another kind".to_owned(),
            expected: "a recording folder, a .mcap, .db3 or .bag file, or a .tum or .txt \
                       trajectory with a table of its track speeds; to identify and diagnose, a \
                       .csv table of steady operating points too",
        })
    }
}

/// Reads the recording at a path, whatever its format; of a table, those of the options count that
/// are [about tables](RosbagOptions::of_tables).
///
/// # Errors
/// Those of [`folder::read`] and [`rosbag::read`]; [`Error::NotARecording`] for a trajectory, which
/// [`tum::read`](crate::tum::read) reads with the track speeds that it lacks.
pub fn read(path: &Path, options: &RosbagOptions) -> Result<Recording, Error> {
    match Format::of(path)? {
        Format::Rosbag => rosbag::read(path, options),
        Format::Tum => Err(Error::NotARecording {
            path: path.to_owned(),
            found: "a trajectory alone".to_owned(),
            expected: "a table of its track speeds too (t,v_left,v_right)",
        }),
        _ => folder::read_by(path, &options.of_tables()),
    }
}

/// Whether the name is that of a trajectory of the TUM benchmark.
fn is_trajectory(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "tum" || extension == "txt")
}
