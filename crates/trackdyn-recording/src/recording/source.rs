//! Where a recording comes from.

use std::path::PathBuf;
use trackdyn_core::PerSide;

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
    /// What a bag calls the parts of the robot; none of other sources.
    pub names: Option<Box<BagNames>>,
}

/// What a bag calls the parts of the robot, as they were taken.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BagNames {
    /// Joints of each side, with a `-` before those that count backwards; empty where track speeds
    /// come from something else.
    pub joints: PerSide<Vec<String>>,
    /// Belt travel per radian of these, m; none where they do not turn.
    pub wheel_radius: Option<f64>,
    /// Topics of the track speeds.
    pub track_topics: Vec<String>,
    /// Topic of the poses; none of a chain of transforms.
    pub pose_topic: Option<String>,
    /// Frame that the poses are expressed in, where the bag names it.
    pub parent_frame: Option<String>,
    /// Frame whose poses they are, where the bag names it.
    pub child_frame: Option<String>,
}

impl Source {
    /// A recording that was computed.
    pub fn computed() -> Self {
        Self { format: Format::Memory, path: None, epoch_ns: None, names: None }
    }
}
