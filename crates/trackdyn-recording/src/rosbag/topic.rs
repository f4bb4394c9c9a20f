//! Topics and what they can be used for.

use super::payload::{Encoding, Payload, PayloadError};

/// A topic of a bag.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Topic {
    /// Its name.
    pub(super) name: String,
    /// Its type, such as `sensor_msgs/msg/Imu`.
    pub(super) kind: String,
    /// How its messages are encoded; `cdr` and `ros1` are what can be read.
    pub(super) encoding: String,
}

/// What a topic can be used for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Role {
    /// Track speeds.
    Tracks,
    /// Poses.
    Poses,
    /// Readings of the IMU.
    Imu,
}

/// Layouts that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layout {
    /// `sensor_msgs/JointState`.
    JointState,
    /// `nav_msgs/Odometry`, `geometry_msgs/TransformStamped`: header, child frame, pose.
    PoseOfChild,
    /// `geometry_msgs/PoseStamped`, `PoseWithCovarianceStamped`: header, pose.
    Pose,
    /// `tf2_msgs/TFMessage`, `tf/tfMessage`: a list of transforms.
    Transforms,
    /// `sensor_msgs/Imu`.
    Imu,
}

/// What ends the names of topics whose transforms hold at all times, such as `/tf_static`.
pub(super) const STATIC: &str = "_static";

impl Topic {
    /// Whether it is a topic of transforms that hold at all times.
    pub(super) fn is_static(&self) -> bool {
        self.layout() == Some(Layout::Transforms) && self.name.ends_with(STATIC)
    }

    /// The start of one of its messages; one of CDR where its encoding is not known.
    ///
    /// # Errors
    /// A payload whose beginning is not that of its encoding.
    pub(super) fn payload<'a>(&self, bytes: &'a [u8]) -> Result<Payload<'a>, PayloadError> {
        Payload::of(Encoding::of(&self.encoding).unwrap_or(Encoding::Cdr), bytes)
    }

    /// The layout of its messages, where it is one of those known here.
    pub(super) fn layout(&self) -> Option<Layout> {
        Encoding::of(&self.encoding)?;
        match self.kind.replace("/msg/", "/").as_str() {
            "sensor_msgs/JointState" => Some(Layout::JointState),
            "nav_msgs/Odometry" | "geometry_msgs/TransformStamped" => Some(Layout::PoseOfChild),
            "geometry_msgs/PoseStamped" | "geometry_msgs/PoseWithCovarianceStamped" => {
                Some(Layout::Pose)
            }
            "tf2_msgs/TFMessage" | "tf/tfMessage" => Some(Layout::Transforms),
            "sensor_msgs/Imu" => Some(Layout::Imu),
            _ => None,
        }
    }
}

impl Layout {
    /// What messages of this layout can be used for.
    pub(super) fn role(self) -> Role {
        match self {
            Self::JointState => Role::Tracks,
            Self::PoseOfChild | Self::Pose | Self::Transforms => Role::Poses,
            Self::Imu => Role::Imu,
        }
    }
}

/// Topics with their types, for messages.
pub(super) fn list<'a>(topics: impl Iterator<Item = &'a Topic>) -> String {
    let mut names: Vec<String> = topics
        .map(|topic| match Encoding::of(&topic.encoding) {
            Some(_) => format!("{} ({})", topic.name, topic.kind),
            None => format!("{} ({}, encoding {})", topic.name, topic.kind, topic.encoding),
        })
        .collect();
    names.sort();
    names.dedup();
    if names.is_empty() { "no topics".to_owned() } else { names.join(", ") }
}
