//! Options that several commands share.

use crate::stderr::say;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use trackdyn::crates::core::Pose;
use trackdyn::crates::core::document::Document;
use trackdyn::crates::model::effect::{Stage, Symmetry};
use trackdyn::crates::model::{ActiveEffect, Circumstance, Effects, Model, VehicleFile};
use trackdyn::crates::recording::rosbag::{JointSignal, RosbagOptions};
use trackdyn::crates::recording::{Format, Recording, RunList, tum};

/// The vehicle and its effects.
#[derive(Args)]
pub struct ModelOptions {
    /// Vehicle file (schema trackdyn.vehicle/1) [default: Auriga-alpha, embedded]
    #[arg(long, value_name = "FILE")]
    pub vehicle: Option<PathBuf>,
    /// Centre of gravity in m from the centre of the contact area: right, forward
    #[arg(long, value_name = "X,Y", value_parser = pair, allow_hyphen_values = true)]
    pub cog: Option<[f64; 2]>,
    /// Switch an effect on, with its typical size or this one; repeatable (see `trackdyn effects`)
    #[arg(long = "effect", value_name = "ID[:PARAMETER=VALUE,...]")]
    pub effects: Vec<ActiveEffect>,
}

impl ModelOptions {
    /// The vehicle file with the changes of the command line.
    ///
    /// # Errors
    /// A message that names the file, line and key, or the option.
    pub fn vehicle_file(&self) -> Result<VehicleFile, Box<dyn std::error::Error>> {
        let mut file = match &self.vehicle {
            Some(path) => read_vehicle(path)?,
            None => VehicleFile::auriga_alpha(),
        };
        if let Some(cog) = self.cog {
            file.vehicle.cog = cog;
            file.vehicle.uncertainty.cog = None; // the file's is of the value that this one replaces
            file.vehicle.check().map_err(|error| format!("--cog: {error}"))?;
        }
        if let Some(place) = repeated(&self.effects) {
            let id = self.effects[place].card().id;
            return Err(format!(
                "--effect {id}: given twice: expected once, with all its parameters"
            )
            .into());
        }
        for effect in &self.effects {
            let id = effect.card().id;
            if file.effects.get(id).is_some() {
                say(format_args!(
                    "note: --effect {effect} replaces the vehicle file's, all its parameters"
                ));
            }
            file.effects.insert(effect.clone());
        }
        Ok(file)
    }
}

/// Place of the first effect that is there before it already.
pub fn repeated(effects: &[ActiveEffect]) -> Option<usize> {
    let is_there = |place: &usize| {
        effects[..*place].iter().any(|other| other.card().id == effects[*place].card().id)
    };
    (0..effects.len()).find(is_there)
}

/// Where the robot stands.
#[derive(Args)]
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
pub struct CircumstanceOptions {
    #[command(flatten)]
    place: PlaceOptions,
    /// Time since the start of a recording in s, for effects that know times
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, value_parser = finite)]
    time: f64,
}

impl CircumstanceOptions {
    /// The place, heading and time.
    pub fn circumstance(&self) -> Circumstance {
        let Pose { x, y, yaw } = self.place.pose();
        Circumstance { position: [x, y], heading: yaw, time: self.time }
    }
}

/// The effects of a drive in time: with inertia, unless it is to be left out.
pub fn in_time(effects: Effects, quasi_static: bool) -> Effects {
    if quasi_static { effects.quasi_static() } else { effects.with_inertia() }
}

/// Notes which effects do nothing where no pose sensor reports.
pub fn note_what_no_sensor_reports(effects: &Effects) {
    for card in effects.iter().map(ActiveEffect::card).filter(|c| c.stages == [Stage::Sense]) {
        say(format_args!(
            "note: {} is of a pose sensor, and none reports here: it does nothing",
            card.id
        ));
    }
}

/// Notes which effects do not change the steady motion of the hull, whose ICRs are computed: those of the pose sensor, and those that
/// only changes of speed show.
pub fn note_what_steady_icrs_leave_out(effects: &Effects) {
    for card in effects.iter().map(ActiveEffect::card) {
        if card.stages == [Stage::Sense] || card.breaks == [Symmetry::Transient] {
            say(format_args!(
                "note: {} does not change the steady motion of the hull: these ICRs are without it",
                card.id
            ));
        }
    }
}

/// A recording, and how it is read.
#[derive(Args)]
pub struct RecordingOptions {
    /// Folder with recording.toml, rosbag2 (.mcap, .db3 or the folder around them), or trajectory of the
    /// TUM benchmark (.tum, .txt) with --tracks; for identify and diagnose also a table of steady operating points
    /// (.csv)
    pub recording: PathBuf,
    /// Trajectory: its track speeds, of the same clock (CSV with t, v_left, v_right)
    #[arg(long, value_name = "FILE")]
    tracks: Option<PathBuf>,
    /// Bag: topic of the joint states
    #[arg(long, value_name = "TOPIC")]
    tracks_topic: Option<String>,
    /// Bag: joint on the left, with `-` before it where it runs backwards; repeatable
    #[arg(long, value_name = "JOINT", allow_hyphen_values = true)]
    left_joint: Vec<String>,
    /// Bag: joint on the right, in the same way
    #[arg(long, value_name = "JOINT", allow_hyphen_values = true)]
    right_joint: Vec<String>,
    /// Bag: signal of the joints [default: velocity where there is one]
    #[arg(long, value_name = "SIGNAL")]
    joint_signal: Option<Signal>,
    /// Bag: belt travel in m per radian of the joints
    #[arg(long, value_name = "M", value_parser = positive)]
    wheel_radius: Option<f64>,
    /// Bag: topic of the poses
    #[arg(long, value_name = "TOPIC")]
    pose_topic: Option<String>,
    /// Bag: frame that the poses are expressed in; with --child-frame, transforms are chained where no
    /// topic has these poses
    #[arg(long, value_name = "FRAME")]
    parent_frame: Option<String>,
    /// Bag: frame whose poses they are
    #[arg(long, value_name = "FRAME")]
    child_frame: Option<String>,
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
    pub fn read(&self) -> Result<Recording, Box<dyn std::error::Error>> {
        self.read_path(&self.recording)
    }

    /// Reads another recording in the same way.
    ///
    /// # Errors
    /// As [`RecordingOptions::read`].
    pub fn read_path(&self, path: &Path) -> Result<Recording, Box<dyn std::error::Error>> {
        if !matches!(Format::of(path)?, Format::Rosbag)
            && let Some(option) = self.of_bags().first()
        {
            let name = path.display();
            return Err(format!("{option}: {name} is no bag: expected with rosbag2 only").into());
        }
        let recording = match tracks_of(path, self.tracks.as_deref())? {
            Some(tracks) => tum::read(path, tracks, "unknown")?,
            None => trackdyn::crates::recording::read(path, &self.rosbag())?,
        };
        for warning in recording.warnings() {
            say(format_args!("note: {warning}"));
        }
        Ok(recording)
    }

    /// The options given, all of which are about recordings of motion.
    pub fn given(&self) -> Vec<&'static str> {
        let tracks = self.tracks.as_ref().map(|_| "--tracks");
        tracks.into_iter().chain(self.of_bags()).collect()
    }

    /// The options given that only bags have something to say to.
    fn of_bags(&self) -> Vec<&'static str> {
        let options = [
            ("--tracks-topic", self.tracks_topic.is_some()),
            ("--left-joint", !self.left_joint.is_empty()),
            ("--right-joint", !self.right_joint.is_empty()),
            ("--joint-signal", self.joint_signal.is_some()),
            ("--wheel-radius", self.wheel_radius.is_some()),
            ("--pose-topic", self.pose_topic.is_some()),
            ("--parent-frame", self.parent_frame.is_some()),
            ("--child-frame", self.child_frame.is_some()),
        ];
        options.into_iter().filter_map(|(name, given)| given.then_some(name)).collect()
    }

    fn rosbag(&self) -> RosbagOptions {
        RosbagOptions {
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
            parent_frame: self.parent_frame.clone(),
            child_frame: self.child_frame.clone(),
            ..RosbagOptions::default()
        }
    }
}

/// The track speeds that a trajectory needs; none for a recording that has its own.
///
/// # Errors
/// Track speeds for a recording that has its own, a trajectory without any, no recording at all.
pub fn tracks_of<'a>(
    recording: &Path,
    tracks: Option<&'a Path>,
) -> Result<Option<&'a Path>, Box<dyn std::error::Error>> {
    let name = recording.display();
    match (Format::of(recording)?, tracks) {
        (Format::Tum, None) => {
            Err(format!("{name}: a trajectory has no track speeds: give them with --tracks").into())
        }
        (Format::Tum, tracks) | (_, tracks @ None) => Ok(tracks),
        (_, Some(_)) => Err(format!(
            "--tracks: {name} has track speeds of its own: only a .tum or .txt trajectory \
                         needs them"
        )
        .into()),
    }
}

/// Refuses options of recordings of motion for a table of steady points, which has no runs and no time.
///
/// # Errors
/// The options given, where there are any.
pub fn refuse_for_points(given: &[&str], table: &Path) -> Result<(), String> {
    if given.is_empty() {
        return Ok(());
    }
    let (given, name) = (given.join(", "), table.display());
    Err(format!("{given}: {name} holds steady points: expected with recordings of motion only"))
}

/// Which part of a recording counts, and how late its poses are.
#[derive(Args)]
pub struct DrivingOptions {
    #[command(flatten)]
    recording: RecordingOptions,
    /// Take these runs only, such as 7,8,20-29: fit on some, judge on others [default: all]
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    runs: Option<RunList>,
    /// Take this time of each run only, in s from its first reading: to split a recording of one run
    #[arg(long, value_name = "FROM,UNTIL", value_parser = time)]
    time: Option<[f64; 2]>,
    /// Time in s by which poses lag behind the track speeds [default: estimated]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    pub tau: Option<f64>,
}

impl DrivingOptions {
    /// Reads the recording, all of it.
    ///
    /// # Errors
    /// Those of [`RecordingOptions::read`].
    pub fn recording(&self) -> Result<Recording, Box<dyn std::error::Error>> {
        self.recording.read()
    }

    /// The recording as given.
    pub fn path(&self) -> &Path {
        &self.recording.recording
    }

    /// The part to take of a recording.
    ///
    /// # Errors
    /// A message with the option and what is not there.
    pub fn part(&self, recording: &Recording) -> Result<Recording, String> {
        let runs = match &self.runs {
            Some(list) => recording.of_runs(list).map_err(|error| format!("--runs: {error}"))?,
            None => recording.clone(),
        };
        match self.time {
            Some(time) => runs.within(time).map_err(|error| format!("--time: {error}")),
            None => Ok(runs),
        }
    }

    /// The options given here that mean something to recordings of motion alone.
    pub fn given(&self) -> Vec<&'static str> {
        let options = [
            ("--runs", self.runs.is_some()),
            ("--time", self.time.is_some()),
            ("--tau", self.tau.is_some()),
        ];
        let own = options.into_iter().filter_map(|(name, given)| given.then_some(name));
        self.recording.given().into_iter().chain(own).collect()
    }

    /// The time of each run that is taken, s; none: all of it.
    pub fn time(&self) -> Option<[f64; 2]> {
        self.time
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
fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.abs() <= 3600.0 => Ok(value),
        _ => Err("expected a number of seconds, such as 0.25, within an hour".to_owned()),
    }
}

/// What is wrong with a drive, in the words of the command line.
pub fn of_drive(error: &trackdyn::crates::drive::Error) -> String {
    match error {
        trackdyn::crates::drive::Error::Option { name, value, expected } => {
            format!("--{} {value}: expected {expected}", name.replace('_', "-"))
        }
        other => other.to_string(),
    }
}

/// Reads a vehicle file.
///
/// # Errors
/// A message that names file, line and key.
pub fn read_vehicle(path: &Path) -> Result<VehicleFile, Box<dyn std::error::Error>> {
    Ok(VehicleFile::from_document(&Document::read(path)?)?)
}

/// The model of a vehicle file.
pub fn model(file: &VehicleFile) -> Model {
    Model::new(file.vehicle.clone(), file.effects.clone())
}

/// The command line, for the head of files that are written.
pub fn command_line() -> String {
    let arguments = std::env::args_os().skip(1);
    let arguments = arguments.map(|argument| argument.to_string_lossy().into_owned());
    let words: Vec<String> = std::iter::once("trackdyn".to_owned()).chain(arguments).collect();
    words.join(" ")
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

/// A finite number from zero on.
///
/// # Errors
/// What was expected.
pub fn not_negative(text: &str) -> Result<f64, String> {
    match finite(text) {
        Ok(value) if value >= 0.0 => Ok(value),
        _ => Err("expected a number from zero on".to_owned()),
    }
}
