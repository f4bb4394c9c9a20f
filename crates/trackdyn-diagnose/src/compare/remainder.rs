//! Where two sets differ, whatever the reason: the location method on the difference of what their
//! models leave.
//!
//! # Law
//! A contrast is a function of how the robot was driven. Its factor is free in common, and may
//! differ by a second one in the second set. The second is tested. So a departure that both sets
//! share is no difference, and schedules need not be the same.

use super::choice::Choice;
use super::joint::Joint;
use crate::diagnosis::Examination;
use crate::evidence::Sample;
use crate::fit::Fit;
use crate::locate::cells::{Cell, cells_within, thirds};
use crate::locate::{
    Contrasts, IcrColumns, Scales, SymmetryTest, Tested, contrasts_within, icr_columns,
};
use crate::normal::Prior;
use crate::resampling::Resampling;
use nalgebra::Vector3;
use trackdyn_core::real;
use trackdyn_model::effect::Symmetry;

/// Where two sets differ.
#[derive(Clone, Debug)]
pub struct Remainder {
    /// Tests of all symmetries for which both sets have contrasts.
    pub tests: Vec<SymmetryTest>,
    /// Largest family-wise p of a symmetry in which they differ, and of one in which they surely
    /// do.
    pub max_p: [f64; 2],
    /// Chi-squared that may be left in one symmetry: by the form of the laws, by the form of what
    /// both sets have in common, and by the noise.
    pub tolerated: f64,
}

impl Remainder {
    /// Symmetries in which the sets differ, ascending.
    pub fn broken(&self) -> Vec<Symmetry> {
        self.below(self.max_p[0])
    }

    /// Symmetries in which they surely differ, by the p value that is asked of what a corrected
    /// model leaves.
    pub fn surely_broken(&self) -> Vec<Symmetry> {
        self.below(self.max_p[1])
    }

    fn below(&self, max_p: f64) -> Vec<Symmetry> {
        let is_broken = |one: &&SymmetryTest| {
            let beyond = one.test.statistic - real(one.test.degrees);
            one.test.p < max_p && beyond > self.tolerated
        };
        let mut broken: Vec<Symmetry> =
            self.tests.iter().filter(is_broken).map(|one| one.symmetry).collect();
        broken.sort_unstable();
        broken
    }
}

/// Jacobians of both predictions by the ICRs, not whitened.
pub(super) fn icrs(sets: [&Examination; 2], choice: &Choice) -> [IcrColumns; 2] {
    [0, 1].map(|k| icr_columns(&sets[k].search.evidence, &choice.fits[k].fit))
}

/// Tests contrasts between two sets, beside what is free in `joint`. `explained` is the chi-squared
/// of named differences, whose laws, too, are known only to a share.
pub(super) fn remainder(
    sets: [&Examination; 2],
    choice: &Choice,
    mut joint: Joint,
    icrs: &[IcrColumns; 2],
    explained: f64,
    resampling: Resampling,
) -> Remainder {
    let evidence = sets.map(|set| &set.search.evidence);
    let scales = Scales::of(evidence[0]).joined(&Scales::of(evidence[1]));
    let [first, second] = [0, 1].map(|k| contrasts_within(&scales, evidence[k], &icrs[k]));
    let mut groups = Vec::new();
    let mut kinds: Vec<Contrasts> = Vec::new();
    let departure: f64 = sets
        .iter()
        .zip(&choice.fits)
        .map(|(set, fit)| (set.search.base.fit.objective - fit.fit.objective).max(0.0))
        .sum();
    let before = misfit(&joint);
    for contrasts in first {
        let is_same = |other: &&Contrasts| {
            other.symmetry == contrasts.symmetry && other.beside == contrasts.beside
        };
        let Some(other) = second.iter().find(is_same) else { continue };
        let mut group = Vec::new();
        for (a, b) in contrasts.columns.iter().zip(&other.columns) {
            let [a, b] = [evidence[0].white(a.clone()), evidence[1].white(b.clone())];
            if [&a, &b].iter().any(|column| column.iter().all(|value| value.norm() == 0.0)) {
                continue; // one set alone was driven so: nothing to compare
            }
            group.push((joint.alone(1, &b), Prior::flat()));
            joint.free_in_both([&a, &b], Prior::flat());
        }
        groups.push(group);
        kinds.push(Contrasts { columns: Vec::new(), ..contrasts });
    }
    let alike = (before - misfit(&joint)).max(0.0);
    let equations = joint.equations(groups);
    let settings = sets[0].search.settings();
    let location = &settings.location;
    let Tested { tests, .. } = Tested::new(&equations, &kinds, resampling, location);
    let measured: usize = evidence.iter().map(|evidence| evidence.measured()).sum();
    let form = location.max_form_left.powi(2) * (departure + alike + explained);
    Remainder {
        tests,
        max_p: [location.max_p, location.max_p_left_over],
        tolerated: form + location.max_noise_left * real(measured),
    }
}

/// Chi-squared that is left beside what is free.
pub(super) fn misfit(joint: &Joint) -> f64 {
    joint.equations(Vec::new()).fit_with(&[]).misfit
}

/// What is free in each set by itself: unknowns of both fits and the form of their laws.
pub(super) fn apart<'a>(sets: [&'a Examination; 2], choice: &'a Choice) -> Joint<'a> {
    let fits: [&Fit; 2] = [&choice.fits[0].fit, &choice.fits[1].fit];
    let evidence = sets.map(|set| &set.search.evidence);
    let mut joint = Joint::new(evidence, fits.map(|fit| &fit.residual[..]));
    for (k, fit) in fits.into_iter().enumerate() {
        for column in &fit.columns {
            joint.free_in(k, column, Prior::flat());
        }
        let forms = &choice.fits[k].forms;
        for (column, prior) in forms.columns.iter().zip(&forms.priors) {
            joint.free_in(k, column, *prior);
        }
    }
    joint
}

/// ICRs by cells of driving in each set, between the same speeds.
pub(super) fn cells(
    sets: [&Examination; 2],
    icrs: &[IcrColumns; 2],
    residuals: &[Vec<Vector3<f64>>; 2],
) -> [Vec<Cell>; 2] {
    let samples = |k: usize| -> &[Sample] { sets[k].search.evidence.samples() };
    let Some(bounds) = thirds(samples(0).iter().chain(samples(1))) else {
        return [Vec::new(), Vec::new()];
    };
    [0, 1].map(|k| cells_within(bounds, &sets[k].search.evidence, &residuals[k], &icrs[k]))
}
