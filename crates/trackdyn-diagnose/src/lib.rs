//! Finds which physical effects a model of a tracked robot lacks, from recordings of its driving.
//!
//! - [`evidence`]: samples of recordings or tables of steady motion; [`weighted`]: whitening and
//!   robust weights of their residuals.
//! - [`noise`]: noise covariance, estimated from what no contrast of the driving can explain.
//! - [`hypothesis`]: a vehicle with effects; [`mechanics`], [`surface`]: its prediction of each
//!   sample.
//! - [`prior`]: prior distributions of the unknowns.
//! - [`settings`]: all numbers that decide an answer.
//! - [`fit`], [`normal`], [`equations`]: robust nonlinear least squares, and normal equations
//!   summed by blocks; [`form`]: what the form of a law leaves.
//! - [`base`]: what is free in every hypothesis: constant ICRs, encoders and pose sensor.
//! - [`locate`], [`significance`], [`mismatch`]: tests of where residuals depart from zero, without
//!   any effect.
//! - [`candidate`], [`search`]: the signature of every effect, and the search for the best
//!   hypothesis.
//! - [`verdict`], [`uncertainty`], [`isolability`]: claims, intervals, and which effects can be
//!   told apart.
//! - [`proposal`]: an empirical force law for what no effect explains.
//! - [`replay`]: dead reckoning with a vehicle file; [`drift`]: its errors before and after.
//! - [`answer`], [`held_out`]: the status, and errors on runs that were not fitted.
//! - [`mod@diagnosis`]: all stages in order and their result; [`document`]: the result as a file;
//!   [`exposure`]: series for figures.
//! - [`mod@compare`]: what differs between two sets of recordings.
//! - [`mod@plan`]: driving that separates rival effects; [`error`]: why a diagnosis is impossible.
//!
//! No effect is known by name here: the simulator is asked what an effect does.

pub mod answer;
pub mod base;
pub mod candidate;
pub mod compare;
mod corrected;
pub mod diagnosis;
pub mod document;
pub mod drift;
pub mod equations;
pub mod error;
pub mod evidence;
pub mod exposure;
pub mod fit;
pub mod form;
pub mod held_out;
pub mod hypothesis;
pub mod isolability;
pub mod locate;
pub mod mechanics;
pub mod mismatch;
pub mod noise;
pub mod normal;
pub mod plan;
pub mod prior;
pub mod progress;
pub mod proposal;
pub mod replay;
pub mod resampling;
pub mod search;
pub mod settings;
pub mod significance;
mod starts;
pub mod surface;
pub mod uncertainty;
pub mod verdict;
pub mod weighted;

pub use diagnosis::{Diagnosis, Options, Status, diagnose};
pub use document::DiagnosisFile;
pub use error::{Error, Impossible};
pub use evidence::Evidence;
pub use plan::{Plan, PlanFile, plan};
pub use progress::{Observer, Progress, Stage, unobserved};
pub use resampling::Resampling;
pub use settings::Settings;
pub use weighted::Weighted;
