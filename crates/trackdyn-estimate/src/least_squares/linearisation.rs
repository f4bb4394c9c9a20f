//! Whitened residuals and their derivatives at a point, and the sums that least squares needs of
//! them.

use super::covariance::{inverse, jackknife};
use super::{Estimate, Loss, Unknowns};
use crate::blocks::Blocks;
use crate::observations::{Observation, Observations};
use crate::parameters::{COUNT, Parameters};
use crate::prediction::Lanes;
use crate::sensor::{Nuisance, Report, Sensor};
use crate::weighting::{Weighting, Whitener};
use nalgebra::{DMatrix, DVector, Vector3};
use std::ops::Range;

/// Unknowns that there can be.
const MAX_UNKNOWNS: usize = COUNT + Nuisance::ALL.len();

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

/// Observed minus reported motions.
fn residuals(
    segments: &[Observation],
    reported: impl Iterator<Item = [f64; 3]>,
) -> Vec<Vector3<f64>> {
    let pairs = segments.iter().zip(reported);
    pairs.map(|(segment, motion)| Vector3::from(segment.motion) - Vector3::from(motion)).collect()
}

/// Derivatives of reported motions by each unknown.
fn columns(unknowns: &Unknowns, reports: &[Report]) -> Vec<Vec<Vector3<f64>>> {
    let column = |of: &dyn Fn(&Report) -> [f64; 3]| -> Vec<Vector3<f64>> {
        reports.iter().map(|report| Vector3::from(of(report))).collect()
    };
    let kinematic = (0..unknowns.free.count()).map(|k| column(&|report| report.by_parameter[k]));
    let of_sensor = unknowns.nuisances.iter().map(|nuisance| match nuisance {
        Nuisance::TimeOffset => column(&|report| report.by_tau),
        Nuisance::SensorYaw => column(&|report| report.by_yaw),
        Nuisance::LeverArm => column(&|_| [0.0; 3]),
    });
    kinematic.chain(of_sensor).collect()
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
        lanes: &Lanes,
        whitener: &Whitener,
    ) -> Self {
        let tau = point.sensor.tau;
        let moved = (tau != lanes.observations().tau()).then(|| lanes.observations().at(tau));
        let moved = moved.as_ref().map(Lanes::new);
        let lanes = moved.as_ref().unwrap_or(lanes);
        let observations = lanes.observations();
        let segments = observations.segments();
        let predictions = lanes.predict(&point.parameters);
        let (mut residuals, mut columns) = if unknowns.nuisances.is_empty() {
            // A sensor that has no yaw reports what is predicted.
            let by_parameter = (0..unknowns.free.count())
                .map(|k| predictions.iter().map(|by| by.sensitivity[k].into()).collect());
            (residuals(segments, predictions.iter().map(|of| of.motion)), by_parameter.collect())
        } else {
            let reports: Vec<Report> = segments
                .iter()
                .zip(&predictions)
                .map(|(segment, prediction)| {
                    let pieces = observations.pieces(segment);
                    Report::of(prediction, &point.parameters, &point.sensor, pieces)
                })
                .collect();
            (residuals(segments, reports.iter().map(|of| of.motion)), columns(unknowns, &reports))
        };
        whitener.whiten(&mut residuals);
        for column in &mut columns {
            whitener.whiten(column);
        }
        Self { residuals, columns }
    }

    /// Residuals and derivatives.
    pub(super) fn into_parts(self) -> (Vec<Vector3<f64>>, Vec<Vec<Vector3<f64>>>) {
        (self.residuals, self.columns)
    }

    /// Root mean square of the residuals, for the degrees of freedom that the unknowns leave.
    pub(super) fn rms(&self, unknowns: &Unknowns) -> f64 {
        let squares: f64 = self.residuals.iter().map(Vector3::norm_squared).sum();
        #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 residuals")]
        let degrees = (3 * self.residuals.len() - unknowns.count()) as f64;
        (squares / degrees).sqrt()
    }

    pub(super) fn cost(&self, loss: Loss) -> f64 {
        self.residuals.iter().flat_map(Vector3::iter).map(|r| loss.value(*r)).sum()
    }

    pub(super) fn weights(&self, loss: Loss) -> Vec<Vector3<f64>> {
        self.residuals.iter().map(|r| r.map(|r| loss.weight(r))).collect()
    }

    /// Half the second derivatives of the loss.
    pub(super) fn curvatures(&self, loss: Loss) -> Vec<Vector3<f64>> {
        self.residuals.iter().map(|r| r.map(|r| loss.curvature(r))).collect()
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
        let mut sums = [[0.0; MAX_UNKNOWNS]; MAX_UNKNOWNS];
        let mut scores = [0.0; MAX_UNKNOWNS];
        for k in range {
            let (weight, residual) = (weights[k], self.residuals[k]);
            for (i, first) in self.columns.iter().enumerate() {
                let weighted = first[k].component_mul(&weight);
                scores[i] += weighted.dot(&residual);
                for (j, second) in self.columns.iter().enumerate().take(i + 1) {
                    sums[i][j] += weighted.dot(&second[k]);
                }
            }
        }
        let matrix = DMatrix::from_fn(count, count, |i, k| sums[i.max(k)][i.min(k)]);
        let gradient = DVector::from_fn(count, |k, _| scores[k]);
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
        let curvatures = self.curvatures(loss);
        let (curvature, _) = self.normal_equations(&curvatures);
        let blocks = observations.blocks(Blocks::MIN_WHOLE_RUNS);
        let ranges = observations.ranges(&blocks).into_iter();
        let parts: Vec<_> = ranges
            .map(|range| {
                let (curvature, _) = self.part(range.clone(), &curvatures);
                (curvature, self.part(range, &weights).1)
            })
            .collect();
        let rms = self.rms(unknowns);
        let variance = match weighting {
            Weighting::Noise(_) => 1.0,
            Weighting::Distance { .. } => rms * rms,
        };
        Estimate {
            parameters: point.parameters,
            sensor: point.sensor,
            unknowns: unknowns.clone(),
            covariance: jackknife(&curvature, &parts),
            covariance_of_noise: inverse(&matrix) * variance,
            blocks,
            filled_blocks: parts.len(),
            cost: self.cost(loss),
            whitened_rms: rms,
            iterations,
        }
    }
}
