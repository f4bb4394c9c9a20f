//! A continuous part of a recording.

use super::cleaning::{clean, unwrap_yaw};
use super::finding::Cleaning;
use super::positions::settle;
use super::spikes::mend;
use crate::sample::{ImuSample, PoseSample, Series, TrackSample};
use trackdyn_core::Pose;

/// The rows of a run as a reader found them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UncheckedRun {
    /// Its number in the recording.
    pub id: i64,
    /// Track speeds.
    pub tracks: Series<TrackSample>,
    /// Poses.
    pub poses: Series<PoseSample>,
    /// Readings of the IMU; empty where there is none.
    pub imu: Series<ImuSample>,
}

/// Axes in which poses are told.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PoseAxes {
    /// Those of ROS (REP-103): y to the left of x, yaw counter-clockwise.
    #[default]
    Ros,
    /// North, east, down, as in aircraft: y to the right of x, yaw clockwise.
    NorthEastDown,
}

impl PoseAxes {
    /// Its name, as the option takes it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ros => "ros",
            Self::NorthEastDown => "ned",
        }
    }

    /// A pose in the axes of ROS.
    pub(crate) fn to_ros(self, pose: Pose) -> Pose {
        match self {
            Self::Ros => pose,
            Self::NorthEastDown => Pose::new(pose.x, -pose.y, -pose.yaw),
        }
    }
}

/// Takes poses of a sensor to those of the robot in the axes of ROS. It is mounted on the robot at
/// a yaw, rad; where it is mounted is another matter.
pub(crate) fn turn_sensor(runs: &mut [UncheckedRun], axes: PoseAxes, yaw: Option<f64>) {
    for sample in runs.iter_mut().flat_map(|run| &mut run.poses.samples) {
        sample.pose = axes.to_ros(sample.pose);
        // world_from_body = world_from_sensor · sensor_from_body
        sample.pose.yaw -= yaw.unwrap_or_default();
    }
}

/// A continuous stretch of driving, cleaned.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    id: i64,
    tracks: Series<TrackSample>,
    poses: Series<PoseSample>,
    imu: Series<ImuSample>,
    has_positions: bool,
}

impl Run {
    /// Cleans the rows; `cleanings` takes what was found.
    pub fn new(mut rows: UncheckedRun, cleanings: &mut Vec<Cleaning>) -> Self {
        let has_positions = settle(&mut rows.poses.samples, &rows.tracks.samples);
        clean(&mut rows.tracks, rows.id, cleanings);
        clean(&mut rows.poses, rows.id, cleanings);
        clean(&mut rows.imu, rows.id, cleanings);
        unwrap_yaw(&mut rows.poses.samples, rows.id, cleanings);
        Self { id: rows.id, tracks: rows.tracks, poses: rows.poses, imu: rows.imu, has_positions }
    }

    /// This run with its spikes mended: once, where it is read, for a part of it has another
    /// spread. `usual` is the largest usual speed, m/s.
    pub(super) fn mended(mut self, usual: f64, cleanings: &mut Vec<Cleaning>) -> Self {
        let dropped = mend(&mut self.tracks.samples, usual, self.id, cleanings);
        if !dropped.is_empty() {
            let rows = 0..self.tracks.samples.len();
            let kept = rows.filter(|row| dropped.binary_search(row).is_err());
            self.keep_readings(&kept.collect::<Vec<_>>());
        }
        self
    }

    /// Replaces the readings of the tracks by some of them, with the columns beside them.
    pub(super) fn keep_readings(&mut self, rows: &[usize]) {
        self.tracks = self.tracks.part(rows);
    }

    /// Replaces the poses by some of them, with the columns beside them.
    pub(super) fn keep_poses(&mut self, rows: &[usize]) {
        self.poses = self.poses.part(rows);
    }

    /// Replaces the readings of the IMU by some of them, with the columns beside them.
    pub(super) fn keep_imu(&mut self, rows: &[usize]) {
        self.imu = self.imu.part(rows);
    }

    /// Leaves out the readings of the IMU.
    pub(super) fn drop_imu(&mut self) {
        self.imu = Series::default();
    }

    /// The readings of the tracks, to mend single ones.
    pub(super) fn readings_mut(&mut self) -> &mut [TrackSample] {
        &mut self.tracks.samples
    }

    /// The poses, to mend their stamps or positions.
    pub(super) fn poses_mut(&mut self) -> &mut [PoseSample] {
        &mut self.poses.samples
    }

    /// This run with positions as well known as those of the run that it is a part of.
    pub(crate) fn with_positions_of(self, whole: &Self) -> Self {
        self.with_positions(whole.has_positions)
    }

    /// This run by another number.
    pub(super) fn with_id(self, id: i64) -> Self {
        Self { id, ..self }
    }

    /// This run, of whose positions it is known whether they were measured.
    pub(super) fn with_positions(self, has_positions: bool) -> Self {
        Self { has_positions, ..self }
    }

    /// Whether the positions of its poses are known. Where they are not, x and y are 0 throughout
    /// and only yaw was measured.
    pub fn has_positions(&self) -> bool {
        self.has_positions
    }

    /// Whether it has readings, and poses enough for a motion.
    pub(crate) fn is_usable(&self) -> bool {
        !self.tracks().is_empty() && self.poses().len() >= 2
    }

    /// Time from the first reading of the tracks to the first pose, s, where all poses lie before
    /// the first reading or after the last; none where they share a time.
    pub(crate) fn offset_without_common_time(&self) -> Option<f64> {
        let ([pose, .., last_pose], [reading, ..]) = (self.poses(), self.tracks()) else {
            return None;
        };
        let end = reading.t + self.duration();
        (pose.t > end || last_pose.t < reading.t).then_some(pose.t - reading.t)
    }

    /// Its number in the recording.
    pub fn id(&self) -> i64 {
        self.id
    }

    /// Track speeds, in the order of time.
    pub fn tracks(&self) -> &[TrackSample] {
        &self.tracks.samples
    }

    /// Poses, in the order of time.
    pub fn poses(&self) -> &[PoseSample] {
        &self.poses.samples
    }

    /// Readings of the IMU, in the order of time; empty where there is none.
    pub fn imu(&self) -> &[ImuSample] {
        &self.imu.samples
    }

    /// Track speeds with the columns beside them.
    pub fn track_series(&self) -> &Series<TrackSample> {
        &self.tracks
    }

    /// Poses with the columns beside them.
    pub fn pose_series(&self) -> &Series<PoseSample> {
        &self.poses
    }

    /// Readings of the IMU with the columns beside them.
    pub fn imu_series(&self) -> &Series<ImuSample> {
        &self.imu
    }

    /// Time from the first to the last reading of the tracks, s.
    pub fn duration(&self) -> f64 {
        match self.tracks.samples.as_slice() {
            [first, .., last] => last.t - first.t,
            _ => 0.0,
        }
    }

    /// The rows, to change and check again.
    pub fn into_rows(self) -> UncheckedRun {
        UncheckedRun { id: self.id, tracks: self.tracks, poses: self.poses, imu: self.imu }
    }
}
