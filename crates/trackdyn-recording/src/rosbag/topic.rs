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
    /// Speeds of the body, of which track speeds can be made
    /// ([`RosbagOptions::twist_topic`](super::RosbagOptions::twist_topic)).
    Twist,
}

/// Layouts that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layout {
    /// `sensor_msgs/JointState`.
    JointState,
    /// `control_msgs/DynamicJointState`: header, joints with named interfaces.
    DynamicJointState,
    /// `nav_msgs/Odometry`, `geometry_msgs/TransformStamped`: header, child frame, pose.
    PoseOfChild,
    /// `geometry_msgs/PoseStamped`, `PoseWithCovarianceStamped`: header, pose.
    Pose,
    /// `tf2_msgs/TFMessage`, `tf/tfMessage`: a list of transforms.
    Transforms,
    /// `sensor_msgs/Imu`.
    Imu,
    /// `nav_msgs/Path`: header, a list of `PoseStamped`.
    Path,
    /// `geometry_msgs/PoseArray`: header, a list of poses.
    PoseArray,
    /// `geometry_msgs/Pose`: without a header.
    BarePose,
    /// `sensor_msgs/NavSatFix`.
    Fix,
    /// `geometry_msgs/Twist`: without a header.
    Twist,
    /// `geometry_msgs/TwistStamped`, `TwistWithCovarianceStamped`: header, twist.
    TwistStamped,
}

/// What ends the names of topics whose transforms hold at all times, such as `/tf_static`.
pub(super) const STATIC_SUFFIX: &str = "_static";

impl Topic {
    /// Whether it is a topic of transforms that hold at all times.
    pub(super) fn is_static(&self) -> bool {
        self.layout() == Some(Layout::Transforms) && self.name.ends_with(STATIC_SUFFIX)
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
        Layout::of_kind(&self.kind)
    }
}

impl Layout {
    /// The layout of messages of a type, in the spelling of ROS 1 or ROS 2.
    pub(super) fn of_kind(kind: &str) -> Option<Self> {
        let (package, name) = kind.split_once('/')?;
        Some(match (package, name.strip_prefix("msg/").unwrap_or(name)) {
            ("sensor_msgs", "JointState") => Self::JointState,
            ("control_msgs", "DynamicJointState") => Self::DynamicJointState,
            ("nav_msgs", "Odometry") | ("geometry_msgs", "TransformStamped") => Self::PoseOfChild,
            ("geometry_msgs", "PoseStamped" | "PoseWithCovarianceStamped") => Self::Pose,
            ("tf2_msgs", "TFMessage") | ("tf", "tfMessage") => Self::Transforms,
            ("sensor_msgs", "Imu") => Self::Imu,
            ("nav_msgs", "Path") => Self::Path,
            ("geometry_msgs", "PoseArray") => Self::PoseArray,
            ("geometry_msgs", "Pose") => Self::BarePose,
            ("sensor_msgs", "NavSatFix") => Self::Fix,
            ("geometry_msgs", "Twist") => Self::Twist,
            ("geometry_msgs", "TwistStamped" | "TwistWithCovarianceStamped") => Self::TwistStamped,
            _ => return None,
        })
    }

    /// Whether this layout is taken only where no other layout has its role. Such poses are more
    /// often plans and goals than where a robot was, and such joints repeat those of a
    /// `JointState`.
    pub(super) fn is_second_choice(self) -> bool {
        matches!(
            self,
            Self::Path | Self::PoseArray | Self::BarePose | Self::Fix | Self::DynamicJointState
        )
    }

    /// What messages of this layout can be used for.
    pub(super) fn role(self) -> Role {
        match self {
            Self::JointState | Self::DynamicJointState => Role::Tracks,
            Self::PoseOfChild
            | Self::Pose
            | Self::Transforms
            | Self::Path
            | Self::PoseArray
            | Self::BarePose
            | Self::Fix => Role::Poses,
            Self::Imu => Role::Imu,
            Self::Twist | Self::TwistStamped => Role::Twist,
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
