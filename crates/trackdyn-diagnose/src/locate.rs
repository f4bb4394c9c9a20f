//! Tests of where evidence departs from constant ICRs, without a model of the cause.
//!
//! # Law
//! On level ground and in slow driving the ICRs are constant (the constancy theorem). Any other
//! effect moves them with speed, direction, manoeuvre, side, heading, place, time or change of
//! speed. Each symmetry is tested by contrasts that would break it: the Jacobian by the ICRs times
//! a function of how the robot was driven.

pub mod cells;
mod contrasts;
mod departures;
mod past;
mod waves;

pub use contrasts::{Manoeuvre, Scales, contrasts, contrasts_within};
pub use departures::Contrasts;
pub use waves::{Along, Wave};

use crate::equations::{Equations, Stack};
use crate::evidence::{Evidence, Sample};
use crate::fit::Fit;
use crate::form::Forms;
use crate::mechanics::Instruments;
use crate::normal::{Normal, Prior};
use crate::resampling::Resampling;
use crate::settings;
use crate::significance::{Test, test};
use crate::weighted::Weighted;
use nalgebra::Vector3;
use std::cell::LazyCell;
use trackdyn_core::real;
use trackdyn_model::effect::Symmetry;
use waves::{KINDS, Remainder};

/// Jacobian of a prediction by x_l, x_r and y, not whitened.
pub type IcrColumns = [Vec<Vector3<f64>>; 3];

/// Jacobian of the prediction by x_l, x_r and y, by finite differences, not whitened.
pub fn icr_columns(evidence: &Evidence, fit: &Fit) -> IcrColumns {
    let instruments = Instruments::of(&fit.hypothesis);
    let step = evidence.settings().fit.icr_difference * fit.hypothesis.vehicle.gauge;
    let here = fit.mechanics.predict(&instruments, evidence);
    std::array::from_fn(|k| {
        let mut moved = instruments;
        moved.offset[k] += step;
        let there = fit.mechanics.predict(&moved, evidence);
        there.iter().zip(&here).map(|(there, here)| (there - here) / step).collect()
    })
}

/// Test of one symmetry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetryTest {
    /// The symmetry.
    pub symmetry: Symmetry,
    /// The most significant test of its contrasts, family-wise over all symmetries.
    pub test: Test,
}

/// Where the evidence departs from a prediction.
#[derive(Clone, Debug)]
pub struct Location {
    /// Weighted root mean square of the whitened residual: one where only noise is left.
    pub excess_over_noise: f64,
    /// Shares of the chi-squared above noise: longitudinal, lateral, yaw.
    pub channels: [f64; 3],
    /// Tests of all symmetries for which this evidence has contrasts.
    pub tests: Vec<SymmetryTest>,
    /// The most significant wave of each kind, where it breaks its symmetry more than any plainer
    /// contrast.
    pub waves: Vec<Wave>,
    /// Chi-squared explained by all contrasts jointly, minus its degrees of freedom.
    pub explicable: f64,
    /// Largest family-wise p of a broken symmetry, and of one that a corrected model leaves broken.
    pub max_p: [f64; 2],
}

impl Location {
    /// Symmetries that are significantly broken.
    pub fn broken(&self) -> Vec<Symmetry> {
        let tests = self.tests.iter().filter(|test| test.test.p < self.max_p[0]);
        tests.map(|test| test.symmetry).collect()
    }

    /// Symmetries that a corrected model leaves significantly broken, by a chi-squared above
    /// `form`, the tolerance for the form of its laws.
    pub fn left_over(&self, form: f64) -> Vec<Symmetry> {
        let tests = self.tests.iter();
        let beyond = |test: &SymmetryTest| test.test.statistic - real(test.test.degrees);
        let tests = tests.filter(|test| test.test.p < self.max_p[1] && beyond(test) > form);
        tests.map(|test| test.symmetry).collect()
    }
}

/// Residual of a fit, to be located.
#[derive(Clone, Copy)]
pub struct Residual<'a> {
    /// The evidence.
    pub evidence: &'a Weighted,
    /// The fit that leaves it.
    pub fit: &'a Fit,
    /// What the form of its laws may leave.
    pub forms: &'a Forms,
    /// Jacobian of the prediction by x_l, x_r and y, not whitened.
    pub icrs: &'a IcrColumns,
}

impl Residual<'_> {
    /// Tests all symmetries on the residual.
    pub fn locate(&self, resampling: Resampling) -> Location {
        let Self { evidence, fit, forms, icrs } = *self;
        let settings = &evidence.settings().location;
        let Fit { residual, columns: fitted, .. } = fit;
        let mut stack = Stack::new(fitted.clone(), vec![Prior::flat(); fitted.len()])
            .with_free(&forms.columns, &forms.priors);
        let mut of_groups: Vec<Contrasts> = Vec::new();
        for mut contrasts in contrasts(evidence, icrs) {
            let columns = std::mem::take(&mut contrasts.columns).into_iter();
            stack.push(columns.map(|column| (evidence.white(column), Prior::flat())));
            of_groups.push(contrasts);
        }
        let equations = stack.equations(|columns| evidence.normal(residual, columns));
        let Tested { projected, tests } = Tested::new(&equations, &of_groups, resampling, settings);
        let together = [equations.groups.concat()];
        let all = test(&projected, &together, resampling.once(), settings);
        Location {
            excess_over_noise: excess(evidence, residual),
            channels: channel_shares(evidence, residual),
            tests,
            waves: Vec::new(),
            explicable: all.first().map_or(0.0, |all| all.statistic - real(all.degrees)),
            max_p: [settings.max_p, settings.max_p_left_over],
        }
    }

    /// Tests all symmetries, and waves as the strictest tests of some.
    pub fn locate_in_waves(&self, resampling: Resampling) -> Location {
        let mut location = self.locate(resampling);
        let Self { evidence, fit, icrs, .. } = *self;
        let beside =
            |columns: &[Vec<Vector3<f64>>]| Remainder::new(evidence, &fit.residual, columns);
        let beside_fit = beside(&fit.columns);
        // A plainer contrast shows in some waves too, and more so in the best of many by chance.
        let beside_contrasts = LazyCell::new(|| {
            let plainer = contrasts(evidence, icrs).into_iter();
            let plainer = plainer.flat_map(|contrasts| contrasts.columns);
            let plainer = plainer.map(|column| evidence.white(column));
            beside(&fit.columns.iter().cloned().chain(plainer).collect::<Vec<_>>())
        });
        for waves in KINDS.iter().filter_map(|kind| kind(evidence, fit, icrs)) {
            let strongest = |remainder: &Remainder| {
                let wave = waves.strongest(remainder, resampling);
                wave.filter(|wave| wave.test.p < location.max_p[0])
            };
            let wave = strongest(&beside_fit).and_then(|_| strongest(&beside_contrasts));
            let Some(wave) = wave else { continue };
            let same = |test: &&mut SymmetryTest| test.symmetry == wave.along.symmetry();
            let plain = location.tests.iter_mut().find(same);
            if let Some(plain) = plain.filter(|plain| wave.test.is_stronger(&plain.test)) {
                plain.test = wave.test;
                location.waves.push(wave);
            }
        }
        location
    }
}

/// Tests of contrasts that stand in the same normal equations, a group each.
pub(crate) struct Tested {
    /// The equations beside what is free, and contrasts beside the plainer ones of theirs.
    pub projected: Normal,
    /// The strongest test of each symmetry.
    pub tests: Vec<SymmetryTest>,
}

impl Tested {
    /// Tests the groups of these equations as one family: each is one of the `kinds`.
    pub fn new(
        equations: &Equations,
        kinds: &[Contrasts],
        resampling: Resampling,
        settings: &settings::Location,
    ) -> Self {
        let mut projected = equations.projected();
        let groups = || kinds.iter().zip(&equations.groups);
        for (contrasts, own) in groups().filter(|(contrasts, _)| !contrasts.beside.is_empty()) {
            let is_plain = |(other, _): &(&Contrasts, &Vec<usize>)| {
                other.beside.is_empty() && contrasts.beside.contains(&other.symmetry)
            };
            let beside = groups().filter(is_plain).flat_map(|(_, columns)| columns.clone());
            projected = projected.cleared(own, &beside.collect::<Vec<_>>());
        }
        let mut strongest: Vec<SymmetryTest> = Vec::new();
        let tests = test(&projected, &equations.groups, resampling, settings);
        for (&Contrasts { symmetry, .. }, test) in kinds.iter().zip(tests) {
            match strongest.iter_mut().find(|other| other.symmetry == symmetry) {
                Some(other) if test.is_stronger(&other.test) => other.test = test,
                Some(_) => {}
                None => strongest.push(SymmetryTest { symmetry, test }),
            }
        }
        Self { projected, tests: strongest }
    }
}

/// Weighted root mean square of the whitened residual over all measured values.
pub fn excess(evidence: &Weighted, residual: &[Vector3<f64>]) -> f64 {
    excess_of(evidence, residual, |_, _| true)
}

/// Weighted root mean square of the whitened residual over selected samples and channels.
pub fn excess_of(
    evidence: &Weighted,
    residual: &[Vector3<f64>],
    counts: impl Fn(&Sample, usize) -> bool,
) -> f64 {
    let weights = evidence.weights(residual);
    let (mut sum, mut count) = (0.0, 0.0);
    for (index, (z, sample)) in residual.iter().zip(evidence.samples()).enumerate() {
        for channel in 0..3 {
            if evidence.is_measured(index, channel) && counts(sample, channel) {
                sum += weights[index] * z[channel] * z[channel];
                count += 1.0;
            }
        }
    }
    (sum / f64::max(count, 1.0)).sqrt()
}

fn channel_shares(evidence: &Weighted, residual: &[Vector3<f64>]) -> [f64; 3] {
    let weights = evidence.weights(residual);
    let beyond: [f64; 3] = std::array::from_fn(|channel| {
        let measured = (0..residual.len()).filter(|&index| evidence.is_measured(index, channel));
        let sum: f64 =
            measured.map(|index| weights[index] * residual[index][channel].powi(2) - 1.0).sum();
        sum.max(0.0)
    });
    let whole: f64 = beyond.iter().sum();
    if whole > 0.0 { beyond.map(|part| part / whole) } else { [0.0; 3] }
}
