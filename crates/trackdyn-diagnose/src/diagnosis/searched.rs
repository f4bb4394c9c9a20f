//! Signatures of all candidates, and the search for the best hypothesis.

use crate::base::Base;
use crate::candidate::{Beside, Catalogue, candidates};
use crate::noise::sharper;
use crate::progress::{Cancelled, Stage, Watch};
use crate::search::{Found, Known, Screened, Search};
use crate::weighted::Weighted;
use std::sync::Arc;
use trackdyn_model::EffectId;

/// Stages of one search, and of one that may be repeated with smaller noise.
pub(super) const STAGES: usize = 2;
pub(super) const STAGES_SHARPENED: usize = 2 * STAGES;

/// A finished search.
pub(super) struct Searched {
    /// Evidence, base and catalogue of candidates.
    pub search: Search,
    /// All candidates screened beside the base, best first.
    pub screened: Vec<Screened>,
    /// The best hypothesis.
    pub found: Found,
}

impl Searched {
    /// Searches the evidence once, beginning with what is known.
    fn of(
        seen: &Weighted,
        base: Base,
        suspects: &[EffectId],
        known: Known,
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let signed = || with_signatures(seen, base, suspects, known, watch);
        let search = watch.try_stage(Stage::Signatures, signed)?;
        watch.try_stage(Stage::Search, || {
            let screened = search.screen(&search.nothing());
            let found = search.best(watch)?;
            Ok(Self { search, screened, found })
        })
    }

    /// Searches the evidence, and searches it once more where the best hypothesis leaves less
    /// noise: then it explains what contrasts cannot, and what had been counted as noise. `known`
    /// is from an earlier search with other noise.
    pub fn sharpened(
        seen: &Weighted,
        base: Base,
        suspects: &[EffectId],
        known: Known,
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let first = Self::of(seen, base, suspects, known, watch)?;
        if let Some(seen) = sharper(&first.search.evidence, &first.found.fit, watch)? {
            let base = first.search.base.refitted(&seen);
            Self::of(&seen, base, suspects, first.into_known(), watch)
        } else {
            watch.skip(STAGES);
            Ok(first)
        }
    }

    /// The evidence with the residuals of the best hypothesis scaled down to the noise; none where
    /// they do not exceed it.
    pub fn rescaled(&self) -> Option<Weighted> {
        self.search.evidence.rescaled(&self.found.fit.residual)
    }

    /// What the search found, for a search with other noise.
    pub fn into_known(self) -> Known {
        self.search.into_known(self.found)
    }
}

/// A search with the signatures of all candidates, and of refined variants between them that gain
/// more. Known signatures are used where they still hold.
fn with_signatures(
    seen: &Weighted,
    base: Base,
    suspects: &[EffectId],
    mut known: Known,
    watch: &Watch,
) -> Result<Search, Cancelled> {
    let base = Arc::new(base);
    if let Some(catalogue) = known.take_signatures(&base, seen) {
        return Ok(Search::new(seen.clone(), base, catalogue).with_known(known));
    }
    let tried = candidates(suspects, &base.instruments, seen);
    let beside = Beside::new(&base.fit.hypothesis, seen);
    let catalogue = Catalogue { entries: beside.signatures_while(&tried, watch.of_tasks())? };
    let search = Search::new(seen.clone(), Arc::clone(&base), catalogue);
    let between = search.between(&beside, watch)?;
    Ok(search.with_more(between).with_known(known))
}
