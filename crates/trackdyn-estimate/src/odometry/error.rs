//! What can go wrong with a replay.

/// A recording that cannot be replayed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Too few poses of a run lie within the time of its track speeds.
    #[error(
        "run {run}: {poses} of its {all} poses lie within the time of its track speeds at a clock \
         offset of {tau:.3} s: expected two or more"
    )]
    NotCovered {
        /// Number of the run.
        run: i64,
        /// Poses within the time of the readings.
        poses: usize,
        /// Poses of the run.
        all: usize,
        /// Clock offset, s.
        tau: f64,
    },
    /// The forces on a vehicle do not move it as its tracks were driven.
    #[error("run {run}: {cause}")]
    Stopped {
        /// Number of the run.
        run: i64,
        /// Why, and when by the clock of the track speeds.
        cause: trackdyn_core::Stopped,
    },
    /// No piece of the runs can be compared.
    #[error(
        "none of {runs} runs has a segment: a piece of {duration} s or more between two poses, \
         with {readings} readings of the tracks in it"
    )]
    NoSegments {
        /// Runs that were looked at.
        runs: usize,
        /// Shortest segment, s.
        duration: f64,
        /// Fewest readings.
        readings: usize,
    },
    /// The tracks never move.
    #[error("the tracks never move in {runs} runs of {duration:.1} s: there is nothing to compare")]
    Standing {
        /// Runs that were looked at.
        runs: usize,
        /// Their time, s.
        duration: f64,
    },
}
