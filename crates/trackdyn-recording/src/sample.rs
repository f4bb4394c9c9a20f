//! Samples and series of them.
//!
//! A series is an array of structs: whoever uses a sample uses all of it at once, and sorting or
//! dropping a row moves the row. Columns that the tool does not know stand beside, one array each.

use std::fmt::Debug;
use trackdyn_core::{PerSide, Pose, Side};

/// One row of a series: a time stamp and what was measured then.
pub trait Sample: Copy + Debug + PartialEq {
    /// The series it belongs to.
    const STREAM: Stream;
    /// Names of its columns; the first is the time.
    const COLUMNS: &'static [&'static str];
    /// How many of the columns, from the first on, a sample is nothing without. Others may be NaN:
    /// not measured.
    const NEEDED_COLUMNS: usize = Self::COLUMNS.len();

    /// The sample from its columns, in their order.
    fn from_columns(values: &[f64]) -> Self;

    /// Appends the columns, in their order.
    fn push_columns(&self, values: &mut Vec<f64>);

    /// Time stamp, s.
    fn time(&self) -> f64;
}

/// The series of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stream {
    /// Track speeds.
    Tracks,
    /// Poses.
    Poses,
    /// Readings of the IMU.
    Imu,
}

impl Stream {
    /// Its word in file names and messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tracks => "tracks",
            Self::Poses => "poses",
            Self::Imu => "imu",
        }
    }
}

/// Speeds of the belts relative to the hull, forward positive.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TrackSample {
    /// Time stamp, s.
    pub t: f64,
    /// Speed of the left track, m/s.
    pub v_left: f64,
    /// Speed of the right track, m/s.
    pub v_right: f64,
}

impl TrackSample {
    /// The speeds of both tracks, m/s.
    pub fn speeds(&self) -> PerSide<f64> {
        PerSide::new(self.v_left, self.v_right)
    }

    /// The speed of one track, m/s, to be mended.
    pub(crate) fn speed_mut(&mut self, side: Side) -> &mut f64 {
        match side {
            Side::Left => &mut self.v_left,
            Side::Right => &mut self.v_right,
        }
    }
}

/// Pose of the robot in the frame of its run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PoseSample {
    /// Time stamp, s.
    pub t: f64,
    /// `world_from_body`, REP-103 axes; yaw is not wrapped.
    pub pose: Pose,
}

/// Reading of an IMU whose axes are those of the body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ImuSample {
    /// Time stamp, s.
    pub t: f64,
    /// Yaw rate, counter-clockwise positive, rad/s.
    pub gyro_z: f64,
    /// Specific force forward, m/s²; NaN where it was not measured.
    pub acc_x: f64,
    /// Specific force to the left, m/s²; NaN where it was not measured.
    pub acc_y: f64,
}

impl Sample for TrackSample {
    const STREAM: Stream = Stream::Tracks;
    const COLUMNS: &'static [&'static str] = &["t", "v_left", "v_right"];

    fn from_columns(values: &[f64]) -> Self {
        Self { t: values[0], v_left: values[1], v_right: values[2] }
    }

    fn push_columns(&self, values: &mut Vec<f64>) {
        values.extend([self.t, self.v_left, self.v_right]);
    }

    fn time(&self) -> f64 {
        self.t
    }
}

impl Sample for PoseSample {
    const STREAM: Stream = Stream::Poses;
    const COLUMNS: &'static [&'static str] = &["t", "x", "y", "yaw"];

    fn from_columns(values: &[f64]) -> Self {
        Self { t: values[0], pose: Pose::new(values[1], values[2], values[3]) }
    }

    fn push_columns(&self, values: &mut Vec<f64>) {
        values.extend([self.t, self.pose.x, self.pose.y, self.pose.yaw]);
    }

    fn time(&self) -> f64 {
        self.t
    }
}

impl Sample for ImuSample {
    const STREAM: Stream = Stream::Imu;
    const COLUMNS: &'static [&'static str] = &["t", "gyro_z", "acc_x", "acc_y"];
    const NEEDED_COLUMNS: usize = 2;

    fn from_columns(values: &[f64]) -> Self {
        Self { t: values[0], gyro_z: values[1], acc_x: values[2], acc_y: values[3] }
    }

    fn push_columns(&self, values: &mut Vec<f64>) {
        values.extend([self.t, self.gyro_z, self.acc_x, self.acc_y]);
    }

    fn time(&self) -> f64 {
        self.t
    }
}

/// Samples in the order of their rows, with the columns that stood beside them.
#[derive(Clone, Debug, PartialEq)]
pub struct Series<S> {
    /// The samples.
    pub samples: Vec<S>,
    /// Further columns, each as long as `samples`.
    pub extra: Vec<Column>,
}

impl<S> Default for Series<S> {
    fn default() -> Self {
        Self { samples: Vec::new(), extra: Vec::new() }
    }
}

impl<S> From<Vec<S>> for Series<S> {
    fn from(samples: Vec<S>) -> Self {
        Self { samples, extra: Vec::new() }
    }
}

impl<S: Sample> Series<S> {
    /// These rows, in this order.
    pub fn part(&self, rows: &[usize]) -> Self {
        let column =
            |column: &Column| Column { name: column.name.clone(), cells: column.cells.part(rows) };
        Self {
            samples: rows.iter().map(|&row| self.samples[row]).collect(),
            extra: self.extra.iter().map(column).collect(),
        }
    }
}

/// A column that the tool does not know and keeps.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name in the header.
    pub name: String,
    /// Its cells.
    pub cells: Cells,
}

/// Cells of a column: numbers where all of them are numbers or empty.
#[derive(Clone, Debug)]
pub enum Cells {
    /// Numbers; an empty cell is NaN.
    Numbers(Vec<f64>),
    /// Texts as they stand in the file.
    Texts(Vec<String>),
}

/// Empty cells equal each other.
impl PartialEq for Cells {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Numbers(a), Self::Numbers(b)) => {
                a.len() == b.len()
                    && a.iter().zip(b).all(|(a, b)| a == b || (a.is_nan() && b.is_nan()))
            }
            (Self::Texts(a), Self::Texts(b)) => a == b,
            _ => false,
        }
    }
}

impl Cells {
    fn part(&self, rows: &[usize]) -> Self {
        match self {
            Self::Numbers(cells) => Self::Numbers(rows.iter().map(|&row| cells[row]).collect()),
            Self::Texts(cells) => Self::Texts(rows.iter().map(|&row| cells[row].clone()).collect()),
        }
    }
}
