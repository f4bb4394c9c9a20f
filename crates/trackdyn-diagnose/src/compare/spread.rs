//! How well a set knows a number that hangs on several unknowns.

use crate::equations::Equations;
use crate::normal::{Normal, Solution};
use crate::search::{Found, Search};
use crate::uncertainty::{groupings, shown_by};
use nalgebra::{DMatrix, DVector};
use std::ops::Range;
use trackdyn_core::real;
use trackdyn_estimate::Interval as Student;

/// Covariances of the unknowns of a fit: by the noise with other forms of the laws, and by two
/// jackknives, over blocks and over runs. The largest variance counts, as in
/// [`Uncertainty`](crate::uncertainty::Uncertainty).
pub(super) struct Spread {
    /// Number of unknowns, and which of them are free.
    count: usize,
    free: Vec<usize>,
    normal: Normal,
    /// Of the free unknowns, with the laws as they stand.
    covariance: DMatrix<f64>,
    /// Of the free unknowns, in other forms of the laws.
    in_forms: DMatrix<f64>,
    blocks: usize,
    jackknives: Vec<(Vec<Range<usize>>, Vec<DVector<f64>>)>,
    min_shown: f64,
}

impl Spread {
    /// Spread of a fit.
    pub fn of(search: &Search, found: &Found) -> Self {
        let fit = &found.fit;
        let Equations { normal, priors, .. } = search.equations(found, &[]);
        let Solution { estimate: whole, covariance, .. } = normal.fit(&fit.free, &priors);
        let forms = fit.columns.len()..normal.columns();
        let with_forms: Vec<usize> = fit.free.iter().copied().chain(forms).collect();
        let own = fit.free.len();
        let in_forms = normal.fit(&with_forms, &priors).covariance;
        let in_forms = in_forms.view((0, 0), (own, own)).into_owned();
        let last = normal.columns();
        let groupings =
            groupings(&search.evidence, |block| normal.block(block)[(last, last)] != 0.0);
        let blocks = groupings[0].len();
        let enough = search.settings().limits.min_groups;
        let jackknives = groupings.into_iter().filter(|groups| groups.len() >= enough);
        let jackknives = jackknives.map(|groups| {
            let change = |group| normal.without(group).fit(&fit.free, &priors).estimate - &whole;
            let changes = groups.iter().map(change).collect();
            (groups, changes)
        });
        Self {
            count: fit.unknowns.len(),
            free: fit.free.clone(),
            jackknives: jackknives.collect(),
            normal,
            covariance,
            in_forms,
            blocks,
            min_shown: search.settings().verdict.min_blocks,
        }
    }

    /// Half width of the 95 % interval of a number with this gradient by the unknowns.
    pub fn half(&self, gradient: &[f64]) -> f64 {
        debug_assert_eq!(gradient.len(), self.count);
        let by = DVector::from_fn(self.free.len(), |k, _| gradient[self.free[k]]);
        let half = |variance: f64, groups: usize| {
            Student::new(0.0, variance.max(0.0).sqrt(), groups, 1).high
        };
        let mut most = half(by.dot(&(&self.in_forms * &by)), self.blocks);
        // w = Σ g: its covariance with all
        let with_all = &self.covariance * &by;
        for (groups, changes) in &self.jackknives {
            if shown_by(&self.normal, groups, &self.free, &with_all) < self.min_shown {
                continue;
            }
            // (B − 1)/B Σ (gᵀ (θ₋ᵦ − θ))²
            let squares: f64 = changes.iter().map(|change| by.dot(change).powi(2)).sum();
            let share = 1.0 - real(groups.len()).recip();
            most = most.max(half(share * squares, groups.len()));
        }
        most
    }
}
