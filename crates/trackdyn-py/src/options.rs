//! How a recording is read, and which part of it counts: keywords of Python.

use crate::errors::refused;
use pyo3::prelude::*;
use std::fmt::Display;
use std::path::PathBuf;
use std::str::FromStr;
use trackdyn::crates::recording::rosbag::{Dating, JointSignal};
use trackdyn::recording::{BagOptions, PoseAxes};
use trackdyn::{Part, ReadOptions};

/// The keywords of reading, as a dict of all of them.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Reading {
    tracks: Option<PathBuf>,
    columns: Option<String>,
    tracks_topic: Option<String>,
    left_joints: Vec<String>,
    right_joints: Vec<String>,
    joint_signal: Option<String>,
    wheel_radius: Option<f64>,
    pose_topic: Option<String>,
    pose_index: Option<usize>,
    parent_frame: Option<String>,
    child_frame: Option<String>,
    imu_topic: Option<String>,
    twist_topic: Option<String>,
    separation: Option<f64>,
    left_signals: Vec<String>,
    right_signals: Vec<String>,
    speed_unit: Option<String>,
    msg_dir: Option<PathBuf>,
    dated_by: Option<String>,
    pose_unit: Option<String>,
    pose_axes: Option<String>,
    mount_yaw: Option<f64>,
    gyro_unit: Option<String>,
    accept: Vec<String>,
}

impl Reading {
    /// The options of the library.
    pub fn options(self) -> PyResult<ReadOptions> {
        let joint_signal = named(
            "joint_signal",
            self.joint_signal,
            &[("velocity", JointSignal::Velocity), ("position", JointSignal::Position)],
        )?;
        let dated_by =
            named("dated_by", self.dated_by, &[("header", Dating::Header), ("log", Dating::Log)])?;
        let in_degrees = named("gyro_unit", self.gyro_unit, &[("rad/s", false), ("deg/s", true)])?;
        let pose_axes = named(
            "pose_axes",
            self.pose_axes,
            &[("ros", PoseAxes::Ros), ("ned", PoseAxes::NorthEastDown)],
        )?;
        let pose_unit = self.pose_unit.map(|text| parsed("pose_unit", &text));
        let accepted = self.accept.into_iter().map(|doubt| parsed("accept", &doubt));
        Ok(ReadOptions {
            tracks: self.tracks,
            columns: self.columns.map(|text| parsed("columns", &text)).transpose()?,
            bag: BagOptions {
                tracks_topic: self.tracks_topic,
                left_joints: self.left_joints,
                right_joints: self.right_joints,
                joint_signal: joint_signal.unwrap_or_default(),
                wheel_radius: positive("wheel_radius", self.wheel_radius)?,
                pose_topic: self.pose_topic,
                pose_index: self.pose_index,
                parent_frame: self.parent_frame,
                child_frame: self.child_frame,
                imu_topic: self.imu_topic,
                twist_topic: self.twist_topic,
                separation: positive("separation", self.separation)?,
                left_signals: self.left_signals,
                right_signals: self.right_signals,
                speed_unit: self.speed_unit.map(|text| parsed("speed_unit", &text)).transpose()?,
                msg_dir: self.msg_dir,
                dated_by: dated_by.unwrap_or_default(),
                pose_unit: pose_unit.transpose()?.unwrap_or_default(),
                pose_axes: pose_axes.unwrap_or_default(),
                mount_yaw: self.mount_yaw,
                gyro_in_degrees: in_degrees.unwrap_or_default(),
                accepted: accepted.collect::<PyResult<_>>()?,
            },
        })
    }
}

/// The part of a recording that counts: a list of runs such as `7,8,20-29`, and a time of each, s.
pub fn part(runs: Option<&str>, time: Option<[f64; 2]>) -> PyResult<Part> {
    if let Some([from, until]) = time.filter(|[from, until]| from >= until) {
        let expected = "expected the beginning and the end in s, such as 0,600";
        return Err(refused("time", format!("{from},{until}"), expected));
    }
    Ok(Part { runs: runs.map(|text| parsed("runs", text)).transpose()?, time })
}

/// What a text stands for.
pub fn parsed<T: FromStr>(setting: &str, text: &str) -> PyResult<T>
where
    T::Err: Display,
{
    text.parse().map_err(|error: T::Err| refused(setting, text, &error.to_string()))
}

/// A finite number above zero, where there is one.
fn positive(setting: &str, value: Option<f64>) -> PyResult<Option<f64>> {
    match value {
        Some(value) if !(value > 0.0 && value.is_finite()) => {
            Err(refused(setting, value, "expected a number above zero"))
        }
        value => Ok(value),
    }
}

/// What a name stands for, where there is one.
pub fn named<T: Copy>(
    setting: &str,
    name: Option<String>,
    known: &[(&str, T)],
) -> PyResult<Option<T>> {
    let Some(name) = name else { return Ok(None) };
    let found = known.iter().find(|(other, _)| *other == name);
    let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
    let expected = || refused(setting, &name, &format!("expected one of {}", names.join(", ")));
    found.map(|(_, value)| Some(*value)).ok_or_else(expected)
}
