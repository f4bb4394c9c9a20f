//! Errors: why a recording cannot be diagnosed.

use crate::progress::Cancelled;
use trackdyn_core::{Stopped, real};

/// Why evidence cannot be diagnosed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Too few segments.
    #[error(
        "{found} segments to learn from: expected at least {needed}, that is, some {:.0} s more of \
         driving with turns both ways and changes of speed, with poses and track speeds by the \
         same clock, in seconds, in runs that are not held out",
        (.each * real(.needed.saturating_sub(*.found))).ceil()
    )]
    TooFewSegments {
        /// Segments of the runs that are not held out.
        found: usize,
        /// Segments needed.
        needed: usize,
        /// Mean duration of a segment, s.
        each: f64,
    },
    /// Held-out runs without segments.
    #[error(
        "the runs that are held out hold no segment of driving: expected others, or none \
         (--held-out)"
    )]
    NothingHeldOut,
    /// Too small a table.
    #[error("{found} steady points: expected at least {needed}")]
    TooFewPoints {
        /// Points of the table.
        found: usize,
        /// Points needed.
        needed: usize,
    },
    /// Noise neither measurable nor stated.
    #[error(
        "the noise is not known: expected stretches of steady driving or standing with poses (or, \
         in a table of steady points, neighbours on lines of one track speed), or a [noise] table \
         in recording.toml"
    )]
    NoNoise,
    /// A recording without turning.
    #[error(
        "the robot hardly turns: expected track speeds that differ, for the instantaneous centres \
         of rotation show in turns only"
    )]
    NoTurning,
    /// Poses too far from the origin for effects with a place.
    #[error(
        "poses lie up to {:.0} m from the origin of their frame: expected at most {:.0} m, for \
         that is where places of the ground are looked for: subtract constants from x and y",
        .found, .largest
    )]
    FarFromOrigin {
        /// Largest distance along an axis, m.
        found: f64,
        /// Largest allowed, m.
        largest: f64,
    },
    /// Clocks of poses and tracks that do not go together.
    #[error(transparent)]
    Clock(trackdyn_estimate::Error),
    /// A vehicle model without a motion at the recorded speeds.
    #[error("the vehicle does not move as recorded: {0}")]
    NoMotion(#[from] Impossible),
    /// A vehicle model that does not turn in a slow spin.
    #[error("the vehicle does not move as recorded: in a slow spin it turns at {rate} rad/s")]
    NoSpin {
        /// Yaw rate, rad/s.
        rate: f64,
    },
    /// Cancelled by the observer.
    #[error("cancelled")]
    Cancelled,
    /// A setting that does not exist, or a value outside its range.
    #[error(transparent)]
    Setting(#[from] crate::settings::SettingError),
    /// Plan shorter than any manoeuvre.
    #[error("{given} s: expected at least {needed:.2} s, the time of the shortest manoeuvre")]
    TooShort {
        /// Given time, s.
        given: f64,
        /// Time of the shortest manoeuvre, s.
        needed: f64,
    },
}

/// Why a hypothesis predicts no motion.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Impossible {
    /// At many speeds the robot tips over, or no motion balances the forces.
    #[error("at {} of the speeds the robot tips over or no forces balance", part(*share))]
    Unbalanced {
        /// Share of these speeds; none where it is most of them.
        share: Option<f64>,
    },
    /// The transient simulation fails.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// A departure from the stationary motion that was found for another robot.
    #[error("found for another robot")]
    OtherRobot,
}

/// A share in words; none is most.
fn part(share: Option<f64>) -> String {
    share.map_or_else(|| "most".to_owned(), |share| format!("{:.0} %", 100.0 * share))
}

impl From<Cancelled> for Error {
    fn from(Cancelled: Cancelled) -> Self {
        Self::Cancelled
    }
}

impl Error {
    /// Error for segments with these durations, s.
    pub(crate) fn too_few_segments(durations: impl Iterator<Item = f64>, needed: usize) -> Self {
        // Segment duration for poses at 10 Hz.
        const USUAL_DURATION: f64 = 0.1;
        let durations: Vec<f64> = durations.collect();
        let found = durations.len();
        let mean = durations.iter().sum::<f64>() / real(found);
        Self::TooFewSegments { found, needed, each: if found == 0 { USUAL_DURATION } else { mean } }
    }
}
