//! Which physics: what a model of a tracked robot lacks, from its recordings.

pub mod base;
pub mod candidate;
pub mod diagnosis;
pub mod document;
pub mod error;
pub mod evidence;
pub mod exposure;
pub mod fit;
pub mod hypothesis;
pub mod isolability;
pub mod locate;
pub mod mechanics;
pub mod normal;
pub mod place;
pub mod plan;
pub mod search;
pub mod significance;
pub mod surface;
pub mod uncertainty;
pub mod verdict;

pub use diagnosis::{Diagnosis, Options, Status, diagnose};
pub use document::DiagnosisFile;
pub use error::Error;
pub use evidence::Evidence;
pub use plan::{Plan, PlanFile, plan};
