//! How well a recording determines a number that depends on several unknowns.

use super::{groupings, shown_by};
use crate::equations::Equations;
use crate::normal::{Normal, Prior, Solution};
use crate::search::{Found, Search};
use nalgebra::{DMatrix, DVector};
use std::ops::Range;
use trackdyn_core::real;
use trackdyn_estimate::Interval as Student;

/// Covariances of the unknowns of a fit: by the noise, beside which other forms of the laws are as
/// free as the unknowns, and by two jackknives of the laws as they stand, over blocks and over
/// runs. The largest variance counts.
pub(crate) struct Spread {
    /// Normal equations of the unknowns, then of the forms of their laws.
    normal: Normal,
    priors: Vec<Prior>,
    /// Number of unknowns.
    count: usize,
    /// Unknowns that are not held at a bound.
    free: Vec<usize>,
    /// Independent blocks that count.
    blocks: usize,
    /// Groups that each jackknife leaves out.
    groupings: Vec<Vec<Range<usize>>>,
    min_shown: f64,
    with_free: Covariances,
}

/// Covariances of some unknowns, all others being held.
struct Covariances {
    unknowns: Vec<usize>,
    /// With the laws as they stand.
    own: DMatrix<f64>,
    /// In other forms of the laws.
    in_forms: DMatrix<f64>,
    /// For each jackknife, changes of the estimate by leaving out each group.
    changes: Vec<Vec<DVector<f64>>>,
}

impl Spread {
    /// Spread of a fit.
    pub fn of(search: &Search, found: &Found) -> Self {
        let fit = &found.fit;
        let Equations { normal, priors, .. } = search.equations(found, &[]);
        let last = normal.columns();
        let groupings =
            groupings(&search.evidence, |block| normal.block(block)[(last, last)] != 0.0);
        let blocks = groupings[0].len();
        let enough = search.settings().limits.min_groups;
        let groupings: Vec<_> =
            groupings.into_iter().filter(|groups| groups.len() >= enough).collect();
        let with_free = Covariances::of(
            &normal,
            &priors,
            fit.free.clone(),
            fit.columns.len()..normal.columns(),
            &groupings,
        );
        Self {
            count: fit.unknowns.len(),
            free: fit.free.clone(),
            min_shown: search.settings().verdict.min_blocks,
            normal,
            priors,
            blocks,
            groupings,
            with_free,
        }
    }

    /// Half width of the 95 % interval of an unknown.
    pub fn half_of(&self, place: usize) -> f64 {
        let mut gradient = vec![0.0; self.count];
        gradient[place] = 1.0;
        self.half(&gradient)
    }

    /// Half width of the 95 % interval of a number that the recording does not tell, of this
    /// variance.
    pub fn half_unseen(&self, variance: f64) -> f64 {
        half(variance, self.blocks)
    }

    /// Half width of the 95 % interval of a number with this gradient by the unknowns.
    ///
    /// Where the number depends on an unknown that ended at its bound, that unknown is free here.
    /// The bound cuts off only what lies beyond it. How far the number may lie on this side of the
    /// bound is for the recordings to tell.
    pub fn half(&self, gradient: &[f64]) -> f64 {
        debug_assert_eq!(gradient.len(), self.count);
        let is_held = |place: &usize| gradient[*place] != 0.0 && !self.free.contains(place);
        let held: Vec<usize> = (0..self.count).filter(is_held).collect();
        if held.is_empty() {
            return self.half_within(&self.with_free, gradient);
        }
        let unknowns = self.free.iter().copied().chain(held).collect();
        let forms = self.count..self.normal.columns();
        let covariances =
            Covariances::of(&self.normal, &self.priors, unknowns, forms, &self.groupings);
        self.half_within(&covariances, gradient)
    }

    fn half_within(&self, of: &Covariances, gradient: &[f64]) -> f64 {
        let by = DVector::from_iterator(
            of.unknowns.len(),
            of.unknowns.iter().map(|&unknown| gradient[unknown]),
        );
        let mut most = half(by.dot(&(&of.in_forms * &by)), self.blocks);
        // w = Σ g: its covariance with all
        let with_all = &of.own * &by;
        for (groups, changes) in self.groupings.iter().zip(&of.changes) {
            if shown_by(&self.normal, groups, &of.unknowns, &with_all) < self.min_shown {
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

/// Half width of a 95 % interval by Student's quantile.
fn half(variance: f64, groups: usize) -> f64 {
    Student::new(0.0, variance.max(0.0).sqrt(), groups, 1).high
}

impl Covariances {
    fn of(
        normal: &Normal,
        priors: &[Prior],
        unknowns: Vec<usize>,
        forms: Range<usize>,
        groupings: &[Vec<Range<usize>>],
    ) -> Self {
        let Solution { estimate: whole, covariance, .. } = normal.fit(&unknowns, priors);
        let with_forms: Vec<usize> = unknowns.iter().copied().chain(forms).collect();
        let count = unknowns.len();
        let in_forms = normal.fit(&with_forms, priors).covariance;
        let in_forms = in_forms.view((0, 0), (count, count)).into_owned();
        let change = |group| normal.without(group).fit(&unknowns, priors).estimate - &whole;
        let changes = groupings.iter().map(|groups| groups.iter().map(change).collect()).collect();
        Self { unknowns, own: covariance, in_forms, changes }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::Alternatives;
    use crate::normal::Columns;
    use nalgebra::Vector3;

    const BLOCKS: usize = 40;
    const SAMPLES: usize = 10;

    /// A set with two unknowns whose columns are c₀ = (1, 0, 0) and c₁ = (½, s, 0), s the slope of
    /// the prediction by the second: the second is held at a bound.
    fn held_at_its_bound(slope: f64, deviation: f64) -> Spread {
        let samples = BLOCKS * SAMPLES;
        let columns = [vec![Vector3::x(); samples], vec![Vector3::new(0.5, slope, 0.0); samples]];
        // noise of deviation one, the same in every run of the test
        let noise = |k: usize| f64::from(u32::try_from(k * 37 % 101).expect("small")) / 29.2 - 1.71;
        let residual: Vec<Vector3<f64>> =
            (0..samples).map(|k| Vector3::new(noise(k), noise(k + 13), noise(k + 57))).collect();
        let normal = Normal::new(&Columns {
            residual: &residual,
            columns: &columns,
            weights: &vec![1.0; samples],
            blocks: &(0..samples).map(|k| k / SAMPLES).collect::<Vec<_>>(),
            count: BLOCKS,
        });
        let priors = vec![Prior::normal(0.0, 10.0), Prior::normal(0.0, deviation)];
        let groupings = vec![(0..BLOCKS).map(|block| block..block + 1).collect::<Vec<_>>()];
        let with_free = Covariances::of(&normal, &priors, vec![0], 2..2, &groupings);
        Spread {
            normal,
            priors,
            count: 2,
            free: vec![0],
            blocks: BLOCKS,
            groupings,
            min_shown: 8.0,
            with_free,
        }
    }

    /// Beside a free c₀ the second unknown shows in the second channel alone: its variance is
    /// 1/(n s²), n the number of samples, whatever its prior.
    #[test]
    fn a_size_at_its_bound_is_known_as_well_as_the_recordings_tell() {
        let (slope, deviation) = (10.0, 0.9);
        let half = held_at_its_bound(slope, deviation).half(&[0.0, 1.0]);
        let of_noise = 2.0 / (real(BLOCKS * SAMPLES).sqrt() * slope);
        assert!((0.8..1.6).contains(&(half / of_noise)), "{half} {of_noise}");
        // none here, 0.2 ± 0.006 there: a difference by the information, not by the prior
        let prior = Prior::normal(0.0, deviation);
        let there = [0.2, 0.006_f64.powi(2)];
        let by = |half: f64| {
            Alternatives::of([[0.0, (half / 1.96).powi(2)], there], &prior).for_difference()
        };
        assert!(by(half) > 50.0, "{}", by(half));
        assert!(by(1.96 * deviation) < 1.0, "{}", by(1.96 * deviation));
    }

    /// What the recordings do not show is known as far as the prior goes.
    #[test]
    fn a_size_that_does_not_show_keeps_its_prior() {
        let half = held_at_its_bound(0.0, 0.9).half(&[0.0, 1.0]);
        assert!((half / (2.02 * 0.9) - 1.0).abs() < 0.05, "{half}");
    }
}
