//! What a use case cannot do.

use crate::limits::OutOfLimits;
use crate::preset;
use std::path::PathBuf;
use trackdyn_core::document::DocumentError;
use trackdyn_core::output::OutputError;
use trackdyn_drive::sensors::Preset;
use trackdyn_model::custom::{DefinitionError, Failure};
use trackdyn_model::{EffectError, VehicleError};
use trackdyn_recording::RunList;

/// What a use case cannot do, and why.
///
/// Messages say what happened and where, then what was expected. Where a setting is to blame they
/// begin with its name: see [`Error::setting`].
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The observer asked to stop.
    #[error("stopped before the end")]
    Cancelled,
    /// A TOML file that is not accepted.
    #[error(transparent)]
    Document(Box<DocumentError>),
    /// A file or folder cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A file of an earlier run cannot be removed.
    #[error("{}: {cause}", path.display())]
    NotRemoved {
        /// The file.
        path: PathBuf,
        /// What the system says.
        cause: std::io::Error,
    },
    /// A file or folder cannot be read.
    #[error("{}: {cause}", path.display())]
    Unreadable {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        cause: std::io::Error,
    },

    /// A recording cannot be read or written.
    #[error(transparent)]
    Recording(#[from] trackdyn_recording::Error),
    /// An option of bags for what is no bag.
    #[error("{setting}: {} is no bag: expected with bags of ROS only", path.display())]
    NotABag {
        /// The option.
        setting: &'static str,
        /// The recording.
        path: PathBuf,
    },
    /// A trajectory without track speeds.
    #[error(
        "{}: a trajectory has no track speeds: expected a table of them (tracks)",
        path.display()
    )]
    NoTracks {
        /// The trajectory.
        path: PathBuf,
    },
    /// Track speeds for a recording that is no trajectory.
    #[error(
        "tracks: {} is no .tum or .txt trajectory: expected a table of track speeds beside one \
         alone",
        path.display()
    )]
    TracksNotNeeded {
        /// The recording.
        path: PathBuf,
    },
    /// Settings that a table of steady operating points has no use for: it has no runs and no time.
    #[error(
        "{}: {} holds steady points: expected with recordings of motion only",
        settings.join(", "),
        table.display()
    )]
    MotionOnly {
        /// The settings.
        settings: Vec<&'static str>,
        /// The table.
        table: PathBuf,
    },
    /// A table of steady operating points where motion is needed.
    #[error("{recording}: holds steady points: expected a recording of motion")]
    NoMotion {
        /// The table.
        recording: String,
    },
    /// Poses with a yaw alone where positions are needed.
    #[error(
        "{recording}: its poses have a yaw alone: expected poses with positions (`identify` tells \
         the distance of the ICRs from yaw)"
    )]
    NoPositions {
        /// The recording.
        recording: String,
    },
    /// A file with the distance of the ICRs where all parameters are needed.
    #[error(
        "{name}: holds the distance of the ICRs alone: x_l, x_r and y are open. Expected \
         parameters from a recording whose poses have positions (only `export ros2` can work with \
         the distance)"
    )]
    SeparationAlone {
        /// The file.
        name: String,
    },
    /// Runs that are not there.
    #[error("runs: {0}")]
    Runs(#[source] trackdyn_recording::Error),
    /// A time in which nothing is.
    #[error("time: {0}")]
    Time(#[source] trackdyn_recording::Error),
    /// Nothing to work on.
    #[error("no recording: expected at least one")]
    NoRecording,
    /// A recording that is given twice.
    #[error("{recording}: expected each recording once: its runs count as evidence of their own")]
    RecordingTwice {
        /// The recording.
        recording: String,
    },
    /// A recording of the simulator that is one of the robot, too.
    #[error("{recording}: expected in one of both sets: it cannot differ from itself")]
    ComparedWithItself {
        /// The recording.
        recording: String,
    },
    /// A table of steady operating points among several recordings.
    #[error("a table of steady points is diagnosed alone: expected one")]
    PointsNotAlone,

    /// Runs to hold out that are not there.
    #[error("held_out {runs}: {cause}")]
    HeldOut {
        /// The runs.
        runs: RunList,
        /// Which of them is not there.
        cause: trackdyn_recording::Error,
    },
    /// Nothing is left to fit.
    #[error("held_out: expected at least one run to fit")]
    AllHeldOut,
    /// Runs of what has none.
    #[error("held_out {runs}: a table of steady points has no runs: expected none")]
    NoRunsToHoldOut {
        /// The runs.
        runs: RunList,
    },

    /// An effect that the catalogue does not have, or not so.
    #[error(transparent)]
    Effect(#[from] EffectError),
    /// A law of a user that cannot be defined so.
    #[error(transparent)]
    Definition(#[from] DefinitionError),
    /// A law of a user that failed.
    #[error(transparent)]
    Law(#[from] Box<Failure>),
    /// An effect that is given twice.
    #[error("effect {id}: given twice: expected once, with all its parameters")]
    EffectTwice {
        /// The effect.
        id: &'static str,
    },
    /// A centre of gravity with which the vehicle does not stand.
    #[error("cog: {0}")]
    CentreOfGravity(#[source] VehicleError),
    /// A reference case that does not fit its vehicle.
    #[error("{reference}: case \"{case}\": {cause}")]
    Case {
        /// The reference file.
        reference: String,
        /// Name of the case.
        case: String,
        /// What does not fit.
        cause: Box<Error>,
    },

    /// A recording with too little in it to identify parameters.
    #[error("{recording}: {cause}")]
    Identify {
        /// The recording.
        recording: String,
        /// What is missing.
        cause: trackdyn_estimate::Error,
    },
    /// Poses that are computed from the tracks: nothing to judge a model of the tracks by.
    #[error("{recording}: {cause}")]
    NoReference {
        /// The recording.
        recording: String,
        /// What shows it.
        cause: trackdyn_estimate::Contradiction,
    },
    /// A recording that cannot be replayed.
    #[error("{recording}: {cause}")]
    Odometry {
        /// The recording.
        recording: String,
        /// Why.
        cause: trackdyn_estimate::odometry::Error,
    },
    /// A recording that cannot be diagnosed.
    #[error("{recording}: {cause}")]
    Diagnose {
        /// The recording.
        recording: String,
        /// Why.
        cause: trackdyn_diagnose::Error,
    },
    /// A vehicle for which nothing can be planned, or not so.
    #[error("{vehicle}: {cause}")]
    Plan {
        /// The vehicle.
        vehicle: String,
        /// Why.
        cause: trackdyn_diagnose::Error,
    },

    /// Driving, sensors or a path that cannot be read or used.
    #[error(transparent)]
    Driving(#[from] trackdyn_drive::Error),
    /// Sensors that are neither a preset nor a file.
    #[error(
        "sensors {choice}: expected {} or a file that exists",
        Preset::ALL.map(Preset::name).join(", ")
    )]
    NoSensors {
        /// What was asked for.
        choice: String,
    },
    /// A setting of driving that is generated, for driving that is not.
    #[error("{setting}: {driving} says it: expected with a schedule that is generated")]
    GeneratedOnly {
        /// The setting.
        setting: &'static str,
        /// The driving.
        driving: String,
    },
    /// A folder with files that a simulation would replace, and that none wrote.
    #[error(
        "out {}: holds a {file} that was not simulated: expected another folder",
        folder.display()
    )]
    NotSimulated {
        /// The folder.
        folder: PathBuf,
        /// The file.
        file: &'static str,
    },
    /// A folder with a file that would be replaced, and that another use case wrote, or a hand.
    #[error(
        "out {}: its {file} is {origin}, and would be replaced: expected another folder, or that \
         file moved away",
        folder.display()
    )]
    OtherOrigin {
        /// The folder.
        folder: PathBuf,
        /// The file.
        file: &'static str,
        /// Where it comes from, in words.
        origin: String,
    },
    /// A run that cannot be simulated.
    #[error("run {run}: {cause}")]
    Run {
        /// Its number.
        run: i64,
        /// Why.
        cause: Box<dyn std::error::Error + Send + Sync>,
    },
    /// Parameters that no robot has.
    #[error("{file}: {key} = {value}: expected at most {most} in size")]
    TooLarge {
        /// The parameters.
        file: String,
        /// Which of them.
        key: &'static str,
        /// Its value, m or 1.
        value: f64,
        /// The largest that is accepted.
        most: f64,
    },
    /// A robot that turns about a point too far from its middle to follow a path with.
    #[error(
        "{file}: y_icr_m = {y}: expected at most {most} m from the middle, to follow a path with"
    )]
    IcrTooFar {
        /// The parameters.
        file: String,
        /// The point, m forward of the middle.
        y: f64,
        /// The farthest that is accepted, m.
        most: f64,
    },
    /// A speed that the tracks do not reach.
    #[error("speed {speed}: expected at most that of the tracks, {most} m/s")]
    TooFast {
        /// The speed, m/s.
        speed: f64,
        /// That of the tracks, m/s.
        most: f64,
    },

    /// A vehicle that is neither a name nor a file.
    #[error(
        "vehicle {choice}: expected a file that exists, or one of {}",
        preset::names().collect::<Vec<_>>().join(", ")
    )]
    NoVehicle {
        /// What was asked for.
        choice: String,
    },
    /// A number that no vehicle has.
    #[error("{0}")]
    Vehicle(#[source] VehicleError),
    /// A gauge that no vehicle has.
    #[error(
        "gauge {metres}: expected the distance between the track centre-lines in m, up to {most}"
    )]
    Gauge {
        /// What was given, m.
        metres: f64,
        /// The largest that is accepted, m.
        most: f64,
    },

    /// A setting outside its limits.
    #[error(transparent)]
    OutOfLimits(#[from] OutOfLimits),
    /// A largest speed that no robot has.
    #[error("fastest {fastest}: expected a track speed in m/s above 0, up to {most}")]
    FastestSpeed {
        /// What was given, m/s.
        fastest: f64,
        /// The largest that is accepted, m/s.
        most: f64,
    },

    /// A setting that an export cannot be made with.
    #[error("{0}")]
    Export(#[from] trackdyn_export::Error),
    /// A name of a log that an export cannot have.
    #[error("{setting} {name}: so in the log, but {reason}")]
    LogName {
        /// The setting that it would be taken for.
        setting: &'static str,
        /// The name.
        name: String,
        /// Why it is refused.
        reason: String,
    },
    /// A joint that counts backwards in the log that the parameters come from.
    #[error(
        "{setting}: {name} counts backwards in the log that the parameters come from, and a \
         controller reverses no joint: expected the name of a joint that counts forwards, or, once \
         its driver is mended to count so, {name} itself"
    )]
    ReversedJoint {
        /// The setting that takes the joints of that side.
        setting: &'static str,
        /// The joint, without a sign.
        name: String,
    },
    /// A radius that neither a setting nor the log tells.
    #[error(
        "wheel_radius: {file} does not tell it: expected the belt travel in m per radian of the \
         wheel joint"
    )]
    NoWheelRadius {
        /// The parameters.
        file: String,
    },
    /// An odometry file from which no residuals can be taken.
    #[error("{0}")]
    Residuals(String),
    /// A figure that could not be drawn.
    #[error(transparent)]
    Figure(#[from] trackdyn_report::Error),
}

impl Error {
    /// Whether the input is sound, and the computation gave no result.
    pub fn is_no_result(&self) -> bool {
        match self {
            Self::Identify { cause, .. } => cause.is_no_result(),
            Self::NoReference { .. } => true,
            _ => false,
        }
    }

    /// The setting that is to be changed, where the message begins with its name.
    pub fn setting(&self) -> Option<&'static str> {
        match self {
            Self::NotABag { setting, .. }
            | Self::GeneratedOnly { setting, .. }
            | Self::OutOfLimits(OutOfLimits { setting, .. })
            | Self::LogName { setting, .. }
            | Self::ReversedJoint { setting, .. } => Some(setting),
            Self::TracksNotNeeded { .. } => Some("tracks"),
            Self::Runs(_) => Some("runs"),
            Self::Time(_) => Some("time"),
            Self::HeldOut { .. } | Self::AllHeldOut | Self::NoRunsToHoldOut { .. } => {
                Some("held_out")
            }
            Self::EffectTwice { .. } => Some("effect"),
            Self::CentreOfGravity(_) => Some("cog"),
            Self::NoSensors { .. } => Some("sensors"),
            Self::NotSimulated { .. } | Self::OtherOrigin { .. } => Some("out"),
            Self::TooFast { .. } => Some("speed"),
            Self::Gauge { .. } => Some("gauge"),
            Self::FastestSpeed { .. } => Some("fastest"),
            Self::NoWheelRadius { .. } => Some("wheel_radius"),
            Self::NoVehicle { .. } => Some("vehicle"),
            _ => None,
        }
    }
}

impl From<DocumentError> for Error {
    fn from(error: DocumentError) -> Self {
        Self::Document(Box::new(error))
    }
}
