//! Signatures of all candidates, and the search for the best hypothesis.

use crate::base::Base;
use crate::candidate::{Beside, Catalogue, candidates};
use crate::noise::sharper;
use crate::progress::{Cancelled, Stage, Watch};
use crate::search::{Found, Screened, Search};
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
    /// Searches the evidence once.
    fn of(
        seen: &Weighted,
        base: Base,
        suspects: &[EffectId],
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let signed = || with_signatures(seen, base, suspects, watch);
        let search = watch.try_stage(Stage::Signatures, signed)?;
        watch.try_stage(Stage::Search, || {
            let screened = search.screen(&search.nothing());
            let found = search.best(watch)?;
            Ok(Self { search, screened, found })
        })
    }

    /// Searches the evidence, and once more where the best hypothesis leaves less noise: it
    /// explains what contrasts cannot, which had been counted as noise.
    pub fn sharpened(
        seen: &Weighted,
        base: Base,
        suspects: &[EffectId],
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let first = Self::of(seen, base, suspects, watch)?;
        if let Some(seen) = sharper(&first.search.evidence, &first.found.fit, watch)? {
            let base = first.search.base.refitted(&seen);
            drop(first); // its signatures take as much memory as the next ones
            Self::of(&seen, base, suspects, watch)
        } else {
            watch.skip(STAGES);
            Ok(first)
        }
    }
}

/// A search with the signatures of all candidates, and of refined variants between them that gain
/// more.
fn with_signatures(
    seen: &Weighted,
    base: Base,
    suspects: &[EffectId],
    watch: &Watch,
) -> Result<Search, Cancelled> {
    let base = Arc::new(base);
    let tried = candidates(suspects, &base.instruments, seen);
    let beside = Beside::new(&base.fit.hypothesis, seen);
    let catalogue = Catalogue { entries: beside.signatures_while(&tried, watch.of_tasks())? };
    let search = Search::new(seen.clone(), Arc::clone(&base), catalogue);
    let between = search.between(&beside, watch)?;
    Ok(search.with_more(between))
}
