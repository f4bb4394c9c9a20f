//! Messages of ROS 2 as types whose members stand in the order of their definitions, which is that
//! of their bytes.

mod marker;

pub(super) use marker::{Marker, MarkerArray};

use byteorder::LittleEndian;
use serde::Serialize;
use std::io;
use trackdyn_core::Pose as PlanarPose;

/// A message that a topic carries.
pub(super) trait Message: Serialize {
    /// Its type.
    const KIND: &'static str;
}

/// The bytes of a message in the Common Data Representation.
pub(super) fn bytes(message: &impl Message) -> io::Result<Vec<u8>> {
    // the head says: CDR, little-endian, no options; alignment counts from after it
    let mut bytes = vec![0, 1, 0, 0];
    cdr_encoding::to_writer::<_, LittleEndian, _>(&mut bytes, message).map_err(io::Error::other)?;
    Ok(bytes)
}

/// `builtin_interfaces/Time`
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Time {
    sec: i32,
    nanosec: u32,
}

impl Time {
    /// A stamp, Unix time in nanoseconds before the year 2038.
    pub(super) fn new(stamp: u64) -> Self {
        const SECOND: u64 = 1_000_000_000;
        Self {
            sec: i32::try_from(stamp / SECOND).unwrap_or(i32::MAX),
            nanosec: u32::try_from(stamp % SECOND).unwrap_or_default(),
        }
    }
}

/// `std_msgs/Header`
#[derive(Debug, Serialize)]
pub(super) struct Header<'a> {
    stamp: Time,
    frame_id: &'a str,
}

impl<'a> Header<'a> {
    pub(super) fn new(stamp: u64, frame_id: &'a str) -> Self {
        Self { stamp: Time::new(stamp), frame_id }
    }
}

/// `geometry_msgs/Point` and `geometry_msgs/Vector3`
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(super) struct Vector {
    x: f64,
    y: f64,
    z: f64,
}

/// `geometry_msgs/Quaternion`
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Quaternion {
    x: f64,
    y: f64,
    z: f64,
    w: f64,
}

impl Quaternion {
    fn of_yaw(yaw: f64) -> Self {
        // q = (0, 0, sin ψ/2, cos ψ/2)
        let (z, w) = (yaw / 2.0).sin_cos();
        Self { x: 0.0, y: 0.0, z, w }
    }
}

/// `geometry_msgs/Pose`, and alike `geometry_msgs/Transform`
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Pose {
    position: Vector,
    orientation: Quaternion,
}

impl From<&PlanarPose> for Pose {
    fn from(&PlanarPose { x, y, yaw }: &PlanarPose) -> Self {
        Self { position: Vector { x, y, z: 0.0 }, orientation: Quaternion::of_yaw(yaw) }
    }
}

/// `geometry_msgs/PoseStamped`
#[derive(Debug, Serialize)]
pub(super) struct PoseStamped<'a> {
    pub(super) header: Header<'a>,
    pub(super) pose: Pose,
}

impl Message for PoseStamped<'_> {
    const KIND: &'static str = "geometry_msgs/msg/PoseStamped";
}

/// `nav_msgs/Path`
#[derive(Debug, Serialize)]
pub(super) struct Path<'a> {
    pub(super) header: Header<'a>,
    pub(super) poses: Vec<PoseStamped<'a>>,
}

impl Message for Path<'_> {
    const KIND: &'static str = "nav_msgs/msg/Path";
}

/// `geometry_msgs/TransformStamped`
#[derive(Debug, Serialize)]
pub(super) struct TransformStamped<'a> {
    pub(super) header: Header<'a>,
    pub(super) child_frame_id: &'a str,
    pub(super) transform: Pose,
}

/// `tf2_msgs/TFMessage`
#[derive(Debug, Serialize)]
pub(super) struct Transforms<'a> {
    pub(super) transforms: Vec<TransformStamped<'a>>,
}

impl Message for Transforms<'_> {
    const KIND: &'static str = "tf2_msgs/msg/TFMessage";
}

/// `sensor_msgs/JointState`
#[derive(Debug, Serialize)]
pub(super) struct JointState<'a> {
    pub(super) header: Header<'a>,
    pub(super) name: Vec<&'a str>,
    pub(super) position: Vec<f64>,
    pub(super) velocity: Vec<f64>,
    pub(super) effort: Vec<f64>,
}

impl Message for JointState<'_> {
    const KIND: &'static str = "sensor_msgs/msg/JointState";
}

/// `std_msgs/Float64`
#[derive(Debug, Serialize)]
pub(super) struct Float64 {
    pub(super) data: f64,
}

impl Message for Float64 {
    const KIND: &'static str = "std_msgs/msg/Float64";
}

/// `std_msgs/String`
#[derive(Debug, Serialize)]
pub(super) struct Text<'a> {
    pub(super) data: &'a str,
}

impl Message for Text<'_> {
    const KIND: &'static str = "std_msgs/msg/String";
}
