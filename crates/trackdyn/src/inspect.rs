//! Judging a recording: what is there, what is missing for which use, what looks wrong.

mod bag;
mod choice;
mod driving;
mod finding;
mod lack;
mod over_time;
mod readiness;
mod travel;

pub use driving::{Driving, Rows};
pub use finding::Finding;
pub use lack::Lack;
pub use over_time::OverTime;
pub use readiness::{Readiness, Use, Verdict};

use crate::change::Folder;
use crate::recording::{PointsTable, Topic};
use crate::{Change, Error, Gauge, Parameters, Part, Provenance, ReadOptions, Recording};
use choice::Choice;
use std::path::{Path, PathBuf};
use trackdyn_core::input::name_of;
use trackdyn_recording::rosbag;
use trackdyn_recording::{Format, Recording as Motion, tum};

/// Name of the picture.
pub const FILE: &str = "inspect.png";

/// How to judge a recording.
#[derive(Clone, Debug, Default)]
pub struct InspectSettings {
    /// How it is read. What a bag needs beyond that is found where it can be.
    pub read: ReadOptions,
    /// The part of it to judge. Default: all.
    pub part: Part,
    /// Time by which poses lag behind the track speeds, s. Default: estimated.
    pub tau: Option<f64>,
    /// The gauge, by which ICRs are judged. Default: not known.
    pub gauge: Option<Gauge>,
    /// Parameters that predict the yaw rate. Default: the distance of the ICRs that fits best.
    pub parameters: Option<Parameters>,
}

/// What a recording holds.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Content {
    /// Track speeds and poses.
    Motion(Box<Driving>),
    /// A table of steady operating points.
    Points(PointsTable),
    /// A trajectory without track speeds.
    Poses(Rows),
    /// A bag that cannot be read so: why.
    Unread(String),
}

/// A recording with its judgement.
#[derive(Clone, Debug)]
pub struct Inspection {
    /// Its name.
    pub name: String,
    /// The gauge that ICRs were judged by, and its vehicle; none where it is not known.
    pub gauge: Option<Gauge>,
    /// Fingerprint of what was read; none where it cannot be read.
    pub fingerprint: Option<String>,
    /// The topics, where it is a bag.
    pub topics: Vec<Topic>,
    /// What it holds.
    pub content: Content,
    /// What was taken where there was a choice, and by what it was dated.
    pub taken: Vec<String>,
    /// What looks wrong.
    pub findings: Vec<Finding>,
    /// What it lacks.
    pub lacks: Vec<Lack>,
    /// What it is good for.
    pub readiness: Vec<Readiness>,
    /// The options with which to go on: those given, and those that it needs.
    pub options: ReadOptions,
    /// Options by any of which it can be read, where the choice among them is left to the user.
    pub choices: Vec<ReadOptions>,
    /// Two parts of it, to fit on one and to judge on the other; none where it is too short, or
    /// where a part is given.
    pub parts: Option<[Part; 2]>,
    /// Speeds and yaw rates over time; none without track speeds and poses.
    pub over_time: Option<OverTime>,
}

/// Judges a recording: reads it, tries to identify the robot by it, and says what stands in the
/// way.
///
/// # Errors
/// Those of [`Recording::open`] for what is no recording, or is damaged so that nothing of it can
/// be read. A bag that has topics and cannot be used is judged ([`Content::Unread`]).
pub fn inspect(path: impl AsRef<Path>, settings: &InspectSettings) -> Result<Inspection, Error> {
    let path = path.as_ref();
    if settings.read.columns.is_some() {
        let recording = Recording::open(path, &settings.read)?.part(&settings.part)?;
        return Ok(Inspection::of_motion(&recording, 1.0, settings));
    }
    if Recording::points_file(path).is_some() {
        let recording = Recording::open(path, &settings.read)?;
        return Ok(Inspection::of_points(&recording, settings));
    }
    match Format::of(path)? {
        Format::Tum if settings.read.tracks.is_none() => Inspection::of_trajectory(path, settings),
        Format::Rosbag if settings.read.tracks.is_none() => Inspection::of_bag(path, settings),
        _ => {
            let recording = Recording::open(path, &settings.read)?.part(&settings.part)?;
            Ok(Inspection::of_motion(&recording, 1.0, settings))
        }
    }
}

impl Inspection {
    fn new(name: &str, content: Content, settings: &InspectSettings) -> Self {
        Self {
            name: name.to_owned(),
            gauge: settings.gauge.clone(),
            fingerprint: None,
            topics: Vec::new(),
            content,
            taken: Vec::new(),
            findings: Vec::new(),
            lacks: Vec::new(),
            readiness: Vec::new(),
            options: settings.read.clone(),
            choices: Vec::new(),
            parts: None,
            over_time: None,
        }
    }

    fn of_points(recording: &Recording, settings: &InspectSettings) -> Self {
        let Some(points) = recording.points() else {
            unreachable!("a path of a table gives a table")
        };
        let content = Content::Points(points.clone());
        let mut of = Self::new(points.name(), content, settings);
        of.fingerprint = Some(points.fingerprint().to_owned());
        of.readiness = readiness::of_points(recording, settings, &mut of.findings);
        of
    }

    fn of_trajectory(path: &Path, settings: &InspectSettings) -> Result<Self, Error> {
        let poses = tum::read_poses(path)?.samples;
        let name = name_of(path);
        let content = Content::Poses(Rows::of(&[poses.iter().map(|pose| pose.t).collect()]));
        let mut of = Self::new(&name, content, settings);
        of.lacks.push(Lack::Tracks);
        of.readiness = readiness::none("a trajectory has no track speeds");
        Ok(of)
    }

    fn of_bag(path: &Path, settings: &InspectSettings) -> Result<Self, Error> {
        let seen = rosbag::inspect_for(path, &settings.read.bag)?;
        let mut choices = Vec::new();
        let read = bag::read(path, &settings.read, &seen.suggested).or_else(|failed| {
            match choice::of(path, &settings.read, &seen, &failed.1) {
                Choice::One(read) => Ok(*read),
                Choice::Several(several) => {
                    choices = several;
                    Err(failed)
                }
                Choice::None => Err(failed),
            }
        });
        let mut of = match read {
            Ok(read) => {
                let part = read.recording.part(&settings.part)?;
                let mut of = Self::of_motion(&part, read.speed_unit, settings);
                of.options = read.options;
                of.findings.splice(0..0, read.findings);
                of
            }
            Err((options, reason)) => {
                let name = name_of(path);
                let mut of = Self::new(&name, Content::Unread(reason.clone()), settings);
                of.options = options;
                of.findings = seen.warnings.into_iter().map(Finding::Reading).collect();
                of.findings.push(Finding::Unread(reason));
                of.lacks = lack::of_topics(&seen.topics, &of.options);
                of.readiness = readiness::none(if choices.is_empty() {
                    "it cannot be read so"
                } else {
                    "not without a choice: see below"
                });
                of.choices = choices;
                of
            }
        };
        of.topics = seen.topics;
        Ok(of)
    }

    /// Where the radius of the wheels is not known, speeds are read with an assumed one,
    /// `speed_unit`, m; it is 1 otherwise.
    fn of_motion(recording: &Recording, speed_unit: f64, settings: &InspectSettings) -> Self {
        let Some(motion) = recording.motion() else { unreachable!("no table of points") };
        let driving = Driving::of(motion, settings.tau).with_gyroscope(motion);
        let (over_time, lacks) = (
            OverTime::of(motion, &driving, speed_unit, settings.parameters.as_ref()),
            lack::of_driving(motion, &driving, speed_unit),
        );
        let (taken, mut findings) = finding::of_warnings(recording.warnings());
        findings.extend(driving.clock.as_ref().err().cloned().map(Finding::Clock));
        findings.extend(finding::of_turning(&driving));
        let readiness = readiness::of_motion(recording, &driving, settings, &mut findings);
        let is_part = settings.part != Part::default();
        let mut of = Self::new(recording.name(), Content::Motion(Box::new(driving)), settings);
        of.fingerprint = Some(recording.fingerprint().to_owned());
        of.parts = if is_part { None } else { parts(motion) };
        (of.taken, of.findings, of.lacks) = (taken, findings, lacks);
        (of.readiness, of.over_time) = (readiness, Some(over_time));
        of
    }

    /// Writes [`FILE`], where there is something to be seen over time. A picture of an earlier
    /// recording goes where this one has none.
    ///
    /// # Errors
    /// [`Error::Output`], [`Error::NotRemoved`], [`Error::Figure`].
    pub fn write(
        &self,
        folder: impl AsRef<Path>,
        provenance: &Provenance,
    ) -> Result<Vec<Change>, Error> {
        let Some(over_time) = &self.over_time else {
            let mut folder = Folder::existing(folder.as_ref());
            let file: PathBuf = folder.file(FILE);
            folder.remove_earlier(FILE, [file])?;
            return Ok(folder.changes());
        };
        let mut folder = Folder::prepare(folder.as_ref())?;
        let fingerprint = self.fingerprint.as_deref().unwrap_or_default();
        let unknown = || "vehicle not given".to_owned();
        let vehicle = self.gauge.as_ref().map_or_else(unknown, Gauge::caption);
        let caption =
            format!("trackdyn {}, recording {fingerprint}, {vehicle}", provenance.version);
        folder.write(FILE, &over_time.figure(&self.name, &caption).to_png()?)?;
        Ok(folder.changes())
    }
}

/// Least time of a run that is parted, s.
const MIN_PARTED_TIME: f64 = 40.0;

/// The first and the second half of the runs; of a single run, of its time.
fn parts(motion: &Motion) -> Option<[Part; 2]> {
    let list = motion.run_list();
    if let numbers @ [_, _, ..] = list.numbers() {
        let halves = numbers.split_at(numbers.len().div_ceil(2));
        let of = |half: &[i64]| {
            let runs = trackdyn_recording::RunList::new(half.iter().copied());
            Part { runs: Some(runs), time: None }
        };
        return Some([of(halves.0), of(halves.1)]);
    }
    let whole = motion.duration();
    let half = (whole / 2.0).round();
    let of = |time: [f64; 2]| Part { runs: None, time: Some(time) };
    (whole >= MIN_PARTED_TIME).then(|| [of([0.0, half]), of([half, whole.ceil()])])
}
