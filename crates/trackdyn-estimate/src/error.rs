//! Why parameters cannot be given.

use crate::doubt::Doubt;
use trackdyn_core::real;
use trackdyn_recording::recording::known_offset;

/// A recording that does not determine what was asked of it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Too little in the recording.
    #[error(
        "{found} segments: expected at least {needed} for {parameters} parameters, that is, some \
         {:.0} s more of driving with turns both ways; each segment is between two poses that the \
         track speeds cover by the same clock, in seconds, and of steady driving where --settle \
         asks for it",
        (.each * real(.needed.saturating_sub(*.found))).ceil()
    )]
    TooFewSegments {
        /// Segments of the recording.
        found: usize,
        /// Segments that are needed.
        needed: usize,
        /// Parameters that were asked for.
        parameters: usize,
        /// Mean duration of a segment, s.
        each: f64,
    },
    /// Tracks and poses that share no time.
    #[error(
        "tracks and poses share no time: in run {run} the first pose is stamped {offset:.3} s \
         after the first reading of the tracks, by another clock{}. Such an offset is not \
         searched: expected stamps by one clock, or the offset with --tau (where both were \
         switched on together, --tau {offset:.1}), or of a bag the times of logging with \
         --dated-by log",
        known_offset(*.offset).map_or_else(String::new, |name| format!(" ({name})"))
    )]
    NoCommonTime {
        /// The first such run.
        run: i64,
        /// Time by which its first pose is later, s.
        offset: f64,
    },
    /// Too little in a table of operating points.
    #[error("{found} measurements: expected at least {needed} for {parameters} parameters")]
    TooFewMeasurements {
        /// Speeds and yaw rates of the table.
        found: usize,
        /// Those that are needed.
        needed: usize,
        /// Parameters that were asked for.
        parameters: usize,
    },
    /// No turning on the spot.
    #[error(
        "no spin: expected tracks running against each other for at least {needed_rad:.1} rad in \
         all, found {found_rad:.2} rad"
    )]
    NoSpin {
        /// Yaw in segments that spin, rad.
        found_rad: f64,
        /// Yaw that is needed, rad.
        needed_rad: f64,
    },
    /// The driving does not show the parameters.
    #[error("not determined by this recording: {0}")]
    NotDetermined(Doubt),
    /// The clock offset ran out of the readings around the segments.
    #[error(
        "the time offset does not settle within {margin} s of {start:.3} s: it reached {tau:.3} s \
         (give a better one with --tau, or do not fit it)"
    )]
    ClockLeaves {
        /// Where it was, s.
        tau: f64,
        /// Where it began, s.
        start: f64,
        /// How far it may go, s.
        margin: f64,
    },
    /// The iteration did not settle.
    #[error("least squares did not settle after {iterations} iterations (last step {step:.1e})")]
    NotConverged {
        /// Iterations.
        iterations: usize,
        /// Largest change of a parameter in the last one, m or 1.
        step: f64,
    },
    /// The recording does not hold what an estimate needs.
    #[error("{what} cannot be estimated: {reason}")]
    NotEstimable {
        /// The quantity.
        what: &'static str,
        /// What is missing, with numbers.
        reason: String,
    },
    /// Encoders and poses do not show the same turning.
    #[error(
        "the clock offset cannot be estimated: no turning that encoders and poses both show: their \
         best correlation is {correlation:.2} over {count} pose intervals, {needed} needed"
    )]
    Unlike {
        /// Their best correlation.
        correlation: f64,
        /// Pose intervals that were used.
        count: usize,
        /// The smallest that would do.
        needed: f64,
    },
    /// The clock offset lies beyond all that were tried.
    #[error(
        "the clocks of poses and tracks differ by {farthest} s or more: the best clock offset lies \
         at an end of the search, at {tau:.2} s. Expected stamps by one clock: see what `inspect` \
         says of the stamps, give the offset with --tau, or of a bag take the times of logging \
         with --dated-by log"
    )]
    ClockFar {
        /// The best of those that were tried, s.
        tau: f64,
        /// How far the search went, s.
        farthest: f64,
    },
    /// Yaw falls where the right track is faster.
    #[error(
        "yaw falls where the right track is faster (correlation {correlation:.2}): left and right \
         are swapped, a side counts backwards, or the sign of yaw is another: give the joints with \
         --left-joint and --right-joint (-NAME reverses one), or read yaw that counts clockwise, \
         as north-east-down does, by --pose-axes ned. Or the clocks differ by more than the \
         {farthest} s that were tried: --tau gives the offset, and of a bag --dated-by chooses the \
         clock"
    )]
    Swapped {
        /// Correlation of yaw increments and encoders.
        correlation: f64,
        /// How far clock offsets were tried, s.
        farthest: f64,
    },
    /// The caller asked to stop.
    #[error("stopped before the end")]
    Cancelled,
}

impl Error {
    /// So many segments, of a mean duration, s, are too few for so many parameters.
    pub(crate) fn too_few(found: usize, each: f64, parameters: usize) -> Self {
        Self::TooFewSegments { found, needed: 4 * parameters, parameters, each }
    }

    /// Whether the recording is sound but does not determine what was asked, as other driving
    /// would.
    pub fn is_no_result(&self) -> bool {
        matches!(
            self,
            Self::NoSpin { .. }
                | Self::NotDetermined(_)
                | Self::ClockLeaves { .. }
                | Self::NotConverged { .. }
                | Self::NotEstimable { .. }
                | Self::Unlike { .. }
        )
    }
}
