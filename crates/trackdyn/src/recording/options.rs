//! How a recording is read.

use super::BagOptions;
use crate::Error;
use std::path::{Path, PathBuf};
use trackdyn_recording::rosbag::{Dating, JointSignal};
use trackdyn_recording::{Columns, PoseAxes, PoseUnit};

/// How a recording is read. By default a bag is read by what it leaves no choice in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Trajectory: the table of its track speeds, by the same clock (CSV with t, v_left, v_right).
    pub tracks: Option<PathBuf>,
    /// One table of track speeds and poses: its columns.
    pub columns: Option<Columns>,
    /// Bag: topics, joints and frames; of recordings of all kinds, unit and sensor.
    pub bag: BagOptions,
}

impl ReadOptions {
    /// Names of the options that are set and of which a table of steady points has no use.
    pub fn given(&self) -> Vec<&'static str> {
        let bag = &self.bag;
        let options = [
            ("tracks", self.tracks.is_some()),
            ("columns", self.columns.is_some()),
            ("pose_unit", bag.pose_unit != PoseUnit::Metres),
            ("pose_axes", bag.pose_axes != PoseAxes::Ros),
            ("mount_yaw", bag.mount_yaw.is_some()),
            ("gyro_unit", bag.gyro_in_degrees),
            ("accepted", !bag.accepted.is_empty()),
        ];
        let given = options.into_iter().filter_map(|(name, given)| given.then_some(name));
        given.chain(self.of_bags()).collect()
    }

    /// Names of the options that are set and count for bags only.
    pub fn of_bags(&self) -> Vec<&'static str> {
        let bag = &self.bag;
        let options = [
            ("tracks_topic", bag.tracks_topic.is_some()),
            ("left_joints", !bag.left_joints.is_empty()),
            ("right_joints", !bag.right_joints.is_empty()),
            ("joint_signal", bag.joint_signal != JointSignal::Any),
            ("pose_topic", bag.pose_topic.is_some()),
            ("pose_index", bag.pose_index.is_some()),
            ("parent_frame", bag.parent_frame.is_some()),
            ("child_frame", bag.child_frame.is_some()),
            ("imu_topic", bag.imu_topic.is_some()),
            ("twist_topic", bag.twist_topic.is_some()),
            ("separation", bag.separation.is_some()),
            ("left_signals", !bag.left_signals.is_empty()),
            ("right_signals", !bag.right_signals.is_empty()),
            ("msg_dir", bag.msg_dir.is_some()),
            ("dated_by", bag.dated_by != Dating::Any),
        ];
        options.into_iter().filter_map(|(name, given)| given.then_some(name)).collect()
    }

    /// Refuses options of other formats for a table with named columns.
    pub(super) fn refuse_for_table(&self, table: &Path) -> Result<(), Error> {
        if self.tracks.is_some() {
            return Err(Error::TracksNotNeeded { path: table.to_owned() });
        }
        match self.of_bags().first() {
            Some(&setting) => Err(Error::NotABag { setting, path: table.to_owned() }),
            None => Ok(()),
        }
    }

    /// Refuses options of recordings of motion for a table of steady operating points.
    pub(super) fn refuse_for_points(&self, table: &Path) -> Result<(), Error> {
        match self.given() {
            given if given.is_empty() => Ok(()),
            settings => Err(Error::MotionOnly { settings, table: table.to_owned() }),
        }
    }
}
