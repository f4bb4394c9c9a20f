//! Where evidence departs from constant ICRs, without a model of why.
//!
//! # Law
//! On level ground and in slow driving the ICR triple is one point (the constancy theorem). Whatever else
//! moves it does so with speed, direction, manoeuvre, side, heading, place, time or change of speed. Each
//! symmetry is tested by the departures that would break it: the ICRs' derivative of the prediction times a
//! function of how the robot was driven.

pub mod cells;
mod contrasts;

pub use contrasts::{Manoeuvre, contrasts};

use crate::evidence::Evidence;
use crate::metric::Metric;
use crate::normal::Prior;
use crate::significance::{Test, test};
use nalgebra::Vector3;
use trackdyn_core::real;
use trackdyn_physics::effect::Symmetry;

/// Derivatives of a prediction by x_l, x_r and y, not whitened.
pub type IcrColumns = [Vec<Vector3<f64>>; 3];

/// A test of one symmetry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetryTest {
    /// The symmetry.
    pub symmetry: Symmetry,
    /// Its test, as part of the family of all symmetries.
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
    /// What the contrasts of all symmetries together explain, as χ² beyond their number.
    pub explicable: f64,
}

/// Family-wise probability below which a symmetry counts as broken.
pub const SIGNIFICANT: f64 = 0.01;

/// Family-wise probability below which a corrected model is not the whole of it: no simulator equals the
/// ground to all digits, so that more is asked than of a location.
pub const SURE: f64 = 0.001;

impl Location {
    /// The symmetries that are broken.
    pub fn broken(&self) -> Vec<Symmetry> {
        let tests = self.tests.iter().filter(|test| test.test.p < SIGNIFICANT);
        tests.map(|test| test.symmetry).collect()
    }

    /// The symmetries that a corrected model still breaks: surely, and by more than a χ² of `form`, which the
    /// form of its laws may leave.
    pub fn left_over(&self, form: f64) -> Vec<Symmetry> {
        let tests = self.tests.iter();
        let beyond = |test: &SymmetryTest| test.test.statistic - real(test.test.degrees);
        let tests = tests.filter(|test| test.test.p < SURE && beyond(test) > form);
        tests.map(|test| test.symmetry).collect()
    }
}

/// What the residual of a fit shows.
///
/// `residual` and `fitted` (the derivatives by all that was fitted) are whitened; `icrs` are the derivatives
/// of the prediction by x_l, x_r and y, not whitened.
pub fn locate(
    evidence: &Evidence,
    metric: &Metric,
    residual: &[Vector3<f64>],
    fitted: &[Vec<Vector3<f64>>],
    icrs: &IcrColumns,
    draws: usize,
    seed: u64,
) -> Location {
    let contrasts = contrasts(evidence, icrs);
    let mut columns = fitted.to_vec();
    let mut groups: Vec<(Symmetry, Vec<usize>)> = Vec::new();
    for (symmetry, column) in contrasts {
        let index = columns.len();
        columns.push(metric.white(evidence, column));
        match groups.iter_mut().find(|(other, _)| *other == symmetry) {
            Some((_, group)) => group.push(index),
            None => groups.push((symmetry, vec![index])),
        }
    }
    let normal = metric.normal(evidence, residual, &columns);
    let base: Vec<usize> = (0..fitted.len()).collect();
    let flat = vec![Prior { mean: 0.0, deviation: 1e9 }; columns.len()];
    let projected = normal.projected(&base, &flat);
    let indices: Vec<Vec<usize>> = groups.iter().map(|(_, group)| group.clone()).collect();
    let tests = test(&projected, &indices, draws, seed);
    let all = test(&projected, &[indices.concat()], 1, seed);
    Location {
        excess_over_noise: excess(evidence, metric, residual),
        channels: shares(evidence, metric, residual),
        tests: groups
            .iter()
            .zip(tests)
            .map(|((symmetry, _), test)| SymmetryTest { symmetry: *symmetry, test })
            .collect(),
        explicable: all.first().map_or(0.0, |all| all.statistic - real(all.degrees)),
    }
}

/// Root mean square of the whitened residual over what was measured.
pub fn excess(evidence: &Evidence, metric: &Metric, residual: &[Vector3<f64>]) -> f64 {
    let weights = metric.weights(evidence, residual);
    let (mut sum, mut count) = (0.0, 0.0);
    for (index, z) in residual.iter().enumerate() {
        for channel in 0..3 {
            if weights[index] > 0.0 && evidence.is_measured(index, channel) {
                sum += weights[index] * z[channel] * z[channel];
                count += 1.0;
            }
        }
    }
    (sum / f64::max(count, 1.0)).sqrt()
}

fn shares(evidence: &Evidence, metric: &Metric, residual: &[Vector3<f64>]) -> [f64; 3] {
    let weights = metric.weights(evidence, residual);
    let beyond: [f64; 3] = std::array::from_fn(|channel| {
        let measured = (0..residual.len())
            .filter(|&index| weights[index] > 0.0 && evidence.is_measured(index, channel));
        let sum: f64 =
            measured.map(|index| weights[index] * residual[index][channel].powi(2) - 1.0).sum();
        sum.max(0.0)
    });
    let whole: f64 = beyond.iter().sum();
    if whole > 0.0 { beyond.map(|part| part / whole) } else { [0.0; 3] }
}
