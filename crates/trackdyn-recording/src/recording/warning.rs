//! What was done to a recording on its way in.

use super::Run;
use super::cleaning::longest_interval;
use super::finding::Cleaning;
use crate::doubt::Doubt;
use crate::sample::ImuSample;
use std::f64::consts::TAU;
use std::fmt;
use std::path::{Path, PathBuf};
use trackdyn_core::lines::counted;
use trackdyn_core::robust::usual_interval;

/// How the yaw of a gyroscope agrees with the course of fixes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Course {
    /// Straight pieces of the way that tell the course.
    pub pieces: usize,
    /// Bias that was taken off the yaw rates, rad/s.
    pub bias: f64,
    /// True yaw rate per measured one, 1.
    pub scale: f64,
    /// Its standard deviation: an error that all yaw of the recording shares.
    pub scale_deviation: f64,
    /// Scatter of the courses about the yaw, rad.
    pub scatter: f64,
}

/// Poses along a chain of transforms that are odometry between corrections.
#[derive(Clone, Debug, PartialEq)]
pub struct DeadReckoning {
    /// The transform that is corrected, such as map → odom.
    pub corrected: String,
    /// Its child frame, which odometry moves the robot in.
    pub frame: String,
    /// Poses at its corrections, which are kept.
    pub corrections: usize,
    /// Usual time from one to the next, s.
    pub interval: f64,
    /// The transform that moves in between.
    pub odometry: String,
    /// Poses in between.
    pub left_out: usize,
}

impl fmt::Display for DeadReckoning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { corrected, frame, corrections, interval, odometry, left_out } = self;
        write!(
            f,
            "{corrected} is corrected {corrections} times, usually every {interval:.2} s: poses \
             are measured there; {left_out} in between are dead reckoning by {odometry}, left out \
             (where that is measured by something else than the tracks, --parent-frame {frame} \
             takes it alone)"
        )
    }
}

/// Relative error of the scale of a gyroscope that nothing checks, 1: the standard deviation that
/// data sheets of usual micromechanical ones imply. Fibre-optic ones are better by far.
const GYROSCOPE_SCALE_DEVIATION: f64 = 0.01;

/// Something the user should know about a recording that can be used all the same.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// Rows were changed, dropped or found odd.
    Cleaned(Cleaning),
    /// A run was left out.
    RunLeftOut {
        /// Its number.
        run: i64,
        /// Readings of the tracks in it.
        readings: usize,
        /// Poses in it.
        poses: usize,
    },
    /// A file ends early or is damaged; what stands before is used.
    Damaged {
        /// The file.
        path: PathBuf,
        /// What its reader says.
        message: String,
        /// Messages that were read before.
        messages: u64,
    },
    /// The end of a table that is cut off or is no data.
    EndLeftOut {
        /// The file.
        path: PathBuf,
        /// Line of its first row.
        line: u64,
        /// Its rows.
        rows: usize,
        /// Its bytes, without separators.
        bytes: usize,
    },
    /// The header of a table that stands there again below.
    HeadersLeftOut {
        /// The file.
        path: PathBuf,
        /// How often.
        count: usize,
        /// Line of the first of them.
        line: u64,
    },
    /// Chunks of a bag that are damaged: none of their messages is used; those around them are.
    ChunksDropped {
        /// The file.
        path: PathBuf,
        /// How many chunks.
        chunks: u64,
        /// Time from the first to the last of their messages, summed over the chunks, s.
        seconds: f64,
        /// What is wrong with the first of them.
        problem: String,
    },
    /// A file that belongs to a recording and is not there.
    PartMissing {
        /// The file.
        path: PathBuf,
    },
    /// Poses that may be the odometry of the tracks themselves.
    OwnOdometry {
        /// Their source.
        poses: String,
    },
    /// Poses along a chain of transforms that are odometry between corrections: left out.
    DeadReckoning(DeadReckoning),
    /// Tracks and poses of a run that share no time.
    NoCommonTime {
        /// The run.
        run: i64,
        /// Time by which the first pose is later than the first reading of the tracks, s.
        offset: f64,
    },
    /// Poses with a yaw alone.
    PositionsUnknown {
        /// Runs whose positions are not known.
        runs: usize,
        /// All runs; those without positions are left out where others have them.
        of: usize,
    },
    /// Messages that are not what their type says, or lack what is needed.
    MessagesSkipped {
        /// Their topic.
        topic: String,
        /// How many.
        count: u64,
        /// What is wrong with the first of them.
        reason: String,
    },
    /// Messages without a stamp; the time they were logged at stands in.
    LogTime {
        /// Their topic.
        topic: String,
        /// How many.
        count: u64,
    },
    /// Messages without a stamp by the clock of another topic, which runs at another rate than that
    /// of the logger and dates them.
    ShownTime {
        /// Their topic.
        topic: String,
        /// How many.
        count: u64,
        /// The topic of the clock.
        clock: String,
    },
    /// Clocks of two topics that differ by more than messages are late.
    ClocksDiffer {
        /// The topics.
        topics: [String; 2],
        /// Median by which stamps of the second are later against their logging than those of the
        /// first, s.
        offset: f64,
        /// Whether all messages were dated by their logging instead.
        by_log: bool,
    },
    /// A clock that was set in the middle: all messages were dated by their logging.
    ClockSet {
        /// The topic.
        topic: String,
    },
    /// Stamps that most readings share with the one before: all messages were dated by their
    /// logging.
    CoarseStamps {
        /// The topic.
        topic: String,
    },
    /// Stamps that step back and go on from there, as a simulation does that is reset.
    ClockReset {
        /// The topic.
        topic: String,
        /// Runs that come of it.
        runs: usize,
    },
    /// Stamps of a table that step back and go on from there, as those of a clock that is set back.
    ClockSetBack {
        /// Number of the run, and of the first that comes of it: others follow after all runs.
        run: i64,
        /// Runs that come of it.
        runs: usize,
    },
    /// A joint whose position wraps: what it lacks was added.
    TurnsAdded {
        /// The joint.
        joint: String,
        /// Places at which its position wraps.
        count: usize,
        /// Modulo what it is reported, rad: a whole turn, or what its jumps show.
        modulus: f64,
    },
    /// Jumps in the position of a joint that are no wraps: they stay, as speeds that no wheel has.
    JointJumps {
        /// The joint.
        joint: String,
        /// How many.
        count: usize,
        /// Stamp of the first, s.
        t: f64,
    },
    /// Track speeds that are made of the speeds of the body.
    FromTwist {
        /// The topic of these.
        topic: String,
        /// Separation of the tracks that they are made with, m.
        separation: f64,
    },
    /// Poses that are made of fixes of satellite navigation and the yaw of an IMU.
    FromFixes {
        /// The topic of the fixes.
        topic: String,
        /// The topic of the IMU.
        imu: String,
    },
    /// Poses that are made of fixes of satellite navigation and a gyroscope, whose yaw is turned to
    /// the course of the fixes.
    FromCourse {
        /// The topic of the fixes.
        topic: String,
        /// The topic of the IMU.
        imu: String,
        /// How they agree.
        course: Course,
    },
    /// Poses that are the yaw of a gyroscope alone.
    YawOfGyroscope {
        /// Its topic, column or file.
        gyroscope: String,
    },
    /// An IMU that is not mounted upright, whose yaw rates are those about the vertical.
    TurnedUpright {
        /// Its topic.
        topic: String,
        /// What points up, along its axes.
        up: [f64; 3],
    },
    /// Readings of an IMU that are left out, because its yaw rates are in degrees per second.
    GyroInDegrees {
        /// Turn of the gyroscope per turn of the poses.
        ratio: f64,
    },
    /// An IMU whose readings cover a part of the poses only.
    ImuOfAPart {
        /// Time of the poses that they cover, s.
        covered: f64,
        /// Time of all poses, s.
        of: f64,
    },
    /// A doubt that the user accepted.
    Accepted(Doubt),
    /// A choice that the reader made.
    Chosen {
        /// What it was for.
        what: &'static str,
        /// What was taken.
        taken: String,
    },
}

/// Largest share of covered poses at which an IMU still gets a warning about the rest.
const MAX_COVERED_SHARE: f64 = 0.9;

impl Warning {
    /// Warning of an IMU that covers only a part of the poses of these runs; none where it covers
    /// them, or where there is no IMU.
    pub(super) fn imu_of_a_part(runs: &[Run]) -> Option<Self> {
        let (mut covered, mut of) = (0.0, 0.0);
        for run in runs {
            let [first, .., last] = run.poses() else { continue };
            of += last.t - first.t;
            let longest = longest_interval(usual_interval(run.imu().iter().map(|one| one.t)));
            let within = |pair: &[ImuSample]| {
                let [from, until] = [pair[0].t.max(first.t), pair[1].t.min(last.t)];
                if pair[1].t - pair[0].t > longest { 0.0 } else { (until - from).max(0.0) }
            };
            covered += run.imu().windows(2).map(within).sum::<f64>();
        }
        (covered > 0.0 && covered < MAX_COVERED_SHARE * of)
            .then_some(Self::ImuOfAPart { covered, of })
    }

    /// Relative error that all yaw of the recording shares by what it is made of, 1: a standard
    /// deviation.
    pub(super) fn yaw_scale_deviation(&self) -> Option<f64> {
        match self {
            Self::FromCourse { course, .. } => Some(course.scale_deviation),
            Self::YawOfGyroscope { .. } => Some(GYROSCOPE_SCALE_DEVIATION),
            _ => None,
        }
    }
}

impl fmt::Display for Warning {
    #[expect(clippy::too_many_lines, reason = "one arm for each warning")]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cleaned(cleaning) => cleaning.fmt(f),
            Self::RunLeftOut { run, readings, poses } => {
                write!(f, "run {run} left out: {readings} track readings, {poses} poses")
            }
            Self::Damaged { path, message, messages } => {
                write!(f, "{}: {message}; the {messages} messages before are used", path.display())
            }
            Self::EndLeftOut { path, line, rows, bytes } => {
                end_left_out(f, path, *line, [*rows, *bytes])
            }
            Self::HeadersLeftOut { path, count, line } => headers_left_out(f, path, *line, *count),
            Self::ChunksDropped { path, chunks, seconds, problem } => write!(
                f,
                "{}: damaged, and read around the damage: {chunks} chunks are left out, \
                 {seconds:.3} s of the log are missing (the first chunk: {problem})",
                path.display()
            ),
            Self::PartMissing { path } => write!(
                f,
                "{}: listed in metadata.yaml, and not there; what it holds is missing",
                path.display()
            ),
            Self::OwnOdometry { poses } => write!(
                f,
                "{poses}: if it comes from the tracks themselves, it agrees with any model of \
                 them: poses have to come from something else"
            ),
            Self::DeadReckoning(of) => of.fmt(f),
            Self::NoCommonTime { run, offset } => write!(
                f,
                "run {run}: tracks and poses share no time: the first pose is stamped {offset:.3} \
                 s after the first reading of the tracks, by another clock{} (--tau, and for a bag \
                 --dated-by log)",
                in_brackets(*offset)
            ),
            Self::PositionsUnknown { runs, of } => positions_unknown(f, *runs, *of),
            Self::MessagesSkipped { topic, count, reason } => {
                write!(f, "{topic}: {count} messages skipped, the first because {reason}")
            }
            Self::LogTime { topic, count } => {
                write!(f, "{topic}: {count} messages without a stamp, dated by their logging")
            }
            Self::ShownTime { topic, count, clock } => write!(
                f,
                "{topic}: {count} messages are dated by what the clock of {clock} shows at their \
                 logging, for it runs at another rate, as in a simulation, and does not stamp them \
                 (--dated-by log dates all by logging)"
            ),
            Self::ClocksDiffer { topics, offset, by_log } => {
                clocks_differ(f, topics, *offset, *by_log)
            }
            Self::ClockSet { topic } => write!(
                f,
                "{topic}: its clock was set while it was logged, so all is dated by its logging \
                 (--dated-by header keeps the stamps)"
            ),
            Self::CoarseStamps { topic } => write!(
                f,
                "{topic}: most of its readings share their stamp with another one, so all is dated \
                 by its logging (--dated-by header keeps the stamps)"
            ),
            Self::ClockReset { topic, runs } => write!(
                f,
                "{topic}: stamps step back and go on from there, as after the reset of a \
                 simulation: {runs} runs"
            ),
            Self::ClockSetBack { run, runs } => write!(
                f,
                "run {run}: stamps step back and go on from there, as those of a clock that is set \
                 back: {runs} runs"
            ),
            Self::TurnsAdded { joint, count, modulus } => turns_added(f, joint, *count, *modulus),
            Self::JointJumps { joint, count, t } => write!(
                f,
                "{joint}: {count} jumps of its position by more than half a turn that are no \
                 wraps, left as they are (the first at t = {t:.3} s)"
            ),
            Self::FromTwist { topic, separation } => from_twist(f, topic, *separation),
            Self::FromFixes { topic, imu } => write!(
                f,
                "{topic}: positions of its antenna in metres east and north of the first fix, \
                 with the yaw of {imu}, which has to count from east (REP-103)"
            ),
            Self::FromCourse { topic, imu, course } => from_course(f, topic, imu, course),
            Self::YawOfGyroscope { gyroscope } => write!(
                f,
                "poses: took the yaw of the gyroscope {gyroscope}, without positions; its scale, \
                 which nothing else here shows, is taken to be right to {:.0} %",
                100.0 * GYROSCOPE_SCALE_DEVIATION
            ),
            Self::TurnedUpright { topic, up: [x, y, z] } => write!(
                f,
                "{topic}: gravity points up along ({x:.2}, {y:.2}, {z:.2}) of its axes: yaw rates \
                 are those about that direction"
            ),
            Self::GyroInDegrees { ratio } => write!(
                f,
                "imu: its yaw rates are {ratio:.1} times what the poses show, degrees per second \
                 in place of rad/s: left out (--gyro-unit deg/s reads them)"
            ),
            Self::ImuOfAPart { covered, of } => write!(
                f,
                "imu: its readings cover {covered:.0} s of the {of:.0} s of the poses: the rest \
                 has no gyroscope"
            ),
            Self::Accepted(doubt) => {
                write!(f, "{doubt}; read all the same (--accept {})", doubt.kind().name())
            }
            Self::Chosen { what, taken } => write!(f, "{what}: took {taken}"),
        }
    }
}

/// Says that the yaw of a gyroscope is turned to the course of fixes.
fn from_course(f: &mut fmt::Formatter, topic: &str, imu: &str, of: &Course) -> fmt::Result {
    write!(
        f,
        "{topic}: positions of its antenna in metres east and north of the first fix, with the \
         yaw that {imu} turns, from where the course of {} straight pieces says that the robot \
         looks: they scatter by {:.1} degrees, at a bias of {:.3} degrees per second and a scale \
         of {:.4} (standard error {:.4})",
        of.pieces,
        of.scatter.to_degrees(),
        of.bias.to_degrees(),
        of.scale,
        of.scale_deviation
    )
}

fn end_left_out(
    f: &mut fmt::Formatter<'_>,
    path: &Path,
    line: u64,
    [rows, bytes]: [usize; 2],
) -> fmt::Result {
    write!(
        f,
        "{}:{line}: the table ends in {} ({bytes} bytes) cut off or without data, left out",
        path.display(),
        counted(rows, "row")
    )
}

fn headers_left_out(
    f: &mut fmt::Formatter<'_>,
    path: &Path,
    line: u64,
    count: usize,
) -> fmt::Result {
    let times = counted(count, "time");
    write!(f, "{}:{line}: the header stands there again ({times}), left out", path.display())
}

fn from_twist(f: &mut fmt::Formatter<'_>, topic: &str, separation: f64) -> fmt::Result {
    write!(
        f,
        "{topic}: track speeds are computed from its twist with a separation of {separation} m: \
         they are right only if its driver computed the twist from the encoders alone, with this \
         separation; a driver may have put in a gyroscope, a filter or a slip correction of its \
         own, and a command is no measurement"
    )
}

fn positions_unknown(f: &mut fmt::Formatter<'_>, runs: usize, of: usize) -> fmt::Result {
    write!(
        f,
        "poses: {} with a yaw alone (no x and y, or such as never change while the tracks \
         travel): {}",
        counted(runs, "run"),
        if runs == of { "positions are not known" } else { "left out" }
    )
}

fn turns_added(f: &mut fmt::Formatter<'_>, joint: &str, count: usize, modulus: f64) -> fmt::Result {
    if modulus == TAU {
        return write!(f, "{joint}: its position wraps ({count} times), whole turns added");
    }
    // Ticks are whole numbers, and no angles.
    let modulus =
        if modulus.fract() == 0.0 { format!("{modulus}") } else { format!("{modulus:.4} rad") };
    write!(f, "{joint}: its position wraps at {modulus}, as its jumps show ({count} times): added")
}

/// Offsets of usual clocks, s, since 2017, and what they are.
const CLOCKS: [(f64, &str); 3] = [
    (18.0, "the 18 s of leap seconds by which GPS time is ahead of UTC"),
    (19.0, "the 19 s by which TAI, as of PTP, is ahead of GPS time"),
    (37.0, "the 37 s of leap seconds by which TAI, as of PTP, is ahead of UTC"),
];

/// How far an offset is from one of these, s: messages are late.
const MAX_OFFSET_ERROR: f64 = 0.5;

/// What an offset of two clocks, s, is where it is that of usual ones.
///
/// ```
/// use trackdyn_recording::recording::known_offset;
/// assert!(known_offset(-37.2).is_some_and(|name| name.contains("leap seconds")));
/// assert_eq!(known_offset(25.0), None);
/// ```
pub fn known_offset(offset: f64) -> Option<&'static str> {
    let near = CLOCKS.iter().find(|(of, _)| (offset.abs() - of).abs() < MAX_OFFSET_ERROR);
    near.map(|(_, name)| *name)
}

/// This name in brackets; nothing where there is none.
fn in_brackets(offset: f64) -> String {
    known_offset(offset).map_or_else(String::new, |name| format!(" ({name})"))
}

fn clocks_differ(
    f: &mut fmt::Formatter<'_>,
    [first, second]: &[String; 2],
    offset: f64,
    by_log: bool,
) -> fmt::Result {
    let order = if offset < 0.0 { "earlier" } else { "later" };
    write!(
        f,
        "clocks: by the log, stamps of {second} are {:.3} s {order} than those of {first}{}: ",
        offset.abs(),
        in_brackets(offset)
    )?;
    if by_log {
        write!(
            f,
            "clocks of their own, so all is dated by its logging (--dated-by header keeps the \
             stamps)"
        )
    } else {
        write!(
            f,
            "taken for a delay, so the stamps are kept (--dated-by log, or --tau, if the clocks \
             differ)"
        )
    }
}
