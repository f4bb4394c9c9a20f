//! What was seen of a robot.

mod contradictions;
mod gyroscope;
mod kept;
mod options;
mod part;
mod points;

pub use kept::{Kept, KeptSeen};
pub use options::ReadOptions;
pub use part::Part;
pub use points::PointsTable;
pub use trackdyn_recording::rosbag::{Dating, JointSignal};
pub use trackdyn_recording::{Columns, DoubtKind, PoseAxes, PoseFrame, PoseUnit, SpeedUnit};

use crate::Error;
use std::path::{Path, PathBuf};
use trackdyn_estimate::Gyroscope;
use trackdyn_estimate::gyroscope::Unfit;
use trackdyn_recording::rosbag::RosbagOptions;
use trackdyn_recording::{
    Format, OperatingPoints, Recording as Motion, Run, Warning, columns, tum,
};

/// A topic of a bag, and what was seen of it.
pub type Topic = trackdyn_recording::rosbag::TopicSummary;

/// What to take from a bag.
pub type BagOptions = RosbagOptions;

/// What was seen of a robot: a recording of its motion, or a table of steady operating points.
///
/// Axes are those of REP-103 (x forward, y left), units SI, angles in radians.
#[derive(Clone, Debug)]
pub struct Recording {
    seen: Seen,
    path: Option<PathBuf>,
    /// The time of each run that is left of it, s; none: all of it.
    time: Option<[f64; 2]>,
    /// What its gyroscope tells of the yaw of its poses, where it was asked.
    gyroscope: Option<Result<Gyroscope, Unfit>>,
}

/// The two kinds of recordings.
#[derive(Clone, Debug)]
enum Seen {
    Motion(Motion),
    Points(PointsTable),
}

impl Recording {
    /// Reads a recording: a folder with `recording.toml`, a bag of ROS (`.mcap`, `.db3`, `.bag`, or
    /// their folder), a trajectory (`.tum`, `.txt`) with [a table of track
    /// speeds](ReadOptions::tracks), a table of both whose [columns are
    /// named](ReadOptions::columns), or a table of steady operating points (`.csv`, or
    /// `operating_points.csv` in a folder).
    ///
    /// # Errors
    /// [`Error::Recording`], which names file and, where there is one, line and column;
    /// [`Error::NotABag`], [`Error::NoTracks`], [`Error::TracksNotNeeded`], [`Error::MotionOnly`]
    /// for options that do not go with the format.
    pub fn open(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Self, Error> {
        let path = path.as_ref();
        let seen = if let Some(columns) = &options.columns {
            options.refuse_for_table(path)?;
            Seen::Motion(columns::read(path, columns, &options.bag.of_tables())?)
        } else if let Some(table) = Self::points_file(path) {
            options.refuse_for_points(&table)?;
            Seen::Points(PointsTable::read(&table, &options.bag.of_tables())?)
        } else {
            Seen::Motion(motion(path, options)?)
        };
        Ok(Self { seen, path: Some(path.to_owned()), time: None, gyroscope: None })
    }

    /// The table of steady operating points that a path stands for; none where it stands for a
    /// recording of motion.
    pub fn points_file(path: &Path) -> Option<PathBuf> {
        OperatingPoints::file_of(path)
    }

    /// Its name.
    pub fn name(&self) -> &str {
        match &self.seen {
            Seen::Motion(motion) => motion.name(),
            Seen::Points(points) => points.name(),
        }
    }

    /// What errors call it: its path as given, else its name.
    pub fn place(&self) -> String {
        self.path.as_ref().map_or_else(|| self.name().to_owned(), |path| path.display().to_string())
    }

    /// Fingerprint of what was read.
    pub fn fingerprint(&self) -> &str {
        match &self.seen {
            Seen::Motion(motion) => motion.fingerprint(),
            Seen::Points(points) => points.fingerprint(),
        }
    }

    /// The recording of motion; none of a table of steady operating points.
    pub fn motion(&self) -> Option<&Motion> {
        match &self.seen {
            Seen::Motion(motion) => Some(motion),
            Seen::Points(_) => None,
        }
    }

    /// The table of steady operating points; none of a recording of motion.
    pub fn points(&self) -> Option<&PointsTable> {
        match &self.seen {
            Seen::Motion(_) => None,
            Seen::Points(points) => Some(points),
        }
    }

    /// Its runs; none of a table of steady operating points.
    pub fn runs(&self) -> &[Run] {
        self.motion().map_or(&[], Motion::runs)
    }

    /// What was cleaned or left out in reading.
    pub fn warnings(&self) -> &[Warning] {
        self.motion().map_or(&[], Motion::warnings)
    }

    /// A part of it: what is fitted on one part is judged on another. Its fingerprint is that of
    /// the whole.
    ///
    /// # Errors
    /// [`Error::Runs`], [`Error::Time`] for what is not there; [`Error::MotionOnly`] for a part of
    /// a table of steady operating points.
    pub fn part(&self, part: &Part) -> Result<Self, Error> {
        let motion = match &self.seen {
            Seen::Motion(motion) => motion,
            Seen::Points(points) => {
                points.refuse(part.given())?;
                return Ok(self.clone());
            }
        };
        let runs = match &part.runs {
            Some(list) => motion.of_runs(list).map_err(Error::Runs)?,
            None => motion.clone(),
        };
        let runs = match part.time {
            Some(time) => runs.within(time).map_err(Error::Time)?,
            None => runs,
        };
        let time = part.time.or(self.time);
        Ok(Self { seen: Seen::Motion(runs), time, ..self.clone() })
    }

    /// The time of each run that is left of it, s from its first reading; none: all of it.
    pub fn time(&self) -> Option<[f64; 2]> {
        self.time
    }

    /// The recording of motion.
    ///
    /// # Errors
    /// [`Error::NoMotion`] of a table of steady operating points.
    pub(crate) fn expect_motion(&self) -> Result<&Motion, Error> {
        self.motion().ok_or_else(|| Error::NoMotion { recording: self.place() })
    }

    /// The recording of motion, whose positions are needed.
    ///
    /// # Errors
    /// Those of [`expect_motion`](Self::expect_motion); [`Error::NoPositions`].
    pub(crate) fn expect_positions(&self) -> Result<&Motion, Error> {
        let motion = self.expect_motion()?;
        let refused = || Error::NoPositions { recording: self.place() };
        motion.has_positions().then_some(motion).ok_or_else(refused)
    }
}

impl From<Motion> for Recording {
    fn from(motion: Motion) -> Self {
        Self { seen: Seen::Motion(motion), path: None, time: None, gyroscope: None }
    }
}

/// Reads a recording of motion.
fn motion(path: &Path, options: &ReadOptions) -> Result<Motion, Error> {
    let format = Format::of(path)?;
    if format != Format::Rosbag
        && let Some(&setting) = options.of_bags().first()
    {
        return Err(Error::NotABag { setting, path: path.to_owned() });
    }
    match (format, &options.tracks) {
        (Format::Tum, None) => Err(Error::NoTracks { path: path.to_owned() }),
        (Format::Tum, Some(tracks)) => {
            Ok(tum::read_by(path, tracks, "unknown", &options.bag.of_tables())?)
        }
        (_, None) => Ok(trackdyn_recording::read(path, &options.bag)?),
        (_, Some(_)) => Err(Error::TracksNotNeeded { path: path.to_owned() }),
    }
}

/// Several recordings of one robot as one, each once.
///
/// # Errors
/// [`Error::NoRecording`], [`Error::PointsNotAlone`], [`Error::RecordingTwice`].
pub(crate) fn joined(recordings: &[Recording]) -> Result<Recording, Error> {
    match recordings {
        [] => Err(Error::NoRecording),
        [one] => Ok(one.clone()),
        [first, ..] => {
            if recordings.iter().any(|one| one.points().is_some()) {
                return Err(Error::PointsNotAlone);
            }
            for (place, one) in recordings.iter().enumerate() {
                let before = &recordings[..place];
                if before.iter().any(|other| other.fingerprint() == one.fingerprint()) {
                    return Err(Error::RecordingTwice { recording: one.place() });
                }
            }
            let all: Vec<Motion> =
                recordings.iter().filter_map(Recording::motion).cloned().collect();
            let seen = Seen::Motion(Motion::joined(&all)?);
            let is_alike = recordings.iter().all(|one| one.time == first.time);
            let time = first.time.filter(|_| is_alike);
            Ok(Recording { seen, path: first.path.clone(), time, gyroscope: None })
        }
    }
}
