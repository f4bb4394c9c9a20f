//! Planar geometry, motion in time and the scalar type that every other crate of trackdyn speaks.
//!
//! Units are SI and radians throughout. Two frames exist: [`frames`] names them and holds the only
//! code that knows both.

pub mod document;
pub mod dual;
pub mod frames;
pub mod input;
pub mod lines;
pub mod named;
pub mod output;
pub mod plant;
pub mod pose;
pub mod robust;
pub mod rounding;
pub mod scalar;
pub mod schedule;
pub mod settings;
pub mod side;
pub mod status;
pub mod trajectory;
pub mod twist;
pub mod wrench;

pub use dual::Dual;
pub use plant::{Plant, Stopped};
pub use pose::Pose;
pub use scalar::{Scalar, real};
pub use schedule::{Command, Schedule, ScheduleError};
pub use side::{PerSide, Side};
pub use trajectory::{Moment, Trajectory};
pub use twist::Twist;
pub use wrench::Wrench;

/// Standard gravity g in m/s² (exact by definition, CGPM 1901).
pub const STANDARD_GRAVITY: f64 = 9.806_65;
