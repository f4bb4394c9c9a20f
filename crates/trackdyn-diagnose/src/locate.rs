//! Where evidence departs from constant ICRs, without a model of why.
//!
//! # Law
//! On level ground and in slow driving the ICR triple is one point (the constancy theorem).
//! Whatever else moves it does so with speed, direction, manoeuvre, side, heading, place, time or
//! change of speed. Each symmetry is tested by the departures that would break it: the ICRs'
//! derivative of the prediction times a function of how the robot was driven.

pub mod cells;
mod contrasts;
mod departures;
mod past;
mod waves;

pub use contrasts::{Manoeuvre, contrasts};
pub use departures::Contrasts;
pub use waves::Wave;

use crate::equations::Stack;
use crate::evidence::{Evidence, Sample};
use crate::fit::Fit;
use crate::mechanics::Instruments;
use crate::normal::Prior;
use crate::resampling::Resampling;
use crate::significance::{Test, test};
use crate::weighted::Weighted;
use nalgebra::Vector3;
use trackdyn_core::real;
use trackdyn_model::effect::Symmetry;
use waves::strongest_wave;

/// Derivatives of a prediction by x_l, x_r and y, not whitened.
pub type IcrColumns = [Vec<Vector3<f64>>; 3];

/// Derivatives of the prediction by x_l, x_r and y, not whitened.
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

/// A test of one symmetry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetryTest {
    /// The symmetry.
    pub symmetry: Symmetry,
    /// The strongest test of its contrasts, as part of the family of all symmetries.
    pub test: Test,
}

/// Where the evidence departs from a prediction.
#[derive(Clone, Debug)]
pub struct Location {
    /// Root mean square of the whitened residual: one where only noise is left.
    pub excess_over_noise: f64,
    /// Shares of the excess: longitudinal, lateral, yaw.
    pub channels: [f64; 3],
    /// The test of every symmetry that this evidence can test.
    pub tests: Vec<SymmetryTest>,
    /// The strongest wave of the ground, where it breaks the symmetry of places more than anything
    /// plainer does.
    pub wave: Option<Wave>,
    /// What the contrasts of all symmetries together explain, as χ² beyond their number.
    pub explicable: f64,
    /// Largest family-wise p of a broken symmetry, and of one that a corrected model leaves over.
    pub max_p: [f64; 2],
}

impl Location {
    /// The symmetries that are broken.
    pub fn broken(&self) -> Vec<Symmetry> {
        let tests = self.tests.iter().filter(|test| test.test.p < self.max_p[0]);
        tests.map(|test| test.symmetry).collect()
    }

    /// The symmetries that a corrected model still breaks: surely, and by more than a χ² of `form`,
    /// which the form of its laws may leave.
    pub fn left_over(&self, form: f64) -> Vec<Symmetry> {
        let tests = self.tests.iter();
        let beyond = |test: &SymmetryTest| test.test.statistic - real(test.test.degrees);
        let tests = tests.filter(|test| test.test.p < self.max_p[1] && beyond(test) > form);
        tests.map(|test| test.symmetry).collect()
    }
}

/// What a fit leaves, to be located.
#[derive(Clone, Copy)]
pub struct Residual<'a> {
    /// The evidence.
    pub evidence: &'a Weighted,
    /// The fit.
    pub fit: &'a Fit,
    /// Derivatives of its prediction by x_l, x_r and y, not whitened.
    pub icrs: &'a IcrColumns,
}

impl Residual<'_> {
    /// What it shows.
    pub fn locate(&self, resampling: Resampling) -> Location {
        let Self { evidence, fit, icrs } = *self;
        let settings = &evidence.settings().location;
        let Fit { residual, columns: fitted, .. } = fit;
        let mut stack = Stack::new(fitted.clone(), vec![Prior::flat(); fitted.len()]);
        let mut of_groups: Vec<Contrasts> = Vec::new();
        for mut contrasts in contrasts(evidence, icrs) {
            let columns = std::mem::take(&mut contrasts.columns).into_iter();
            stack.push(columns.map(|column| (evidence.white(column), Prior::flat())));
            of_groups.push(contrasts);
        }
        let equations = stack.equations(|columns| evidence.normal(residual, columns));
        let mut projected = equations.projected();
        let groups: Vec<(Contrasts, Vec<usize>)> =
            of_groups.into_iter().zip(equations.groups.iter().cloned()).collect();
        for (contrasts, own) in groups.iter().filter(|(contrasts, _)| !contrasts.beside.is_empty())
        {
            let is_plain = |(other, _): &&(Contrasts, Vec<usize>)| {
                other.beside.is_empty() && contrasts.beside.contains(&other.symmetry)
            };
            let beside = groups.iter().filter(is_plain).flat_map(|(_, columns)| columns.clone());
            projected = projected.cleared(own, &beside.collect::<Vec<_>>());
        }
        let tests = test(&projected, &equations.groups, resampling, settings);
        let together = [equations.groups.concat()];
        let all = test(&projected, &together, resampling.once(), settings);
        let mut strongest: Vec<SymmetryTest> = Vec::new();
        for ((Contrasts { symmetry, .. }, _), test) in groups.into_iter().zip(tests) {
            match strongest.iter_mut().find(|other| other.symmetry == symmetry) {
                Some(other) if test.is_stronger(&other.test) => other.test = test,
                Some(_) => {}
                None => strongest.push(SymmetryTest { symmetry, test }),
            }
        }
        Location {
            excess_over_noise: excess(evidence, residual),
            channels: shares(evidence, residual),
            tests: strongest,
            wave: None,
            explicable: all.first().map_or(0.0, |all| all.statistic - real(all.degrees)),
            max_p: [settings.max_p, settings.max_p_left_over],
        }
    }

    /// What it shows in waves of the ground as well: these are the strictest test of places.
    pub fn locate_in_waves(&self, resampling: Resampling) -> Location {
        let mut location = self.locate(resampling);
        let Self { evidence, fit, icrs } = *self;
        let strongest = |beside: &[Vec<Vector3<f64>>]| {
            let wave = strongest_wave(evidence, &fit.residual, beside, icrs, resampling);
            wave.filter(|wave| wave.test.p < location.max_p[0])
        };
        // What plainer contrasts show is in some waves as well, and in the best of so many by
        // chance.
        let wave = strongest(&fit.columns).and_then(|_| {
            let plainer =
                contrasts(evidence, icrs).into_iter().flat_map(|contrasts| contrasts.columns);
            let plainer = plainer.map(|column| evidence.white(column));
            strongest(&fit.columns.iter().cloned().chain(plainer).collect::<Vec<_>>())
        });
        let place = location.tests.iter_mut().find(|test| test.symmetry == Symmetry::Place);
        let stronger = wave.zip(place).filter(|(wave, place)| wave.test.is_stronger(&place.test));
        if let Some((wave, place)) = stronger {
            place.test = wave.test;
            location.wave = Some(wave);
        }
        location
    }
}

/// Root mean square of the whitened residual over what was measured.
pub fn excess(evidence: &Weighted, residual: &[Vector3<f64>]) -> f64 {
    excess_of(evidence, residual, |_, _| true)
}

/// The excess over those samples and channels that count.
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

fn shares(evidence: &Weighted, residual: &[Vector3<f64>]) -> [f64; 3] {
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
