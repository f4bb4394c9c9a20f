//! Path tracking on the inverse kinematics: the loop of the paper's section 5.1.
//!
//! Every 30 ms the [tracker](Tracker) looks where the robot is and asks for a forward speed and a
//! yaw rate; the [kinematics](Steering) turns them into track speeds, (10)-(11), which a limit
//! scales in common. Where the robot finds its place by dead reckoning, the kinematics counts a
//! second time, in (7)-(9): it then corrects its path for errors that it cannot see.

mod belief;
mod drive;
mod journey;
mod pursuit;
mod steering;
mod tracker;

pub use belief::Estimate;
pub use drive::{DriveOptions, drive};
pub use journey::{CrossTrack, Ending, Journey, Summary};
pub use steering::Steering;
pub use tracker::Tracker;
