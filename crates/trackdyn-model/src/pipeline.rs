//! Values passed between the stages of the pipeline, into which effects hook.
//!
//! ```text
//! encoder speeds -> drive -> belt speeds, place, heading, time
//!   -> ground (friction per side, gravity) -> load (pressure) -> shear (friction) -> wrench
//!   -> motion of the body -> sense -> reported motion
//! ```

mod change;
mod drive;
mod ground;
mod motion;
mod rigid_body;
mod sensor;
mod situation;

pub use change::done_at;
pub use drive::Drive;
pub use ground::{Circumstance, Ground};
pub use motion::Motion;
pub use rigid_body::RigidBody;
pub use sensor::Sensor;
pub use situation::{Site, Situation};
