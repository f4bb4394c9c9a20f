//! Where the robot is, from laser scans: the localisation of the paper's section 5.3.
//!
//! It validates: parameters that are identified from it are compared with those from true poses.
//!
//! - [`room`]: walls and furniture, and the world file that holds them.
//! - [`scanner`]: a simulated planar laser, which turns a room and a motion into [`scan`]s.
//! - [`mod@line`]: a straight line with covariance; [`mod@reference`]: a scan as such lines.
//! - [`matching`]: the motion between two scans, with covariance and status.
//! - [`localisation`]: the poses of a series of scans.
//! - [`estimate`]: uncertain poses and how they compose.
//!
//! Axes are those of REP-103 (x forward, y left), units SI, angles in radians.

mod beam;
pub mod error;
pub mod estimate;
pub mod line;
pub mod localisation;
pub mod matching;
pub mod reference;
pub mod room;
pub mod scan;
pub mod scanner;

pub use error::Error;
pub use estimate::PoseEstimate;
pub use line::Line;
pub use localisation::{Localisation, LocalisedPose, MatchAgainst, localise};
pub use matching::{Deviation, Match, MatchOptions, Status};
pub use reference::Reference;
pub use room::{Outline, Room};
pub use scan::Scan;
pub use scanner::Scanner;
