//! Which physics: what a model of a tracked robot lacks, from its recordings.
//!
//! - [`evidence`]: what was seen, drives and tables of steady motion alike; [`weighted`]: what its residuals weigh.
//! - [`noise`]: how noisy that is, from what driving cannot explain.
//! - [`hypothesis`]: a vehicle with effects; [`mechanics`], [`surface`]: what it predicts of the evidence.
//! - [`prior`]: what is known of its unknowns beforehand.
//! - [`settings`]: all numbers that decide an answer.
//! - [`fit`], [`normal`], [`equations`]: its unknowns at their best, and normal equations by blocks.
//! - [`base`]: what is free in every hypothesis: constant ICRs, encoders and pose sensor.
//! - [`locate`], [`significance`], [`place`]: where evidence departs from it, without a model of why.
//! - [`candidate`], [`search`]: the signature of every effect, and which effects explain the evidence.
//! - [`verdict`], [`uncertainty`], [`isolability`]: what is claimed, how large it is, what is told apart.
//! - [`proposal`]: the form of a force for what no effect explains.
//! - [`answer`], [`held_out`]: what is said, and what runs say of it that nothing was fitted on.
//! - [`mod@diagnosis`]: all of it in order, and what comes out; [`document`]: as a file; [`exposure`]: for the eye.
//! - [`mod@plan`]: the driving that would tell apart what is left; [`error`]: why none of it can be done.
//!
//! No effect is known by name here: what an effect does is asked of the simulator.

pub mod answer;
pub mod base;
pub mod candidate;
mod corrected;
pub mod diagnosis;
pub mod document;
pub mod equations;
pub mod error;
pub mod evidence;
pub mod exposure;
pub mod fit;
pub mod held_out;
pub mod hypothesis;
pub mod isolability;
pub mod locate;
pub mod mechanics;
pub mod noise;
pub mod normal;
pub mod place;
pub mod plan;
pub mod prior;
pub mod progress;
pub mod proposal;
pub mod resampling;
pub mod search;
pub mod settings;
pub mod significance;
pub mod surface;
pub mod uncertainty;
pub mod verdict;
pub mod weighted;

pub use diagnosis::{Diagnosis, Options, Status, diagnose};
pub use document::DiagnosisFile;
pub use error::Error;
pub use evidence::Evidence;
pub use plan::{Plan, PlanFile, plan};
pub use progress::{Observer, Progress, Stage, unobserved};
pub use resampling::Resampling;
pub use settings::Settings;
pub use weighted::Weighted;
