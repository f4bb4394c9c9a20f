//! The answer of a diagnosis: a status, and what the model lacks.

pub use trackdyn_core::status::Status;

use crate::uncertainty::Interval;
use crate::verdict::Verdict;

/// Kind of a missing part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Physics of the robot and its ground.
    Physics,
    /// Encoders or pose sensor.
    Instrument,
    /// A wrong constant, or one of the effects that act as constant ICRs.
    Constant,
}

/// A claimed missing part of the model.
#[derive(Clone, Debug)]
pub struct Missing {
    /// Its kind.
    pub kind: Kind,
    /// The verdict.
    pub verdict: Verdict,
    /// Parameters with intervals; empty where it stands for a class of constants.
    pub parameters: Vec<Interval>,
}

impl Missing {
    /// Causes outside the catalogue that act like the named physics, a sentence for each; empty
    /// where none is known.
    pub fn resembling(&self) -> String {
        let named = self.verdict.one_of.iter().filter(|_| self.kind == Kind::Physics);
        let sentences = named.map(|effect| effect.card().resembles);
        sentences.filter(|sentence| !sentence.is_empty()).collect::<Vec<_>>().join(" ")
    }
}
