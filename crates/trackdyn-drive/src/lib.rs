//! What surrounds a robot that drives: who tells it where to go, and who watches it.
//!
//! - [`schedules`]: track speeds over time: driven by hand, designed, or from a file.
//! - [`sensors`]: what encoders, a pose sensor and an IMU report of a motion.
//! - [`rolling`]: a robot of constant ICRs, the simplest one.
//! - [`truth`]: the motion itself, as a table beside a recording.
//! - [`path`]: a way over the ground.
//! - [`tracking`]: a path tracker on the inverse kinematics, and how far the robot strays.
//!
//! A robot is any [`Plant`](trackdyn_core::Plant). Axes are those of REP-103 (x forward, y left),
//! units SI, angles in radians. The same seed gives the same bytes: every run and every sensor has
//! a random stream of its own.

mod error;
mod odometer;
pub mod path;
mod random;
pub mod rolling;
pub mod schedules;
pub mod sensors;
pub mod tracking;
pub mod truth;

pub use error::Error;
pub use path::Path;
pub use rolling::Rolling;
pub use schedules::{ScheduleKind, ScheduleOptions, ScheduledRun};
pub use sensors::Sensors;
pub use tracking::{Ending, Journey, Steering, Tracker, drive};
