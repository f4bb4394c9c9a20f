//! What is said of a robot: a status, and what was left out of its model.

pub use trackdyn_core::status::Status;

use crate::uncertainty::Interval;
use crate::verdict::Verdict;

/// What kind of thing was left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Physics of the robot on its ground.
    Physics,
    /// What encoders and pose sensor make of the motion.
    Instrument,
    /// A wrong number, or one of the effects that only move constant ICRs.
    Constant,
}

/// Something that was left out, with its sizes.
#[derive(Clone, Debug)]
pub struct Missing {
    /// What kind of thing it is.
    pub kind: Kind,
    /// The verdict.
    pub verdict: Verdict,
    /// Its parameters with intervals; empty where it stands for a class of constants.
    pub parameters: Vec<Interval>,
}
