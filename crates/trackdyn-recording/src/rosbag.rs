//! Bags of ROS 2: `.mcap` and `.db3` files, alone or in the folder that `ros2 bag record` makes.
//!
//! Track speeds come from `sensor_msgs/JointState`, poses from `nav_msgs/Odometry`,
//! `geometry_msgs/PoseStamped`, `PoseWithCovarianceStamped`, `TransformStamped` or
//! `tf2_msgs/TFMessage`, readings of the IMU from `sensor_msgs/Imu`. The layouts of these types are
//! known here: the message definitions in the bag do not matter. All of a bag is one run.
//!
//! Positions of joints that wrap after a turn are unwrapped. Where both frames are named and no
//! topic has their poses, these are composed along a chain of transforms, such as map → odom →
//! base_link.

use crate::recording::{Recording, Source};
use crate::{Error, Format};
use std::path::Path;

mod chain;
mod collector;
mod compressed;
mod date;
mod frames;
mod inspection;
mod joints;
mod mcap_chunk;
mod mcap_file;
mod message;
mod options;
mod part;
mod payload;
mod ros1_file;
mod ros1_record;
mod sqlite_file;
mod storage;
mod stream;
mod topic;
mod visitor;

pub use inspection::{Inspection, TopicSummary, inspect};
pub(crate) use message::yaw_of_quaternion;
pub use options::{JointSignal, RosbagOptions};
pub(crate) use storage::is_bag;
pub use topic::Role;

/// Reads a bag.
///
/// Where the options name no topic and the bag has just one that fits, that one is taken, with a
/// warning. A damaged file gives what stands before the damage, with a warning.
///
/// # Errors
/// [`Error::Topic`] when nothing or several things fit, [`Error::Bag`], [`Error::Unreadable`].
pub fn read(path: &Path, options: &RosbagOptions) -> Result<Recording, Error> {
    let mut collector = collector::Collector::new(options);
    let mut warnings = storage::scan(path, &mut collector)?;
    let collected = collector.finish(path)?;
    warnings.extend(collected.warnings);
    let name = storage::name(path);
    let source = Source {
        format: Format::Rosbag,
        path: Some(path.to_owned()),
        epoch_ns: Some(collected.epoch_ns),
    };
    Recording::new(name, "unknown", vec![collected.run], source, warnings)
}
