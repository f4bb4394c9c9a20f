//! Why a robot cannot be drawn, driven or judged.

/// What stops a draw of a case.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Failure {
    /// A vehicle that cannot be.
    #[error(transparent)]
    Vehicle(#[from] trackdyn_model::VehicleError),
    /// An effect that a vehicle file cannot state.
    #[error(transparent)]
    Effect(#[from] trackdyn_model::EffectError),
    /// A robot that cannot be built.
    #[error(transparent)]
    Robot(#[from] trackdyn_second_simulator::Error),
    /// A motion that cannot go on.
    #[error(transparent)]
    Stopped(#[from] trackdyn_core::Stopped),
    /// A schedule that cannot be made, or a motion that sensors cannot report.
    #[error(transparent)]
    Drive(#[from] trackdyn_drive::Error),
    /// Samples that are no recording.
    #[error(transparent)]
    Recording(#[from] trackdyn_recording::Error),
    /// Constant ICRs that cannot be fitted: a robot that hardly turns.
    #[error(transparent)]
    Fit(#[from] trackdyn_estimate::Error),
    /// Drives whose segments do not match.
    #[error("{own}, {without} and {with} segments")]
    Segments {
        /// Segments of the drive that others are compared with.
        own: usize,
        /// Segments of the drive without an effect.
        without: usize,
        /// Segments of the drive with it.
        with: usize,
    },
    /// A mechanism that does not show at the size that was found for it.
    #[error("{mechanism} shows nothing at the size for z = {wanted:.1}")]
    Invisible {
        /// Id of the mechanism.
        mechanism: &'static str,
        /// The z that was wanted.
        wanted: f64,
    },
    /// A case that the trial does not have.
    #[error("no such case")]
    NoCase,
    /// A robot that this program draws from no attempt at the case.
    #[error(
        "its robot is not of the trial's seed and key as this version draws it: expected the \
         program that made the trial"
    )]
    OtherRobot,
}
