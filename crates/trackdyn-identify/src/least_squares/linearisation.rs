//! Whitened residuals and their derivatives at a point, and the sums that least squares needs of them.

use super::covariance::jackknife;
use super::identifiability::inverse;
use super::{Estimate, Loss, Unknowns};
use crate::observations::Observations;
use crate::parameters::Parameters;
use crate::sensor::{Nuisance, Report, Sensor, report};
use crate::weighting::{Weighting, Whitener};
use nalgebra::{DMatrix, DVector, Vector3};
use rayon::prelude::*;
use std::ops::Range;

/// Where the iteration stands.
#[derive(Clone, Copy)]
pub(super) struct Point {
    pub(super) parameters: Parameters,
    pub(super) sensor: Sensor,
}

impl Point {
    pub(super) fn stepped(mut self, unknowns: &Unknowns, step: &DVector<f64>) -> Self {
        let count = unknowns.free.count();
        for k in 0..count {
            self.parameters.0[k] += step[k];
        }
        for (k, nuisance) in unknowns.nuisances.iter().enumerate() {
            self.sensor = self.sensor.stepped(*nuisance, step[count + k]);
        }
        self
    }
}

/// Whitened residuals and derivatives at a point.
pub(super) struct Linearisation {
    residuals: Vec<Vector3<f64>>,
    columns: Vec<Vec<Vector3<f64>>>,
}

impl Linearisation {
    pub(super) fn at(
        point: &Point,
        unknowns: &Unknowns,
        observations: &Observations,
        whitener: &Whitener,
    ) -> Self {
        let moved =
            (point.sensor.tau != observations.tau()).then(|| observations.at(point.sensor.tau));
        let observations = moved.as_ref().unwrap_or(observations);
        let reports: Vec<_> = observations
            .segments()
            .par_iter()
            .with_min_len(128)
            .map(|segment| {
                let pieces = observations.pieces(segment);
                (segment, report(&point.parameters, &point.sensor, pieces))
            })
            .collect();
        let mut residuals: Vec<Vector3<f64>> = reports
            .iter()
            .map(|(segment, report)| Vector3::from(segment.motion) - Vector3::from(report.motion))
            .collect();
        let column = |of: &dyn Fn(&Report) -> [f64; 3]| -> Vec<Vector3<f64>> {
            reports.iter().map(|(_, report)| Vector3::from(of(report))).collect()
        };
        let kinematic =
            (0..unknowns.free.count()).map(|k| column(&|report| report.by_parameter[k]));
        let of_sensor = unknowns.nuisances.iter().map(|nuisance| match nuisance {
            Nuisance::TimeOffset => column(&|report| report.by_tau),
            Nuisance::SensorYaw => column(&|report| report.by_yaw),
            Nuisance::LeverArm => column(&|_| [0.0; 3]),
        });
        let mut columns: Vec<Vec<Vector3<f64>>> = kinematic.chain(of_sensor).collect();
        whitener.whiten(&mut residuals);
        for column in &mut columns {
            whitener.whiten(column);
        }
        Self { residuals, columns }
    }

    pub(super) fn cost(&self, loss: Loss) -> f64 {
        self.residuals.iter().flat_map(Vector3::iter).map(|r| loss.value(*r)).sum()
    }

    pub(super) fn weights(&self, loss: Loss) -> Vec<Vector3<f64>> {
        self.residuals.iter().map(|r| r.map(|r| loss.weight(r))).collect()
    }

    /// Jᵀ W J and Jᵀ W r.
    pub(super) fn normal_equations(
        &self,
        weights: &[Vector3<f64>],
    ) -> (DMatrix<f64>, DVector<f64>) {
        self.part(0..self.residuals.len(), weights)
    }

    /// What a range of segments adds to Jᵀ W J and Jᵀ W r.
    fn part(&self, range: Range<usize>, weights: &[Vector3<f64>]) -> (DMatrix<f64>, DVector<f64>) {
        let count = self.columns.len();
        let dot = |a: &[Vector3<f64>], b: &[Vector3<f64>]| -> f64 {
            let products = range.clone().map(|k| a[k].component_mul(&weights[k]).dot(&b[k]));
            products.sum()
        };
        let matrix = DMatrix::from_fn(count, count, |i, k| dot(&self.columns[i], &self.columns[k]));
        let gradient = DVector::from_fn(count, |k, _| dot(&self.columns[k], &self.residuals));
        (matrix, gradient)
    }
}

impl Linearisation {
    pub(super) fn estimate(
        &self,
        point: &Point,
        unknowns: &Unknowns,
        observations: &Observations,
        weighting: &Weighting,
        loss: Loss,
        iterations: usize,
    ) -> Estimate {
        let weights = self.weights(loss);
        let (matrix, _) = self.normal_equations(&weights);
        let blocks = observations.blocks();
        let ranges = observations.ranges(&blocks);
        let parts: Vec<_> = ranges.into_iter().map(|range| self.part(range, &weights)).collect();
        let squares: f64 = self.residuals.iter().map(Vector3::norm_squared).sum();
        #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 residuals")]
        let degrees = (3 * self.residuals.len() - unknowns.count()) as f64;
        let variance = match weighting {
            Weighting::Noise(_) => 1.0,
            Weighting::Distance { .. } => squares / degrees,
        };
        Estimate {
            parameters: point.parameters,
            sensor: point.sensor,
            unknowns: unknowns.clone(),
            covariance: jackknife(&matrix, &parts),
            covariance_of_noise: inverse(&matrix) * variance,
            blocks,
            filled_blocks: parts.len(),
            cost: self.cost(loss),
            whitened_rms: (squares / degrees).sqrt(),
            iterations,
        }
    }
}
