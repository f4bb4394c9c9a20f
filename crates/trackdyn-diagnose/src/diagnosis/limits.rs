//! What this evidence could have shown, and told apart.

use super::judged::Judged;
use crate::isolability::{Detectable, Isolability};
use crate::search::Screened;
use trackdyn_model::EffectId;

/// What this evidence could have shown, and told apart.
#[derive(Clone)]
pub struct Limits {
    /// All candidates beside the base, best first.
    pub screened: Vec<Screened>,
    /// All candidates beside the corrected model, best first.
    pub left: Vec<Screened>,
    /// Effects that only move constant ICRs.
    pub constants: Vec<EffectId>,
    /// What this evidence can tell apart, of all candidates beside the base, what is claimed among
    /// them.
    pub resemblance: Isolability,
    /// Smallest sizes that would have shown.
    pub detectable: Vec<Detectable>,
}

impl Limits {
    /// The limits of what was judged.
    pub(super) fn of(judged: &Judged) -> Self {
        let Judged { search, screened, constants, best, .. } = judged;
        Self {
            left: search.screen(best),
            constants: constants.only.clone(),
            resemblance: Isolability::new(search, &search.nothing(), screened),
            detectable: Isolability::new(search, best, screened).detectable(),
            screened: screened.clone(),
        }
    }
}
