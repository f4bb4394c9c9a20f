//! Least squares: the most likely parameters under a noise model, with robust loss.

mod covariance;
mod identifiability;

pub use covariance::Interval;
pub use identifiability::{doubts, lacks};

use crate::error::Error;
use crate::observations::Observations;
use crate::parameters::{COUNT, Free, Parameters};
use crate::prediction::predict;
use crate::weighting::{Weighting, Whitener};
use nalgebra::{DMatrix, DVector, Vector3};
use rayon::prelude::*;
use std::ops::Range;
use trackdyn_recording::Blocks;

/// Residuals beyond this many standard deviations count linearly (Huber): 95 % efficient on normal
/// noise.
const HUBER: f64 = 1.345;

const MAX_ITERATIONS: usize = 100;

/// Change of every parameter, m or 1, below which the iteration has settled.
const SETTLED: f64 = 1e-8;

/// Fitted parameters.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// The parameters; those that are not free keep their start.
    pub parameters: Parameters,
    /// Which were free.
    pub free: Free,
    /// Covariance of the free parameters, from the scatter between blocks: it holds where the noise
    /// model is wrong.
    pub covariance: DMatrix<f64>,
    /// Covariance of the free parameters if the noise model is right.
    pub covariance_of_noise: DMatrix<f64>,
    /// The blocks behind `covariance`.
    pub blocks: Blocks,
    /// How many of them have segments.
    pub filled_blocks: usize,
    /// Sum of the loss over all residuals, in the units of the weighting.
    pub cost: f64,
    /// Root mean square of the whitened residuals: 1 where model and noise explain the recording.
    pub whitened_rms: f64,
    /// Iterations.
    pub iterations: usize,
}

/// How residuals are summed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loss {
    /// Their squares: the cost (17).
    Squares,
    /// Huber's loss: outliers count linearly.
    Huber,
}

impl Loss {
    /// Weight of a whitened residual in iteratively reweighted least squares.
    fn weight(self, residual: f64) -> f64 {
        match self {
            Self::Squares => 1.0,
            Self::Huber => (HUBER / residual.abs()).min(1.0),
        }
    }

    fn value(self, residual: f64) -> f64 {
        let size = residual.abs();
        match self {
            Self::Huber if size > HUBER => HUBER * (2.0 * size - HUBER),
            _ => size * size,
        }
    }
}

/// Whitened residuals and derivatives at a point.
struct Linearisation {
    residuals: Vec<Vector3<f64>>,
    columns: Vec<Vec<Vector3<f64>>>,
}

impl Linearisation {
    fn at(
        parameters: &Parameters,
        free: Free,
        observations: &Observations,
        whitener: &Whitener,
    ) -> Self {
        let predictions: Vec<_> = observations
            .segments()
            .par_iter()
            .with_min_len(128)
            .map(|segment| (segment, predict(parameters, observations.pieces(segment))))
            .collect();
        let mut residuals: Vec<Vector3<f64>> = predictions
            .iter()
            .map(|(segment, prediction)| {
                Vector3::from(segment.motion) - Vector3::from(prediction.motion)
            })
            .collect();
        let mut columns: Vec<Vec<Vector3<f64>>> = (0..free.count())
            .map(|k| {
                let column = predictions.iter();
                column.map(|(_, prediction)| Vector3::from(prediction.sensitivity[k])).collect()
            })
            .collect();
        whitener.whiten(&mut residuals);
        for column in &mut columns {
            whitener.whiten(column);
        }
        Self { residuals, columns }
    }

    fn cost(&self, loss: Loss) -> f64 {
        self.residuals.iter().flat_map(Vector3::iter).map(|r| loss.value(*r)).sum()
    }

    fn weights(&self, loss: Loss) -> Vec<Vector3<f64>> {
        self.residuals.iter().map(|r| r.map(|r| loss.weight(r))).collect()
    }

    /// Jᵀ W J and Jᵀ W r.
    fn normal_equations(&self, weights: &[Vector3<f64>]) -> (DMatrix<f64>, DVector<f64>) {
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

/// Fits the parameters by Levenberg and Marquardt's method with reweighting.
///
/// # Errors
/// Too few segments, or no convergence.
pub fn least_squares(
    observations: &Observations,
    start: &Parameters,
    free: Free,
    weighting: &Weighting,
    loss: Loss,
) -> Result<Estimate, Error> {
    let count = free.count();
    if observations.len() < 4 * count {
        let found = observations.len();
        return Err(Error::TooFewSegments { found, needed: 4 * count, parameters: count });
    }
    let whitener = Whitener::new(weighting, observations);
    let linearise = |at: &Parameters| Linearisation::at(at, free, observations, &whitener);

    let mut parameters = *start;
    let mut here = linearise(&parameters);
    let mut cost = here.cost(loss);
    let mut damping = 1e-9;
    let mut size = f64::INFINITY;
    for iteration in 1..=MAX_ITERATIONS {
        let (matrix, gradient) = here.normal_equations(&here.weights(loss));
        let mut damped = matrix.clone();
        for k in 0..count {
            // A direction that the recording does not show must not send the others astray.
            damped[(k, k)] = matrix[(k, k)] * (1.0 + damping) + f64::MIN_POSITIVE;
        }
        let Some(step) = damped.cholesky().map(|cholesky| cholesky.solve(&gradient)) else {
            damping = (damping * 10.0).max(1e-9);
            continue;
        };
        let mut trial = parameters;
        for k in 0..count {
            trial.0[k] += step[k];
        }
        size = step.amax();
        let sensible = trial.0[1] > trial.0[0];
        let next = linearise(&trial);
        let next_cost = next.cost(loss);
        if sensible && next_cost <= cost * (1.0 + 1e-14) {
            (parameters, here, cost) = (trial, next, next_cost);
            damping = (damping * 0.1).max(1e-12);
        } else if size >= SETTLED {
            damping = (damping * 10.0).max(1e-9);
            continue;
        }
        if size < SETTLED {
            return Ok(here.estimate(parameters, free, observations, loss, cost, iteration));
        }
    }
    Err(Error::NotConverged { iterations: MAX_ITERATIONS, step: size })
}

impl Linearisation {
    fn estimate(
        &self,
        parameters: Parameters,
        free: Free,
        observations: &Observations,
        loss: Loss,
        cost: f64,
        iterations: usize,
    ) -> Estimate {
        let weights = self.weights(loss);
        let (matrix, _) = self.normal_equations(&weights);
        let blocks = observations.blocks();
        let ranges = observations.ranges(&blocks);
        let parts: Vec<_> = ranges.into_iter().map(|range| self.part(range, &weights)).collect();
        let squares: f64 = self.residuals.iter().map(Vector3::norm_squared).sum();
        #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 residuals")]
        let degrees = (3 * self.residuals.len() - free.count()) as f64;
        Estimate {
            parameters,
            free,
            covariance: covariance::jackknife(&matrix, &parts),
            covariance_of_noise: identifiability::inverse(&matrix),
            blocks,
            filled_blocks: parts.len(),
            cost,
            whitened_rms: (squares / degrees).sqrt(),
            iterations,
        }
    }
}

impl Estimate {
    /// The 95 % interval of a free parameter; none of one that is fixed.
    ///
    /// Its width is the larger of two: that of the noise model, which is right where the model is, and
    /// that of the scatter between blocks, which holds where it is not but is itself uncertain where
    /// few manoeuvres carry the information.
    pub fn interval(&self, parameter: usize) -> Option<Interval> {
        (parameter < self.free.count()).then(|| {
            let variance = |of: &DMatrix<f64>| of[(parameter, parameter)].max(0.0);
            let larger = variance(&self.covariance).max(variance(&self.covariance_of_noise));
            let deviation = larger.sqrt();
            Interval::new(
                self.parameters.0[parameter],
                deviation,
                self.filled_blocks,
                self.free.count(),
            )
        })
    }

    /// Standard deviations of all parameters; 0 where fixed.
    pub fn deviations(&self) -> [f64; COUNT] {
        std::array::from_fn(|k| self.interval(k).map_or(0.0, |interval| interval.deviation))
    }
}
