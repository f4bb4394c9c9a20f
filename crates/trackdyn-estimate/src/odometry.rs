//! Dead reckoning: where the robot would be if its parameters were true, against where it was.
//!
//! - [`parameter_set`]: what turns track speeds into motion: a kinematics file, the ideal drive, or
//!   the forces on a vehicle.
//! - [`replay()`]: the path that a parameter set predicts from the track speeds of a run.
//! - [`in_time`]: the path that the forces on a vehicle predict.
//! - [`stretch`]: pieces of a run over a distance or a time, and what was seen in them.
//! - [`residual`]: observed minus predicted motion.
//! - [`intervals`]: confidence intervals that allow for correlated neighbouring residuals.
//! - [`pose_error`]: relative and absolute pose errors as other tools define them.
//! - [`comparison`]: all of it for several parameter sets on the same runs.
//! - [`tum`]: paths as files.
//!
//! Axes are those of REP-103 (x forward, y left), units SI, angles in radians.

pub mod comparison;
mod covered;
mod error;
pub mod in_time;
pub mod intervals;
pub mod parameter_set;
pub mod pose_error;
mod replay;
pub mod residual;
pub mod stretch;
pub mod tum;

pub use comparison::Comparison;
pub use error::Error;
pub use intervals::Estimate;
pub use parameter_set::ParameterSet;
pub use replay::{DeadReckoning, replay};
pub use residual::Residual;
pub use stretch::{Span, Stretch};
