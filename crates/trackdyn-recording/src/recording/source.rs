//! Where a recording comes from.

use std::path::PathBuf;

/// The format of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// A folder with `recording.toml` and CSV files.
    Folder,
    /// A bag of ROS: a `.mcap`, `.db3` or `.bag` file, or the folder around them.
    Rosbag,
    /// A trajectory of the TUM benchmark and a CSV of track speeds.
    Tum,
    /// One table with columns that the user names.
    Table,
    /// Computed.
    Memory,
}

/// Where a recording comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// The format it was read from.
    pub format: Format,
    /// File or folder; none for a recording that was computed.
    pub path: Option<PathBuf>,
    /// Unix time of t = 0 in nanoseconds, where the source keeps absolute time.
    pub epoch_ns: Option<i64>,
}

impl Source {
    /// A recording that was computed.
    pub fn computed() -> Self {
        Self { format: Format::Memory, path: None, epoch_ns: None }
    }
}
