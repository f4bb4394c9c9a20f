//! Tracked robots slip when they turn.
#![doc = ""]

mod change;
mod document;
mod error;
mod icr_map;
mod kinematics;
mod progress;
mod provenance;
mod vehicle;

pub mod check;
pub mod diagnose;
pub mod drive;
pub mod export;
pub mod identify;
pub mod odometry;
pub mod plan;
pub mod recording;
pub mod simulate;

/// The crates below, for what the use cases do not cover.
pub mod crates {
    pub use trackdyn_core as core;
    pub use trackdyn_diagnose as diagnose;
    pub use trackdyn_drive as drive;
    pub use trackdyn_estimate as estimate;
    pub use trackdyn_export as export;
    pub use trackdyn_model as model;
    pub use trackdyn_recording as recording;
    pub use trackdyn_report as report;
}

pub use change::{Change, prepare_folder};
pub use check::{Reference, check};
pub use diagnose::{Claim, DiagnoseSettings, Diagnosis, HeldOut, diagnose};
pub use drive::{DriveSettings, Drives, drive};
pub use error::Error;
pub use export::Export;
pub use icr_map::{IcrMap, MapSettings, icr_map};
pub use identify::{Identification, IdentifySettings, identify};
pub use kinematics::Parameters;
pub use odometry::{Odometry, OdometrySettings, odometry};
pub use plan::{OpenQuestions, Plan, PlanSettings, plan};
pub use progress::{Observer, Progress, unobserved};
pub use provenance::Provenance;
pub use recording::{Part, ReadOptions, Recording};
pub use simulate::{SimulateSettings, Simulation, simulate};
pub use vehicle::{Vehicle, refuse_repeated};

pub use trackdyn_diagnose::Status;
pub use trackdyn_drive::{Path, Sensors};
pub use trackdyn_model::effect::Card;
pub use trackdyn_model::{ActiveEffect, Circumstance, Grid, Kinematics};
pub use trackdyn_recording::RunList;

/// Version of this library, which stands in every file that it writes.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The catalogue of effects: physics beyond the base model.
pub fn effects() -> &'static [Card] {
    trackdyn_model::CATALOGUE
}
