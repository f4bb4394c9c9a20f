//! The one in-memory type that everything else in the tool sees.

use crate::Error;
use crate::doubt::{Doubt, DoubtKind};
use std::path::PathBuf;

mod bias;
mod by_poses;
mod cleaning;
mod clock_rate;
mod content;
mod contradictions;
mod counted;
mod cut_off;
mod dead;
mod finding;
mod frozen;
mod gyro_unit;
mod headings;
mod idle;
mod jumps;
mod kept;
mod linear;
mod motion;
mod positions;
mod run;
mod saturated;
mod saturated_gyro;
mod set_back;
mod source;
mod spikes;
mod stretches;
mod stuck;
mod stuck_gyro;
mod unsigned;
mod warning;
mod wide_spikes;

pub(crate) use cleaning::clean;
pub use cleaning::{MIN_GAP_RATIO, longest_interval};
pub use finding::{Cleaning, Finding};
pub(crate) use headings::{headings, turn_by_gyroscope};
pub use kept::Kept;
pub(crate) use run::turn_sensor;
pub use run::{PoseAxes, Run, UncheckedRun};
pub(crate) use set_back::divide;
pub use source::{BagNames, Format, Source};
pub use warning::{Course, DeadReckoning, Warning, known_offset};

/// Track speeds, poses and, where there are any, readings of an IMU.
///
/// # Assumes
/// REP-103 axes, SI. Stamps of every series increase strictly within a run, all numbers are finite
/// and yaw is continuous: [`Recording::new`] sees to it and [`Recording::warnings`] says what it
/// had to do.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    name: String,
    robot: String,
    runs: Vec<Run>,
    stated_noise: Option<StatedNoise>,
    pose_frame: Option<PoseFrame>,
    source: Source,
    warnings: Vec<Warning>,
    fingerprint: String,
    pose_fingerprint: String,
}

/// Which frame the poses of a recording stand in, as its maker states it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PoseFrame {
    /// One frame for all runs: a place is the same place in each.
    World,
    /// A frame of its own for each run, as of an odometry that begins anew.
    Run,
}

/// Pose noise as the maker of the recording states it.
#[derive(Clone, Copy, Debug, PartialEq, serde::Deserialize, serde::Serialize)]
#[serde(deny_unknown_fields)]
pub struct StatedNoise {
    /// Standard deviation of x and of y, m.
    #[serde(rename = "pose_xy_m")]
    pub position: f64,
    /// Standard deviation of yaw, rad.
    #[serde(rename = "pose_yaw_rad")]
    pub yaw: f64,
}

impl Recording {
    /// Cleans the runs and makes a recording of them. `warnings` are those of the reader.
    ///
    /// Runs are put in the order of their ids; a run without readings or with fewer than two poses
    /// is left out, with a warning.
    ///
    /// # Errors
    /// [`Error::Empty`] when no run is left, [`Error::Contradiction`] when tracks and poses that
    /// were read from files contradict each other.
    pub fn new(
        name: impl Into<String>,
        robot: impl Into<String>,
        runs: Vec<UncheckedRun>,
        source: Source,
        warnings: Vec<Warning>,
    ) -> Result<Self, Error> {
        Self::accepting(name, robot, runs, source, warnings, &[])
    }

    /// As [`Recording::new`], but doubts of these kinds are warnings: the user knows better.
    ///
    /// # Errors
    /// Those of [`Recording::new`].
    pub fn accepting(
        name: impl Into<String>,
        robot: impl Into<String>,
        runs: Vec<UncheckedRun>,
        source: Source,
        mut warnings: Vec<Warning>,
        accepted: &[DoubtKind],
    ) -> Result<Self, Error> {
        let name = name.into();
        let mut cleanings = Vec::new();
        let mut kept: Vec<Run> = Vec::with_capacity(runs.len());
        let path = source.path.clone().unwrap_or_else(|| PathBuf::from(&name));
        // What is computed is meant as it is.
        let is_read = source.format != Format::Memory;
        let mut doubts: Vec<Doubt> = Vec::new();
        let mut without_yaw = 0;
        for run in runs {
            doubts.extend(contradictions::of_rows(&run).filter(|_| is_read));
            without_yaw += run.poses.samples.iter().filter(|row| lacks_yaw(row)).count();
            kept.push(Run::new(run, &mut cleanings));
        }
        let speeds = kept.iter().flat_map(Run::tracks);
        let speeds = speeds.flat_map(|reading| [reading.v_left, reading.v_right]);
        let usual = wide_spikes::largest_usual_speed(speeds);
        let mut kept: Vec<Run> =
            kept.into_iter().map(|run| run.mended(usual, &mut cleanings)).collect();
        let leave_out = |kept: &mut Vec<Run>, warnings: &mut Vec<Warning>| {
            let useless = kept.extract_if(.., |run| !run.is_usable());
            warnings.extend(useless.map(|run| Warning::RunLeftOut {
                run: run.id(),
                readings: run.tracks().len(),
                poses: run.poses().len(),
            }));
        };
        leave_out(&mut kept, &mut warnings);
        if is_read {
            refuse(&path, &mut doubts, accepted, &mut warnings)?;
            doubts.extend(contradictions::of_runs(&kept));
            refuse(&path, &mut doubts, accepted, &mut warnings)?;
            clock_rate::take_off(&mut kept, &mut cleanings);
            frozen::leave_out(&mut kept, &mut cleanings);
            saturated::leave_out(&mut kept, &mut cleanings);
            cut_off::mend(&mut kept, &mut cleanings);
            bias::take_off(&mut kept, &mut cleanings);
            warnings.extend(gyro_unit::leave_out(&mut kept));
            stuck_gyro::leave_out(&mut kept, &mut cleanings);
        }
        dead::leave_out(&mut kept, &mut cleanings);
        leave_out(&mut kept, &mut warnings);
        if kept.is_empty() {
            let found = finding::gather(cleanings).into_iter().map(|one| format!("; {one}"));
            let found: String = found.collect();
            let orientation = match without_yaw {
                0 => String::new(),
                count => format!(
                    "; {count} poses have a position and no orientation (a quaternion of zeros, \
                     or an empty yaw): expected poses with a yaw; of a bag, --pose-topic chooses \
                     others"
                ),
            };
            let message =
                format!("no run with track speeds and at least two poses{orientation}{found}");
            return Err(Error::Empty { path, message });
        }
        kept.sort_by_key(Run::id);
        warnings.extend(kept.iter().filter_map(|run| {
            let (offset, run) = (run.offset_without_common_time()?, run.id());
            Some(Warning::NoCommonTime { run, offset })
        }));
        warnings.extend(Warning::imu_of_a_part(&kept));
        let runs = kept.iter().filter(|run| !run.has_positions()).count();
        if runs > 0 {
            warnings.push(Warning::PositionsUnknown { runs, of: kept.len() });
        }
        if runs < kept.len() {
            kept.retain(Run::has_positions);
        }
        warnings.extend(finding::gather(cleanings).into_iter().map(Warning::Cleaned));
        Ok(Self::of_cleaned(name, robot.into(), kept, source, warnings))
    }

    /// A recording of runs that are cleaned, in the order of their ids.
    fn of_cleaned(
        name: String,
        robot: String,
        runs: Vec<Run>,
        source: Source,
        warnings: Vec<Warning>,
    ) -> Self {
        let fingerprint = content::fingerprint(&runs);
        let pose_fingerprint = content::pose_fingerprint(&runs);
        Self {
            name,
            robot,
            runs,
            stated_noise: None,
            pose_frame: None,
            source,
            warnings,
            fingerprint,
            pose_fingerprint,
        }
    }

    /// Several recordings of one robot as one, its runs numbered anew from 0 in their order. Runs
    /// without positions are left out where others have them.
    ///
    /// # Errors
    /// [`Error::Empty`] without runs.
    pub fn joined(recordings: &[Self]) -> Result<Self, Error> {
        let names: Vec<&str> = recordings.iter().map(Self::name).collect();
        let name = names.join(" + ");
        let robot = recordings.first().map_or("unknown", |first| first.robot());
        let runs = recordings.iter().flat_map(Self::runs).zip(0..);
        let mut runs: Vec<Run> = runs.map(|(run, id)| run.clone().with_id(id)).collect();
        if runs.is_empty() {
            return Err(Error::Empty { path: PathBuf::from(name), message: "no run".to_owned() });
        }
        if runs.iter().any(Run::has_positions) {
            runs.retain(Run::has_positions);
        }
        let noise = recordings.iter().find_map(Self::stated_noise);
        let frame = recordings.iter().find_map(Self::pose_frame);
        let warnings = recordings.iter().flat_map(Self::warnings).cloned().collect();
        let joined = Self::of_cleaned(name, robot.to_owned(), runs, Source::computed(), warnings);
        Ok(joined.with_stated_noise(noise).with_pose_frame(frame))
    }

    /// This recording with a statement of its pose noise.
    pub fn with_stated_noise(mut self, noise: Option<StatedNoise>) -> Self {
        self.stated_noise = noise;
        self
    }

    /// This recording with a statement of the frame of its poses.
    pub fn with_pose_frame(mut self, frame: Option<PoseFrame>) -> Self {
        self.pose_frame = frame;
        self
    }

    /// Name for titles and outputs.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The robot that was recorded.
    pub fn robot(&self) -> &str {
        &self.robot
    }

    /// The runs, in the order of their ids unless said otherwise; each continuous.
    pub fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// This recording with other runs. Its fingerprint stays that of the whole: it tells where the
    /// runs come from.
    pub fn with_runs(&self, runs: Vec<Run>) -> Self {
        Self {
            name: self.name.clone(),
            robot: self.robot.clone(),
            runs,
            stated_noise: self.stated_noise,
            pose_frame: self.pose_frame,
            source: self.source.clone(),
            warnings: self.warnings.clone(),
            fingerprint: self.fingerprint.clone(),
            pose_fingerprint: self.pose_fingerprint.clone(),
        }
    }

    /// Whether the positions of all poses are known; where they are not, only yaw was measured.
    pub fn has_positions(&self) -> bool {
        self.runs.iter().all(Run::has_positions)
    }

    /// Pose noise as its maker states it.
    pub fn stated_noise(&self) -> Option<StatedNoise> {
        self.stated_noise
    }

    /// The frame of its poses as its maker states it.
    pub fn pose_frame(&self) -> Option<PoseFrame> {
        self.pose_frame
    }

    /// Where it comes from.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// What was cleaned, left out or guessed on the way in.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Relative error that all yaw shares, 1: a standard deviation, 0 where poses measure it.
    pub fn yaw_scale_deviation(&self) -> f64 {
        self.warnings.iter().filter_map(Warning::yaw_scale_deviation).fold(0.0, f64::hypot)
    }

    /// Fingerprint of the cleaned numbers: the same samples have the same one in every format.
    pub fn fingerprint(&self) -> &str {
        &self.fingerprint
    }

    /// Fingerprint of the poses alone: the same drive has the same one without its IMU, and at
    /// another belt travel per radian.
    pub fn pose_fingerprint(&self) -> &str {
        &self.pose_fingerprint
    }

    /// Start in whole seconds of its clock. Laws of time count from it.
    pub fn begin(&self) -> f64 {
        let readings = self.runs.iter().flat_map(Run::tracks);
        readings.fold(f64::INFINITY, |first, track| first.min(track.t)).floor()
    }

    /// Time covered by the readings, summed over the runs, s.
    pub fn duration(&self) -> f64 {
        self.runs.iter().map(Run::duration).sum()
    }
}

/// Makes warnings of doubts that were accepted.
///
/// # Errors
/// [`Error::Contradiction`] with the first that was not.
fn refuse(
    path: &std::path::Path,
    doubts: &mut Vec<Doubt>,
    accepted: &[DoubtKind],
    warnings: &mut Vec<Warning>,
) -> Result<(), Error> {
    let is_accepted = |doubt: &Doubt| accepted.contains(&doubt.kind());
    if let Some(doubt) = doubts.iter().find(|doubt| !is_accepted(doubt)) {
        return Err(Error::contradiction(path, doubt.clone()));
    }
    warnings.extend(doubts.drain(..).map(Warning::Accepted));
    Ok(())
}

/// Whether a pose has a position and no orientation.
fn lacks_yaw(row: &crate::sample::PoseSample) -> bool {
    row.pose.x.is_finite() && row.pose.y.is_finite() && row.pose.yaw.is_nan()
}
