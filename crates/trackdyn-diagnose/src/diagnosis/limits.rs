//! Detection limits: what this evidence could have shown, and told apart.

use super::judged::Judged;
use crate::isolability::{Detectable, Isolability};
use crate::search::Screened;
use trackdyn_model::EffectId;

/// Detection limits: what this evidence could have shown, and told apart.
#[derive(Clone)]
pub struct Limits {
    /// All candidates screened beside the base, best first.
    pub screened: Vec<Screened>,
    /// All candidates screened beside the corrected model, best first.
    pub left: Vec<Screened>,
    /// Effects that act as constant ICRs only.
    pub constants: Vec<EffectId>,
    /// Separations of all candidates, claimed ones included, beside the base.
    pub resemblance: Isolability,
    /// Smallest detectable size of each effect.
    pub detectable: Vec<Detectable>,
}

impl Limits {
    /// Detection limits of a judged search.
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
