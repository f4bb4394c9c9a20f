//! Kinematics of tracked robots as files of other programs.
//!
//! - [`drive`]: the ideal differential drive that a tracked robot is, seen at one point.
//! - [`covariance`]: how wrong its odometry is, from the residuals of a replay.
//! - [`frames`]: the frame at that point, and the robot's own.
//! - [`ros2`], [`urdf`], [`gz`]: the files, one module per program.
//! - [`simulator`]: a vehicle as simulators have it; [`sdf`], [`mjcf`], [`usd`], [`chrono`]: the
//!   files.
//! - [`motion_table`]: steady motion by the forces on a vehicle, as a table and as C.
//! - [`viewer`]: paths, markers and curves of a drive for Foxglove, Rerun and PlotJuggler.
//!
//! Derivation, signs and direction of the transform: `docs/theory/export.md`.

pub mod chrono;
pub mod covariance;
pub mod drive;
pub mod error;
pub mod frames;
pub mod gz;
pub mod mjcf;
pub mod motion_table;
pub mod name;
pub mod provenance;
pub mod ros2;
pub mod sdf;
pub mod simulator;
pub mod urdf;
pub mod usd;
pub mod viewer;

mod number;

pub use covariance::Residuals;
pub use drive::EquivalentDrive;
pub use error::Error;
pub use frames::Frames;
pub use motion_table::LeftOut;
pub use name::{Name, NodeName};
pub use provenance::Provenance;
pub use simulator::Robot;

/// A file to write.
#[derive(Clone, Debug, PartialEq)]
pub struct TextFile {
    /// Name in its folder.
    pub name: &'static str,
    /// Contents.
    pub text: String,
}
