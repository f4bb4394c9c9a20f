//! How a tracked robot moves.
//!
//! - [`stationary`]: the motion at which the forces balance, for a pair of track speeds.
//! - [`transient`]: the motion in time, with stick and slip.
//! - [`newton`]: the search for both, with derivatives or near a root.
//! - [`Forces`]: what pushes the body at a motion, and how that changes with it.
//! - [`map`]: the stationary motion over a grid of speeds, its means, spreads and sectors.
//! - [`kinematics`]: what the means are for: equations (7)-(13) with constant ICRs.

mod forces;
pub mod icr;
pub mod kinematics;
pub mod map;
pub mod newton;
pub mod stationary;
pub mod transient;

pub use forces::Forces;
pub use icr::Icrs;
pub use kinematics::Kinematics;
pub use map::{Grid, IcrMap};
pub use stationary::{Linearised, Near, Solution, Stationary, Status};
pub use transient::Transient;
