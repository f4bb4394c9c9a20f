//! Tracked and skid-steer robots slip whenever they turn: simulate them, identify their kinematics
//! from logs, and diagnose which physics a model of them lacks.
//!
//! ```
//! use trackdyn::{
//!     DiagnoseSettings, IdentifySettings, OdometrySettings, Provenance, ReadOptions, Recording,
//!     Vehicle, diagnose, identify, odometry,
//! };
//! # use trackdyn::{SimulateSettings, simulate};
//! # let folder = tempfile::tempdir()?;
//! # let (log, out) = (folder.path().join("drive"), folder.path().join("out"));
//! # let robot = Vehicle::auriga_alpha().with_effect("directional-lugs")?;
//! # let settings = SimulateSettings { runs: Some(1), duration: Some(40.0), ..Default::default() };
//! # simulate(&robot, &settings)?.write(&log, &Provenance::default())?;
//! # let my_robot = folder.path().join("my-robot.toml");
//! # Vehicle::auriga_alpha().with_inertia(true).write(&my_robot)?;
//!
//! // Open a log: a folder of CSV, a bag (.mcap, .db3, .bag), a trajectory, or a table of points.
//! let recording = Recording::open(&log, &ReadOptions::default())?;
//! let vehicle = Vehicle::open(&my_robot)?;
//!
//! // Identify the parameters of its kinematics. Replay the log with them and with the ideal drive.
//! let found = identify(&recording, &vehicle, &IdentifySettings::default())?;
//! let parameters = found.parameters().ok_or("this log does not determine them")?;
//! let settings = OdometrySettings::default();
//! let replay = odometry(&recording, &vehicle, &[parameters.clone()], &settings)?;
//! println!("m, rad: {:?}, ideal drive {:?}", replay.error_at_end(1), replay.error_at_end(0));
//!
//! // Diagnose: where do model and log differ, and what physics was left out?
//! let diagnosis = diagnose(&[recording], &vehicle, &DiagnoseSettings::default())?;
//! for claim in diagnosis.claims() {
//!     println!("missing: {} {:?}", claim.one_of().join(" or "), claim.sizes());
//! }
//!
//! // Write what follows: parameters, a report, and the vehicle that explains the log.
//! parameters.write(folder.path().join("kinematics.toml"))?;
//! diagnosis.write(&out, &Provenance::new("my program"))?;
//! # assert!(replay.error_at_end(1)[0] < replay.error_at_end(0)[0]);
//! # assert!(out.join("report.html").exists() && out.join("vehicle.corrected.toml").exists());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Use cases
//!
//! | use case | function | settings | result |
//! |---|---|---|---|
//! | solve the stationary motion over track speeds | [`icr_map()`] | [`MapSettings`] | [`IcrMap`] |
//! | drive in time and record it | [`simulate()`] | [`SimulateSettings`] | [`Simulation`] |
//! | write a vehicle file | [`VehicleSketch::write`] | [`VehicleSketch`] | a file |
//! | read a log | [`Recording::open`] | [`ReadOptions`] | [`Recording`] |
//! | judge a log before that | [`inspect()`] | [`InspectSettings`] | [`Inspection`] |
//! | identify the kinematics | [`identify()`] | [`IdentifySettings`] | [`Identification`] |
//! | replay a log by dead reckoning | [`odometry()`] | [`OdometrySettings`] | [`Odometry`] |
//! | find the physics that a model lacks | [`diagnose()`] | [`DiagnoseSettings`] | [`Diagnosis`] |
//! | compare a simulator with the robot | [`compare()`] | [`CompareSettings`] | [`Comparison`] |
//! | plan the driving that decides what is open | [`plan()`] | [`PlanSettings`] | [`Plan`] |
//! | follow a path | [`drive()`] | [`DriveSettings`] | [`Drives`] |
//! | write files of ROS 2, Gazebo, URDF | [`Export`] | [`export`] | text files |
//! | write a vehicle for a simulator | [`export::simulator`] | [`export::Simulator`] | text |
//! | look at it in Foxglove or PlotJuggler | [`viewer::write`] | [`viewer::Layers`] | `.mcap` |
//! | check that ICRs stay as they were | [`check()`] | [`Reference`] | [`check::CheckedCase`] |
//!
//! All of them are functions over checked types. They print nothing, read nothing from the
//! environment and write only into the folder that they are given. Results depend on inputs,
//! settings and seeds alone, not on the number of threads. Work that takes long tells an
//! [`Observer`] how far it is, and stops when that says so: by `run` of the use case's `Prepared`,
//! such as [`diagnose::Prepared`], by [`IcrMap::solve`] and [`Plan::new`]. What goes wrong is an
//! [`Error`].
//!
//! Axes are those of REP-103 (x forward, y left), but for the ICRs, which have those of the paper
//! (x right, y forward). Units are SI, angles in radians. [`effects()`] lists the physics that a
//! [`Vehicle`] can have beyond the base model, and [`law`] adds to it; the crates below are
//! re-exported in [`crates`].

mod change;
mod document;
mod error;
mod gauge;
mod icr_map;
mod kinematics;
mod limits;
mod preset;
mod progress;
mod provenance;
mod sketch;
mod vehicle;

pub mod check;
pub mod compare;
pub mod diagnose;
pub mod drive;
pub mod export;
pub mod identify;
pub mod inspect;
pub mod law;
pub mod odometry;
pub mod plan;
pub mod recording;
pub mod simulate;
pub mod viewer;

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
pub use compare::{CompareSettings, Comparison, compare};
pub use diagnose::{Claim, DiagnoseSettings, Diagnosis, HeldOut, diagnose};
pub use drive::{DriveSettings, Drives, drive};
pub use error::Error;
pub use export::Export;
pub use gauge::Gauge;
pub use icr_map::{IcrMap, MapSettings, icr_map};
pub use identify::{Identification, IdentifySettings, identify};
pub use inspect::{InspectSettings, Inspection, inspect};
pub use kinematics::Parameters;
pub use limits::{Limits, OutOfLimits};
pub use odometry::{Odometry, OdometrySettings, odometry};
pub use plan::{OpenQuestions, Plan, PlanSettings, plan};
pub use progress::{Observer, Progress, unobserved};
pub use provenance::Provenance;
pub use recording::{Part, ReadOptions, Recording};
pub use simulate::{SimulateSettings, Simulation, simulate};
pub use sketch::VehicleSketch;
pub use vehicle::{Vehicle, refuse_repeated};

pub use trackdyn_core::Pose;
pub use trackdyn_diagnose::{Resampling, Settings as MethodSettings, Status};
pub use trackdyn_drive::{Path, Sensors};
pub use trackdyn_model::effect::{Card, Parameter, Stage, Symmetry, Term};
pub use trackdyn_model::vehicle::RunningGear;
pub use trackdyn_model::{ActiveEffect, Circumstance, EffectId, Effects, Grid, Kinematics};
pub use trackdyn_recording::RunList;
pub use trackdyn_report::Figure;

/// Version of this library, which stands in every file that it writes.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The catalogue of effects: physics beyond the base model.
pub fn effects() -> &'static [Card] {
    trackdyn_model::CATALOGUE
}

/// Compiles the program of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
