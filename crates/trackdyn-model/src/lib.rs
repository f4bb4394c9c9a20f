//! How a tracked robot moves over ground, and which numbers say it.
//!
//! What pushes:
//! - [`vehicle`]: mass, running gear, centre of gravity, friction; [`vehicle_file`]: as a file.
//! - [`contact`]: friction of a patch, in closed form or by quadrature.
//! - [`pipeline`]: what passes between the stages of the balance of forces.
//! - [`effect`]: what an effect is; [`effects`]: the catalogue, one file each.
//! - [`model`]: a vehicle with its effects, and the balance of forces at a motion.
//!
//! How it moves:
//! - [`Forces`]: what pushes the body at a motion, and how that changes with it.
//! - [`newton`]: the search for the motion at which forces balance.
//! - [`stationary`]: that motion for a pair of track speeds; [`transient`]: the motion in time.
//! - [`map`]: the stationary motion over a grid of speeds, its means, spreads and sectors.
//! - [`kinematics`]: what the means are for: equations (7)-(13) with constant ICRs.
//!
//! Laws are written over one scalar type, so each has exact derivatives. What pushes never iterates
//! and knows nothing of how the robot moves. The paper's frame holds throughout: x right, y
//! forward.

#[cfg(test)]
mod conformance;
pub mod contact;
pub mod effect;
pub mod effects;
mod forces;
pub mod icr;
pub mod kinematics;
pub mod map;
pub mod model;
pub mod newton;
pub mod pipeline;
pub mod stationary;
pub mod transient;
pub mod vehicle;
pub mod vehicle_file;

pub use effects::{ActiveEffect, CATALOGUE, EffectError, EffectId, Effects};
pub use forces::Forces;
pub use icr::Icrs;
pub use kinematics::Kinematics;
pub use map::{Grid, IcrMap};
pub use model::{Balance, Model};
pub use pipeline::{Circumstance, Drive, Ground, Motion, Sensor};
pub use stationary::{Linearised, Near, Solution, Stationary, Status};
pub use transient::Transient;
pub use vehicle::{RunningGear, Uncertainty, Vehicle, VehicleError};
pub use vehicle_file::VehicleFile;
