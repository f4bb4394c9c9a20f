//! What is said of a robot: a status, and what was left out of its model.

use crate::uncertainty::Interval;
use crate::verdict::Verdict;

/// What a diagnosis says in a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// What was left out is named.
    Explained,
    /// Nothing that this evidence could show was left out.
    NothingMissing,
    /// Something is missing that several effects explain alike.
    Ambiguous,
    /// Something is there that the catalogue does not explain.
    Unexplained,
}

impl Status {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::Explained, Self::NothingMissing, Self::Ambiguous, Self::Unexplained];

    /// Its word in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Explained => "explained",
            Self::NothingMissing => "nothing-missing",
            Self::Ambiguous => "ambiguous",
            Self::Unexplained => "unexplained",
        }
    }
}

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
