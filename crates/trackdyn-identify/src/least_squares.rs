//! Least squares: the most likely parameters under a noise model, with robust loss.

mod covariance;
mod identifiability;

pub use covariance::Interval;
pub use identifiability::{doubts, lacks, lacks_nuisance, nuisance_doubts};

use crate::error::Error;
use crate::observations::Observations;
use crate::parameters::{COUNT, Free, Parameters};
use crate::sensor::{Nuisance, Report, Sensor, report};
use crate::weighting::{Weighting, Whitener};
use nalgebra::{DMatrix, DVector, Vector3};
use rayon::prelude::*;
use std::ops::Range;
use trackdyn_recording::Blocks;

/// Residuals beyond this many standard deviations count linearly (Huber): 95 % efficient on normal
/// noise.
const HUBER: f64 = 1.345;

const MAX_ITERATIONS: usize = 100;

/// Change of every unknown, m, 1, s or rad, below which the iteration has settled.
const SETTLED: f64 = 1e-8;

/// What is fitted: kinematic parameters, and properties of the pose sensor beside them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unknowns {
    /// Which kinematic parameters.
    pub free: Free,
    /// Which properties of the sensor; [`Nuisance::LeverArm`] cannot be among them.
    pub nuisances: Vec<Nuisance>,
}

impl From<Free> for Unknowns {
    /// Kinematic parameters alone.
    fn from(free: Free) -> Self {
        Self { free, nuisances: Vec::new() }
    }
}

impl Unknowns {
    /// How many there are.
    pub fn count(&self) -> usize {
        self.free.count() + self.nuisances.len()
    }
}

/// Fitted parameters.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// The parameters; those that are not free keep their start.
    pub parameters: Parameters,
    /// Clock and mount of the sensor: what is not fitted is the clock offset of the observations, and no
    /// yaw.
    pub sensor: Sensor,
    /// What was fitted.
    pub unknowns: Unknowns,
    /// Covariance of the unknowns, kinematic parameters first, from the scatter between blocks: it holds
    /// where the noise model is wrong.
    pub covariance: DMatrix<f64>,
    /// Covariance of the unknowns if the noise model is right; by the cost (17), which has no noise, that of
    /// independent residuals as large as they are.
    pub covariance_of_noise: DMatrix<f64>,
    /// The blocks behind `covariance`.
    pub blocks: Blocks,
    /// How many of them have segments.
    pub filled_blocks: usize,
    /// Sum of the loss over all residuals: m² by the cost (17), 1 by the noise.
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

/// Where the iteration stands.
#[derive(Clone, Copy)]
struct Point {
    parameters: Parameters,
    sensor: Sensor,
}

impl Point {
    fn stepped(mut self, unknowns: &Unknowns, step: &DVector<f64>) -> Self {
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
struct Linearisation {
    residuals: Vec<Vector3<f64>>,
    columns: Vec<Vec<Vector3<f64>>>,
}

impl Linearisation {
    fn at(
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

/// Fits the unknowns by Levenberg and Marquardt's method with reweighting.
///
/// # Errors
/// Too few segments, no convergence, or a clock offset that leaves the margin for which there are readings.
pub fn least_squares(
    observations: &Observations,
    start: &Parameters,
    unknowns: &Unknowns,
    weighting: &Weighting,
    loss: Loss,
) -> Result<Estimate, Error> {
    let count = unknowns.count();
    if observations.len() < 4 * count {
        let found = observations.len();
        return Err(Error::TooFewSegments { found, needed: 4 * count, parameters: count });
    }
    let whitener = Whitener::new(weighting, observations);
    let linearise = |at: &Point| Linearisation::at(at, unknowns, observations, &whitener);

    let tau = observations.tau();
    let mut point = Point { parameters: *start, sensor: Sensor { tau, yaw: 0.0 } };
    let mut here = linearise(&point);
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
        let trial = point.stepped(unknowns, &step);
        size = step.amax();
        let [x_left, x_right, ..] = trial.parameters.0;
        let sensible = x_right > x_left;
        let next = linearise(&trial);
        let next_cost = next.cost(loss);
        let (moved, margin) = (trial.sensor.tau - tau, observations.tau_margin());
        if sensible && moved.abs() > margin && next_cost < cost {
            let edge = tau + margin.copysign(moved);
            return Err(Error::ClockLeaves { tau: edge, start: tau, margin });
        }
        if sensible && next_cost <= cost * (1.0 + 1e-14) {
            (point, here, cost) = (trial, next, next_cost);
            damping = (damping * 0.1).max(1e-12);
        } else if size >= SETTLED {
            damping = (damping * 10.0).max(1e-9);
            continue;
        }
        if size < SETTLED {
            return Ok(here.estimate(&point, unknowns, observations, weighting, loss, iteration));
        }
    }
    Err(Error::NotConverged { iterations: MAX_ITERATIONS, step: size })
}

/// The estimate that parameters from elsewhere are, with their covariance.
pub fn estimate_at(
    observations: &Observations,
    parameters: &Parameters,
    free: Free,
    weighting: &Weighting,
    loss: Loss,
) -> Estimate {
    let (unknowns, whitener) = (Unknowns::from(free), Whitener::new(weighting, observations));
    let sensor = Sensor { tau: observations.tau(), yaw: 0.0 };
    let point = Point { parameters: *parameters, sensor };
    let here = Linearisation::at(&point, &unknowns, observations, &whitener);
    here.estimate(&point, &unknowns, observations, weighting, loss, 0)
}

impl Linearisation {
    fn estimate(
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
            covariance: covariance::jackknife(&matrix, &parts),
            covariance_of_noise: identifiability::inverse(&matrix) * variance,
            blocks,
            filled_blocks: parts.len(),
            cost: self.cost(loss),
            whitened_rms: (squares / degrees).sqrt(),
            iterations,
        }
    }
}

impl Estimate {
    /// The 95 % interval of a free parameter; none of one that is fixed.
    pub fn interval(&self, parameter: usize) -> Option<Interval> {
        let is_free = parameter < self.unknowns.free.count();
        is_free.then(|| self.interval_of(parameter, self.parameters.0[parameter]))
    }

    /// The 95 % interval of a property of the sensor; none of one that is not fitted.
    pub fn nuisance(&self, nuisance: Nuisance) -> Option<Interval> {
        let place = self.unknowns.nuisances.iter().position(|fitted| *fitted == nuisance)?;
        let index = self.unknowns.free.count() + place;
        Some(self.interval_of(index, self.sensor.value(nuisance)))
    }

    /// The 95 % interval of x_r − x_l, m.
    pub fn gap(&self) -> Interval {
        let [x_left, x_right, ..] = self.parameters.0;
        self.interval_along(x_right - x_left, &[-1.0, 1.0])
    }

    /// The 95 % interval of χ, eq. (12), for a gauge, m.
    pub fn steering_efficiency(&self, gauge: f64) -> Interval {
        let [x_left, x_right, ..] = self.parameters.0;
        let gap = x_right - x_left;
        // ∂(L/D)/∂D = −L/D²
        let slope = gauge / (gap * gap);
        self.interval_along(gauge / gap, &[slope, -slope])
    }

    /// The 95 % interval of e, eq. (13).
    pub fn eccentricity(&self) -> Interval {
        let [x_left, x_right, ..] = self.parameters.0;
        let square = (x_right - x_left) * (x_right - x_left);
        // ∂e/∂x_l = 2 x_r/D²,  ∂e/∂x_r = −2 x_l/D²
        let gradient = [2.0 * x_right / square, -2.0 * x_left / square];
        self.interval_along(self.parameters.kinematics().icrs.eccentricity(), &gradient)
    }

    /// The interval of an unknown.
    fn interval_of(&self, index: usize, value: f64) -> Interval {
        let gradient: Vec<f64> = (0..=index).map(|k| if k == index { 1.0 } else { 0.0 }).collect();
        self.interval_along(value, &gradient)
    }

    /// The interval of a function of the unknowns with this gradient, whose last zeros may be left out.
    ///
    /// Its width is the larger of two: that of the noise model, which is right where the model is, and
    /// that of the scatter between blocks, which holds where it is not but is itself uncertain where
    /// few manoeuvres carry the information.
    fn interval_along(&self, value: f64, gradient: &[f64]) -> Interval {
        let gradient = DVector::from_column_slice(gradient);
        let variance = |of: &DMatrix<f64>| {
            let (rows, _) = gradient.shape();
            (gradient.transpose() * of.view((0, 0), (rows, rows)) * &gradient)[0].max(0.0)
        };
        let larger = variance(&self.covariance).max(variance(&self.covariance_of_noise));
        Interval::new(value, larger.sqrt(), self.filled_blocks, self.unknowns.count())
    }

    /// Standard deviations of all parameters; 0 where fixed.
    pub fn deviations(&self) -> [f64; COUNT] {
        std::array::from_fn(|k| self.interval(k).map_or(0.0, |interval| interval.deviation))
    }
}
