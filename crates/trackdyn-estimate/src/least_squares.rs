//! Least squares: the most likely parameters under a noise model, with robust loss.

pub(crate) mod covariance;
mod estimate;
mod identifiability;
mod linearisation;

pub use estimate::Estimate;
pub use identifiability::{doubts, lacks, lacks_nuisance, nuisance_doubts};
pub(crate) use identifiability::{inverse, too_wide};

use crate::error::Error;
use crate::observations::Observations;
use crate::parameters::{Free, Parameters};
use crate::prediction::Lanes;
use crate::sensor::{Nuisance, Sensor};
use crate::weighting::{Weighting, Whitener};
use linearisation::{Linearisation, Point};

/// Residuals beyond this many standard deviations count linearly (Huber): 95 % efficient on normal
/// noise.
const HUBER: f64 = 1.345;

const MAX_ITERATIONS: usize = 100;

/// Change of every unknown, m, 1, s or rad, below which the iteration has settled.
const SETTLED: f64 = 1e-8;

/// Change of every unknown below which the loss is nearly a parabola.
const NEAR: f64 = 1e-4;

/// What is fitted: kinematic parameters, and properties of the pose sensor beside them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unknowns {
    /// Which kinematic parameters.
    pub free: Free,
    /// Which properties of the sensor, each once; [`Nuisance::LeverArm`] cannot be among them.
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
    pub(crate) fn weight(self, residual: f64) -> f64 {
        match self {
            Self::Squares => 1.0,
            Self::Huber => (HUBER / residual.abs()).min(1.0),
        }
    }

    /// Half the second derivative of the loss: what an outlier does not add to the curvature, although it
    /// has a weight.
    pub(crate) fn curvature(self, residual: f64) -> f64 {
        match self {
            Self::Huber if residual.abs() > HUBER => 0.0,
            _ => 1.0,
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
    let lanes = Lanes::new(observations);
    let linearise = |at: &Point| Linearisation::at(at, unknowns, &lanes, &whitener);

    let tau = observations.tau();
    let mut point = Point { parameters: *start, sensor: Sensor { tau, yaw: 0.0 } };
    let mut here = linearise(&point);
    let mut cost = here.cost(loss);
    let mut damping = 1e-9;
    let mut size = f64::INFINITY;
    for iteration in 1..=MAX_ITERATIONS {
        let (matrix, gradient) = here.normal_equations(&here.weights(loss));
        // Reweighting comes near from anywhere, but slowly in the end; Newton's step, to whose matrix
        // outliers add nothing, is quick once it is near.
        let mut damped = if size < NEAR {
            here.normal_equations(&here.curvatures(loss)).0
        } else {
            matrix.clone()
        };
        for k in 0..count {
            // A direction that the recording does not show must not send the others astray.
            damped[(k, k)] += matrix[(k, k)] * damping + f64::MIN_POSITIVE;
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
    let here = Linearisation::at(&point, &unknowns, &Lanes::new(observations), &whitener);
    here.estimate(&point, &unknowns, observations, weighting, loss, 0)
}
