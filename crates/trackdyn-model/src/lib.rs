//! Mechanics of a tracked robot: the forces on it, and the motion and kinematic parameters that
//! follow.
//!
//! Forces:
//! - [`vehicle`]: mass, running gear, centre of gravity, friction; [`vehicle_file`]: the file.
//! - [`contact`]: friction of a patch, in closed form or by quadrature.
//! - [`pipeline`]: the values passed between the stages of the balance of forces.
//! - [`effect`]: the trait of an effect; [`effects`]: the catalogue, one file each; [`custom`]:
//!   laws of a user beside it.
//! - [`model`]: a vehicle with its effects, and the balance of forces at a motion.
//!
//! Motion:
//! - [`Forces`]: the sum of forces at a motion, and its Jacobian.
//! - [`newton`]: Newton's and Broyden's method for the balance of forces.
//! - [`stationary`]: the motion at constant track speeds; [`transient`]: the motion over time.
//! - [`map`]: the stationary motion over a grid of speeds, its means, spreads and sectors.
//! - [`sectors`]: the plane of belt speeds in parts where that motion is smooth.
//! - [`motion_table`]: the stationary motion as polynomials, for a robot's computer.
//! - [`kinematics`]: constant ICRs, equations (7)-(13).
//!
//! Laws are generic over one scalar type, so each has exact derivatives. The modules of forces do
//! not iterate and do not depend on those of motion. All use the paper's frame: x right, y forward.

#[cfg(test)]
mod conformance;
pub mod contact;
pub mod custom;
pub mod effect;
pub mod effects;
mod forces;
pub mod icr;
pub mod kinematics;
pub mod map;
pub mod model;
pub mod motion_table;
pub mod newton;
pub mod pipeline;
pub mod sectors;
pub mod stationary;
pub mod transient;
pub mod vehicle;
pub mod vehicle_file;

pub use effects::{ActiveEffect, CATALOGUE, EffectError, EffectId, Effects};
pub use forces::Forces;
pub use icr::Icrs;
pub use kinematics::Kinematics;
pub use map::{Grid, IcrMap};
pub use model::{Balance, Model, Support};
pub use motion_table::MotionTable;
pub use pipeline::{Circumstance, Drive, Ground, Motion, RigidBody, Sensor};
pub use stationary::{Linearised, Near, Solution, Stationary, Status};
pub use transient::Transient;
pub use vehicle::{RunningGear, Uncertainty, Vehicle, VehicleError};
pub use vehicle_file::VehicleFile;
