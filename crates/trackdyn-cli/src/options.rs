//! Options that several commands share.

mod method;
mod replay;
mod vehicle;

pub use method::{MethodOptions, held_out};
pub use replay::ReplayOptions;
pub use vehicle::{GaugeOptions, ModelOptions, say_default};

use crate::stderr::note;
use crate::wording::option;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use trackdyn::crates::core::real;
use trackdyn::recording::{BagOptions, Columns, Dating, DoubtKind, JointSignal};
use trackdyn::recording::{PoseAxes, PoseUnit, SpeedUnit};
use trackdyn::{ActiveEffect, Circumstance, Part, ReadOptions, Recording, RunList, Symmetry};
use trackdyn::{Effects, Limits, Pose, Stage};

/// Headings of groups of options in helps.
const PLACE: &str = "Place and time";
const READING: &str = "How the recording is read";
pub const PART: &str = "What of the recording counts";
const VEHICLE: &str = "Vehicle";

/// Where the robot stands.
#[derive(Args)]
#[command(next_help_heading = PLACE)]
pub struct PlaceOptions {
    /// Heading of the robot in the world in degrees, for effects that know directions
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_hyphen_values = true,
          value_parser = finite)]
    heading: f64,
    /// Place of the robot in the world in m, for effects that know places
    #[arg(long, value_name = "X,Y", value_parser = pair, allow_hyphen_values = true)]
    position: Option<[f64; 2]>,
}

impl PlaceOptions {
    /// The pose (REP-103).
    pub fn pose(&self) -> Pose {
        let [x, y] = self.position.unwrap_or_default();
        Pose::new(x, y, self.heading.to_radians())
    }
}

/// Where the robot stands, and when.
#[derive(Args)]
#[command(next_help_heading = PLACE)]
pub struct CircumstanceOptions {
    #[command(flatten)]
    place: PlaceOptions,
    /// Time since the start of a recording in s, for effects that know times
    #[arg(long = "at-time", alias = "time", value_name = "SECONDS", default_value_t = 0.0,
          value_parser = finite)]
    time: f64,
}

impl CircumstanceOptions {
    /// The place, heading and time.
    pub fn circumstance(&self) -> Circumstance {
        let Pose { x, y, yaw } = self.place.pose();
        Circumstance { position: [x, y], heading: yaw, time: self.time }
    }
}

/// Notes which effects do nothing where no pose sensor reports.
pub fn note_what_no_sensor_reports(effects: &Effects) {
    for card in effects.iter().map(ActiveEffect::card).filter(|c| c.stages == [Stage::Sense]) {
        note(format_args!(
            "{} is of a pose sensor, and none reports here: it does nothing",
            card.id
        ));
    }
}

/// Notes which effects do not change the steady motion of the hull, whose ICRs are computed: those
/// of the pose sensor, and those that only changes of speed show.
pub fn note_what_steady_icrs_leave_out(effects: &Effects) {
    for card in effects.iter().map(ActiveEffect::card) {
        if card.stages == [Stage::Sense] || card.breaks == [Symmetry::Transient] {
            note(format_args!(
                "{} does not change the steady motion of the hull: these ICRs are without it",
                card.id
            ));
        }
    }
}

/// A recording, and how it is read.
#[derive(Args)]
#[command(next_help_heading = READING)]
pub struct RecordingOptions {
    /// Folder with recording.toml, bag of ROS (.mcap, .db3, .bag or their folder), or trajectory
    /// of the TUM benchmark (.tum, .txt) with --tracks, or one table of both (.csv) with --columns;
    /// for identify and diagnose also a table of steady operating points (.csv)
    #[arg(help_heading = None::<&str>)]
    pub recording: PathBuf,
    /// Trajectory: its track speeds, of the same clock (CSV with t, v_left, v_right)
    #[arg(long, value_name = "FILE")]
    tracks: Option<PathBuf>,
    /// One table of track speeds and poses (.csv): its columns by key, with a unit after a colon
    /// and a `-` before a sign that is wrong, such as
    /// t=Time:ms,v_l=left:rpm,v_r=-right:rpm,x=px:mm,y=py:mm,yaw=heading:deg. Units: s, ms, us, ns,
    /// min, h, d; those of --speed-unit; m, cm, mm, km, ft; rad, deg, compass (clockwise from
    /// north, x east); rad/s, deg/s. t_ns adds nanoseconds to t; lat and lon (degrees) may stand
    /// for x and y, and qx, qy, qz, qw for yaw, which may stand without x and y; gyro_z is the yaw
    /// rate of a gyroscope, beside poses or in their place; run parts the table into runs
    #[arg(long, value_name = "KEY=COLUMN,...")]
    columns: Option<Columns>,
    /// Bag: topic of the joint states
    #[arg(long, value_name = "TOPIC")]
    tracks_topic: Option<String>,
    /// Bag: joint on the left, with `-` before it where it runs backwards; repeatable
    #[arg(long, value_name = "JOINT", allow_hyphen_values = true)]
    left_joint: Vec<String>,
    /// Bag: joint on the right, in the same way
    #[arg(long, value_name = "JOINT", allow_hyphen_values = true)]
    right_joint: Vec<String>,
    /// Bag: signal of the joints [default: velocity where there is one]; position also reads the
    /// numbers of --left-signal and --right-signal as angles or ticks
    #[arg(long, value_name = "SIGNAL")]
    joint_signal: Option<Signal>,
    /// Belt travel in m per radian of the joints of a bag, or of wheels (--speed-unit), or per unit
    /// of numbers that are positions (--joint-signal)
    #[arg(long, value_name = "M", value_parser = positive)]
    wheel_radius: Option<f64>,
    /// Bag: topic of the poses
    #[arg(long, value_name = "TOPIC")]
    pose_topic: Option<String>,
    /// Bag: which pose of a PoseArray is that of the robot, from 0
    #[arg(long, value_name = "N", value_parser = count)]
    pose_index: Option<usize>,
    /// Bag: frame that the poses are expressed in; with --child-frame, transforms are chained where
    /// no topic has these poses
    #[arg(long, value_name = "FRAME")]
    parent_frame: Option<String>,
    /// Bag: frame whose poses they are
    #[arg(long, value_name = "FRAME")]
    child_frame: Option<String>,
    /// Bag: topic of the IMU, where it has several; --pose-topic with that of an IMU takes the yaw
    /// of its gyroscope in place of poses
    #[arg(long, value_name = "TOPIC")]
    imu_topic: Option<String>,
    /// Bag without joints: topic of a twist (Odometry, Twist, TwistStamped) that track speeds are
    /// computed from; right only where its driver computes it from the encoders alone
    #[arg(long, value_name = "TOPIC")]
    twist_topic: Option<String>,
    /// Bag without joints: separation in m that the driver of --twist-topic computes with
    #[arg(long, value_name = "M", value_parser = positive)]
    separation: Option<f64>,
    /// Bag without joints: number that is a speed of the left side, such as
    /// /status:motors[0].rpm, with `-` before it where it runs backwards; repeatable
    #[arg(long, value_name = "TOPIC:FIELD", allow_hyphen_values = true)]
    left_signal: Vec<String>,
    /// Bag without joints: number of the right side, in the same way
    #[arg(long, value_name = "TOPIC:FIELD", allow_hyphen_values = true)]
    right_signal: Vec<String>,
    /// Unit of the track speeds: m/s, mm/s, cm/s, km/h, mph, ft/s, or of wheels, with
    /// --wheel-radius, rad/s, rpm, turns/s, deg/s [default: of a bag rad/s, of a table m/s]
    #[arg(long, value_name = "UNIT", alias = "signal-unit")]
    speed_unit: Option<SpeedUnit>,
    /// Folder of definitions (PACKAGE/msg/TYPE.msg) for signals of a bag that has none
    #[arg(long, value_name = "DIR")]
    msg_dir: Option<PathBuf>,
    /// Bag: what dates its messages [default: their headers, or the log where clocks differ]
    #[arg(long, value_name = "CLOCK")]
    dated_by: Option<DatedBy>,
    /// Unit of x and y of the poses: m, mm, cm, ft, in; not of satellite fixes [default: m]
    #[arg(long, value_name = "UNIT")]
    pose_unit: Option<PoseUnit>,
    /// Axes of the poses: ned has y to the right of x and counts yaw clockwise [default: ros]
    #[arg(long, value_name = "AXES")]
    pose_axes: Option<Axes>,
    /// Yaw in degrees of the pose sensor on the robot: 180 where it faces backwards
    #[arg(long, value_name = "DEG", value_parser = finite, allow_hyphen_values = true)]
    mount_yaw: Option<f64>,
    /// Unit of the yaw rates of the IMU [default: rad/s]
    #[arg(long, value_name = "UNIT")]
    gyro_unit: Option<GyroUnit>,
    /// Read a recording in spite of a doubt, where you know better; repeatable: travel, stamps,
    /// yaw-unit, orientation, out-of-plane, signs, dead-encoder, stuck-poses, gyro-range
    #[arg(long, value_name = "DOUBT")]
    accept: Vec<DoubtKind>,
}

/// Axes in which poses are told.
#[derive(Clone, Copy, ValueEnum)]
enum Axes {
    /// x forward or east, y to its left, yaw counter-clockwise (REP-103)
    Ros,
    /// North, east, down: y to the right of x, yaw clockwise
    Ned,
}

/// Units of the yaw rates of an IMU.
#[derive(Clone, Copy, ValueEnum)]
enum GyroUnit {
    /// Radians per second
    #[value(name = "rad/s")]
    Radians,
    /// Degrees per second
    #[value(name = "deg/s")]
    Degrees,
}

/// What dates the messages of a bag.
#[derive(Clone, Copy, ValueEnum)]
enum DatedBy {
    /// The stamps in their headers
    Header,
    /// The times at which they were logged
    Log,
}

/// Signals of a joint.
#[derive(Clone, Copy, ValueEnum)]
enum Signal {
    /// Its speed
    Velocity,
    /// Its angle, which may wrap after a turn
    Position,
}

impl RecordingOptions {
    /// Reads the recording; what was cleaned or left out goes to stderr.
    ///
    /// # Errors
    /// A message that names the file and, where there is one, line and column.
    pub fn read(&self) -> Result<Recording, trackdyn::Error> {
        self.read_path(&self.recording)
    }

    /// Reads another recording in the same way.
    ///
    /// # Errors
    /// As [`RecordingOptions::read`].
    pub fn read_path(&self, path: &Path) -> Result<Recording, trackdyn::Error> {
        let recording = Recording::open(path, &self.options())?;
        for warning in recording.warnings() {
            note(format_args!("{warning}"));
        }
        Ok(recording)
    }

    /// Reads recordings in the same way, and takes of each the part that counts.
    ///
    /// # Errors
    /// As [`RecordingOptions::read`], and a part that is not there.
    pub fn read_all<'a>(
        &self,
        paths: impl IntoIterator<Item = &'a PathBuf>,
        part: &Part,
    ) -> Result<Vec<Recording>, trackdyn::Error> {
        paths.into_iter().map(|path| self.read_path(path)?.part(part)).collect()
    }

    /// The options given, all of which are about recordings of motion.
    pub fn given(&self) -> Vec<String> {
        self.options().given().into_iter().map(option).collect()
    }

    /// How it is read.
    pub fn options(&self) -> ReadOptions {
        ReadOptions {
            tracks: self.tracks.clone(),
            columns: self.columns.clone(),
            bag: BagOptions {
                tracks_topic: self.tracks_topic.clone(),
                left_joints: self.left_joint.clone(),
                right_joints: self.right_joint.clone(),
                joint_signal: match self.joint_signal {
                    None => JointSignal::Any,
                    Some(Signal::Velocity) => JointSignal::Velocity,
                    Some(Signal::Position) => JointSignal::Position,
                },
                wheel_radius: self.wheel_radius,
                pose_topic: self.pose_topic.clone(),
                pose_index: self.pose_index,
                parent_frame: self.parent_frame.clone(),
                child_frame: self.child_frame.clone(),
                imu_topic: self.imu_topic.clone(),
                twist_topic: self.twist_topic.clone(),
                separation: self.separation,
                left_signals: self.left_signal.clone(),
                right_signals: self.right_signal.clone(),
                speed_unit: self.speed_unit,
                msg_dir: self.msg_dir.clone(),
                dated_by: match self.dated_by {
                    None => Dating::Any,
                    Some(DatedBy::Header) => Dating::Header,
                    Some(DatedBy::Log) => Dating::Log,
                },
                pose_unit: self.pose_unit.unwrap_or_default(),
                pose_axes: match self.pose_axes {
                    None | Some(Axes::Ros) => PoseAxes::Ros,
                    Some(Axes::Ned) => PoseAxes::NorthEastDown,
                },
                mount_yaw: self.mount_yaw.map(f64::to_radians),
                gyro_in_degrees: matches!(self.gyro_unit, Some(GyroUnit::Degrees)),
                accepted: self.accept.clone(),
            },
        }
    }
}

/// Refuses options of recordings of motion for a table of steady points, which has no runs and no
/// time.
///
/// # Errors
/// The options given, where there are any and the recording is a table.
pub fn refuse_for_points(given: &[String], recording: &Path) -> Result<(), String> {
    match Recording::points_file(recording) {
        Some(table) if !given.is_empty() && !given.iter().any(|name| name == "--columns") => {
            let (given, name) = (given.join(", "), table.display());
            Err(format!(
                "{given}: {name} holds steady points: expected with recordings of motion only"
            ))
        }
        _ => Ok(()),
    }
}

/// Which part of a recording counts.
#[derive(Args)]
#[command(next_help_heading = PART)]
pub struct PartOptions {
    /// Take these runs only, such as 7,8,20-29: fit on some, judge on others [default: all]
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    runs: Option<RunList>,
    /// Take this time of each run only, in s from its first reading: to split a recording of one
    /// run
    #[arg(long, value_name = "FROM,UNTIL", value_parser = time)]
    time: Option<[f64; 2]>,
}

impl PartOptions {
    /// The part of the recording to take.
    pub fn part(&self) -> Part {
        Part { runs: self.runs.clone(), time: self.time }
    }

    /// The options given, which mean something to recordings of motion alone.
    pub fn given(&self) -> impl Iterator<Item = String> {
        let options = [("--runs", self.runs.is_some()), ("--time", self.time.is_some())];
        options.into_iter().filter(|(_, given)| *given).map(|(name, _)| name.to_owned())
    }
}

/// A recording, which part of it counts, and how late its poses are.
#[derive(Args)]
#[command(next_help_heading = PART)]
pub struct DrivingOptions {
    #[command(flatten)]
    recording: RecordingOptions,
    #[command(flatten)]
    part: PartOptions,
    /// Time in s by which poses lag behind the track speeds [default: estimated]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    pub tau: Option<f64>,
}

impl DrivingOptions {
    /// Reads the recording, all of it.
    ///
    /// # Errors
    /// Those of [`RecordingOptions::read`].
    pub fn recording(&self) -> Result<Recording, trackdyn::Error> {
        self.recording.read()
    }

    /// How it is read.
    pub fn read_options(&self) -> ReadOptions {
        self.recording.options()
    }

    /// The recording as given.
    pub fn path(&self) -> &Path {
        &self.recording.recording
    }

    /// The part of the recording to take.
    pub fn part(&self) -> Part {
        self.part.part()
    }

    /// The options given here that mean something to recordings of motion alone.
    pub fn given(&self) -> Vec<String> {
        let tau = self.tau.map(|_| "--tau".to_owned());
        self.recording.given().into_iter().chain(self.part.given()).chain(tau).collect()
    }
}

/// A beginning and an end, s.
fn time(text: &str) -> Result<[f64; 2], String> {
    match pair(text) {
        Ok([from, until]) if from < until => Ok([from, until]),
        _ => Err("expected the beginning and the end in s, such as 0,600".to_owned()),
    }
}

/// Seconds of a clock offset.
///
/// # Errors
/// What was expected.
pub fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.abs() <= 3600.0 => Ok(value),
        _ => Err("expected a number of seconds, such as 0.25, within an hour".to_owned()),
    }
}

/// Two numbers, separated by a comma.
///
/// # Errors
/// What was expected.
pub fn pair(text: &str) -> Result<[f64; 2], String> {
    let expected = || "expected two numbers separated by a comma, such as -0.015,0.04".to_owned();
    let (first, second) = text.split_once(',').ok_or_else(expected)?;
    let number = |text: &str| finite(text.trim()).map_err(|_| expected());
    Ok([number(first)?, number(second)?])
}

/// A finite number.
///
/// # Errors
/// What was expected.
pub fn finite(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err("expected a finite number".to_owned()),
    }
}

/// A whole number from zero on.
///
/// # Errors
/// What was expected.
pub fn count(text: &str) -> Result<usize, String> {
    text.parse().map_err(|_| "expected a whole number".to_owned())
}

/// A finite number above zero.
///
/// # Errors
/// What was expected.
pub fn positive(text: &str) -> Result<f64, String> {
    match finite(text) {
        Ok(value) if value > 0.0 => Ok(value),
        _ => Err("expected a number above zero".to_owned()),
    }
}

/// A number. The library says which ones it takes.
///
/// # Errors
/// What was expected.
pub fn number(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| "expected a number".to_owned())
}

/// A number within the limits of a setting.
///
/// # Errors
/// What was expected.
pub fn within(text: &str, limits: Limits) -> Result<f64, String> {
    let value = text.parse().ok().filter(|value| limits.hold(*value));
    value.ok_or_else(|| format!("expected {limits}"))
}

/// A number of things within the limits of a setting.
///
/// # Errors
/// What was expected.
pub fn count_within(text: &str, limits: Limits) -> Result<usize, String> {
    let count = text.parse().ok().filter(|count| limits.hold(real(*count)));
    count.ok_or_else(|| format!("expected {limits}"))
}
