//! Where residuals depart from zero, before and after the correction.

use super::judged::Judged;
use crate::form::Forms;
use crate::locate::cells::{Cell, cells};
use crate::locate::{Location, Residual, icr_columns};
use crate::mismatch::sentence;
use crate::resampling::Resampling;
use crate::search::Search;
use crate::verdict::tolerated;
use std::collections::BTreeSet;
use trackdyn_model::effect::Symmetry;

/// Located departures of the evidence from each model.
pub(super) struct Located {
    /// From the vehicle as filed, with only constant ICRs fitted.
    pub filed: Location,
    /// From the base.
    pub before: Location,
    /// From the best hypothesis.
    pub after: Location,
    /// Symmetries still broken by the best hypothesis.
    pub left_over: Vec<Symmetry>,
    /// ICRs by cells of driving, for the base and for the best hypothesis.
    pub cells: [Vec<Cell>; 2],
}

impl Located {
    /// Locates departures from the base and the best hypothesis.
    pub fn of(judged: &Judged, resampling: Resampling) -> Self {
        let evidence = &judged.search.evidence;
        let (base, best) = (&judged.search.base, &judged.best);
        let [of_filed, of_base, of_best] =
            [&base.as_filed, &base.fit, &best.fit].map(|fit| icr_columns(evidence, fit));
        let exact = &Forms::default();
        let of = |fit, forms, icrs| Residual { evidence, fit, forms, icrs };
        let filed = of(&base.as_filed, exact, &of_filed).locate(resampling);
        let after = of(&best.fit, &best.forms, &of_best).locate_in_waves(resampling);
        // Waves, which no effect of the catalogue makes, are in the base as well.
        let of_base_alone = of(&base.fit, exact, &of_base);
        let before = if after.waves.is_empty() {
            of_base_alone.locate(resampling)
        } else {
            of_base_alone.locate_in_waves(resampling)
        };
        let left_over = after.left_over(tolerated(evidence, base, best));
        let cells = [(&base.fit, &of_base), (&best.fit, &of_best)]
            .map(|(fit, icrs)| cells(evidence, &fit.residual, icrs));
        Self { filed, before, after, left_over, cells }
    }

    /// Symmetries that the evidence breaks before or after, ascending.
    pub fn broken(&self) -> Vec<Symmetry> {
        let all = [self.before.broken(), self.filed.broken(), self.left_over.clone()].concat();
        BTreeSet::from_iter(all).into_iter().collect()
    }

    /// One sentence on where the model fails: channel, driving, symmetries.
    pub fn sentence(&self, search: &Search) -> String {
        let locations = [&self.before, &self.after];
        sentence(&search.evidence, &search.base, locations, &self.broken())
    }
}
