//! Why a recording cannot be diagnosed.

use crate::progress::Cancelled;
use trackdyn_core::real;

/// Evidence that does not bear a diagnosis.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Too little driving.
    #[error(
        "{found} segments to learn from: expected at least {needed}, that is, some {:.0} s of \
         driving with poses and track speeds by the same clock, in seconds, in runs that are not \
         held out",
        .each * real(*.needed)
    )]
    TooFewSegments {
        /// Segments of the runs that are not held out.
        found: usize,
        /// Segments that are needed.
        needed: usize,
        /// Mean duration of a segment, s.
        each: f64,
    },
    /// Held-out runs without driving.
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
        /// Points that are needed.
        needed: usize,
    },
    /// Noise is neither measurable nor stated.
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
    /// Poses far from where places are looked for.
    #[error(
        "poses lie up to {:.0} m from the origin of their frame: expected at most {:.0} m, for \
         that is where places of the ground are looked for: subtract constants from x and y",
        .found, .largest
    )]
    FarFromOrigin {
        /// Largest distance along an axis, m.
        found: f64,
        /// Largest that will do, m.
        largest: f64,
    },
    /// Clocks of poses and tracks that do not go together.
    #[error("{0}")]
    Clock(String),
    /// A vehicle that cannot move as recorded.
    #[error("the vehicle does not move as recorded: {0}")]
    NoMotion(String),
    /// Stopped by its observer.
    #[error("cancelled")]
    Cancelled,
    /// A setting that does not exist, or a value that it cannot have.
    #[error(transparent)]
    Setting(#[from] crate::settings::SettingError),
    /// A plan without time.
    #[error("{given} s: expected at least {needed:.2} s, the time of the shortest manoeuvre")]
    TooShort {
        /// Time that was given, s.
        given: f64,
        /// Time of the shortest manoeuvre, s.
        needed: f64,
    },
}

impl From<Cancelled> for Error {
    fn from(Cancelled: Cancelled) -> Self {
        Self::Cancelled
    }
}

impl Error {
    /// Too few segments, of these durations, s.
    pub(crate) fn too_few_segments(durations: impl Iterator<Item = f64>, needed: usize) -> Self {
        // The duration that readings and poses of ten a second give.
        const USUAL: f64 = 0.3;
        let durations: Vec<f64> = durations.collect();
        let found = durations.len();
        let mean = durations.iter().sum::<f64>() / real(found);
        Self::TooFewSegments { found, needed, each: if found == 0 { USUAL } else { mean } }
    }
}
