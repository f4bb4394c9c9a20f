//! What to take from a bag.

use super::topic::STATIC_SUFFIX;
use crate::doubt::DoubtKind;
use crate::recording::PoseAxes;
use crate::table_options::TableOptions;
use crate::unit::{PoseUnit, SpeedUnit};
use std::path::PathBuf;

/// Topics, joints and frames; what is left open is taken where the bag leaves no choice.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RosbagOptions {
    /// Topic of the `sensor_msgs/JointState` or `control_msgs/DynamicJointState`.
    pub tracks_topic: Option<String>,
    /// Joints of the left side; their mean counts, and a `-` before a name reverses its sign.
    /// Empty: those whose name has a word of the side, such as `left`, `l` or `fl`, without parts
    /// that carry no robot, such as flippers. They have to move alike.
    pub left_joints: Vec<String>,
    /// Joints of the right side, in the same way.
    pub right_joints: Vec<String>,
    /// Which of the joint's signals to take; of numbers that are named by their fields, whether
    /// they are speeds or positions, such as ticks.
    pub joint_signal: JointSignal,
    /// Belt speed per joint speed, m: the radius of wheel or sprocket, with any gear.
    pub wheel_radius: Option<f64>,
    /// Topic of the poses; one of a `sensor_msgs/Imu` gives the yaw of its gyroscope alone.
    pub pose_topic: Option<String>,
    /// Which pose of a `geometry_msgs/PoseArray` is that of the robot, from 0; needed where its
    /// messages have several.
    pub pose_index: Option<usize>,
    /// Frame that the poses are expressed in. Where both frames are named and no topic has their
    /// poses, they are composed along a chain of transforms.
    pub parent_frame: Option<String>,
    /// Frame whose poses they are.
    pub child_frame: Option<String>,
    /// Topic of the `sensor_msgs/Imu`.
    pub imu_topic: Option<String>,
    /// Topic of the speeds of the body (`nav_msgs/Odometry`, `geometry_msgs/Twist`, `TwistStamped`
    /// or `TwistWithCovarianceStamped`) that track speeds are made of, in place of joints:
    /// `v_l` = v - ω b/2 and `v_r` = v + ω b/2. They are those of the tracks only where the driver
    /// has computed them from the encoders alone, with the separation b. A wheel radius is refused
    /// then.
    pub twist_topic: Option<String>,
    /// Separation b of the tracks that the driver of `twist_topic` reckons with, m; needed with it.
    pub separation: Option<f64>,
    /// Numbers in messages that are speeds of the left side, or by `joint_signal` positions, which
    /// `wheel_radius` makes ways (m per tick, or per radian), in place of joints, each as
    /// `TOPIC:FIELD`, such as `/status:motors[0].rpm`; their mean counts, and a `-` before one
    /// reverses its sign. Where they are in the messages is told by their definitions, which a bag
    /// has, or `msg_dir`.
    pub left_signals: Vec<String>,
    /// Numbers of the right side, in the same way.
    pub right_signals: Vec<String>,
    /// Unit of the speeds of joints or of these numbers, and of the angles of joints; none: rad/s.
    pub speed_unit: Option<SpeedUnit>,
    /// Folder of definitions of messages (`PACKAGE/msg/TYPE.msg`), for bags that have none.
    pub msg_dir: Option<PathBuf>,
    /// What dates the messages.
    pub dated_by: Dating,
    /// Unit of the positions of poses; fixes of satellite navigation have none.
    pub pose_unit: PoseUnit,
    /// Axes in which the poses are told.
    pub pose_axes: PoseAxes,
    /// Yaw of the x axis of the pose sensor on the robot, rad: π where it faces backwards.
    pub mount_yaw: Option<f64>,
    /// Whether the yaw rates of the IMU are in degrees per second.
    pub gyro_in_degrees: bool,
    /// Doubts that do not stop the reader, because the user knows better.
    pub accepted: Vec<DoubtKind>,
}

impl RosbagOptions {
    /// Whether speeds come from wheels, whose radius makes them speeds of the tracks.
    pub fn counts_wheels(&self) -> bool {
        self.twist_topic.is_none() && self.speed_unit.is_none_or(SpeedUnit::is_of_wheels)
    }

    /// What counts for tables as well.
    pub fn of_tables(&self) -> TableOptions {
        TableOptions {
            speed_unit: self.speed_unit,
            wheel_radius: self.wheel_radius,
            pose_unit: self.pose_unit,
            pose_axes: self.pose_axes,
            mount_yaw: self.mount_yaw,
            gyro_in_degrees: self.gyro_in_degrees,
            accepted: self.accepted.clone(),
        }
    }

    /// Parent and child frame of the poses, where both are named.
    pub(super) fn frames(&self) -> Option<[&str; 2]> {
        Some([self.parent_frame.as_deref()?, self.child_frame.as_deref()?])
    }

    /// The option of the command line that chooses joints, where there is one.
    pub(super) fn of_joints(&self) -> Option<&'static str> {
        let given = [
            ("--tracks-topic", self.tracks_topic.is_some()),
            ("--left-joint", !self.left_joints.is_empty()),
            ("--right-joint", !self.right_joints.is_empty()),
            ("--joint-signal", self.joint_signal != JointSignal::Any),
        ];
        given.into_iter().find_map(|(name, given)| given.then_some(name))
    }

    /// Whether poses of a topic are those of a driver whose speeds are taken: they come from the
    /// tracks themselves.
    pub(super) fn takes_speeds_of(&self, topic: &str) -> bool {
        let signals = self.left_signals.iter().chain(&self.right_signals);
        let mut topics = signals.filter_map(|text| {
            let (topic, _) = text.strip_prefix('-').unwrap_or(text).split_once(':')?;
            Some(topic)
        });
        topics.any(|name| name == topic) || self.twist_topic.as_deref() == Some(topic)
    }

    /// Whether anything is said of the poses.
    pub(super) fn names_poses(&self) -> bool {
        [&self.pose_topic, &self.parent_frame, &self.child_frame].iter().any(|one| one.is_some())
    }

    /// Whether poses may come from a topic: from the one that is named, and from transforms that
    /// hold at all times beside it.
    pub(super) fn may_hold_poses(&self, topic: &str) -> bool {
        self.pose_topic.as_deref().is_none_or(|named| {
            topic == named
                || topic.strip_suffix(STATIC_SUFFIX).is_some_and(|moving| moving == named)
        })
    }
}

/// What dates the messages of a bag.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Dating {
    /// Their stamps; their logging where the stamps of tracks and poses are of different clocks.
    #[default]
    Any,
    /// The stamps in their headers.
    Header,
    /// The times at which they were logged.
    Log,
}

/// Signal of a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum JointSignal {
    /// The velocity where the joints have one that moves, else the position.
    #[default]
    Any,
    /// Velocity, rad/s.
    Velocity,
    /// Position, rad, continuous over turns or modulo a turn; its difference quotient is the speed.
    Position,
}
