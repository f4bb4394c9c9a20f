//! Least squares: the most likely parameters under a noise model, with robust loss.

pub(crate) mod covariance;
mod estimate;
mod identifiability;
mod linearisation;

pub use crate::gauss_newton::Loss;
pub use estimate::Estimate;
pub(crate) use identifiability::too_wide;
pub use identifiability::{doubts, lacks, lacks_nuisance, nuisance_doubts};

use crate::error::Error;
use crate::gauss_newton::{Minimum, Problem, Region, Settings, Status, minimise};
use crate::observations::Observations;
use crate::parameters::{Free, Parameters};
use crate::prediction::Lanes;
use crate::sensor::{Nuisance, Sensor};
use crate::weighting::{Weighting, Whitener};
use linearisation::{Linearisation, Point};
use nalgebra::{DMatrix, DVector, Vector3};

/// Change of an unknown in m, 1, s or rad: the iteration has settled below `settled_below`, and
/// Newton's step is used below `newton_below`, where the loss is nearly a parabola.
const SETTINGS: Settings =
    Settings { max_iterations: 100, settled_below: 1e-8, newton_below: 1e-4 };

/// Largest last step, in standard errors of what is known best, with which an iteration that did
/// not settle still counts as settled: beside outliers, steps may stay small for ever.
const MAX_OPEN_STEP: f64 = 0.01;

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

/// Fits the unknowns by Levenberg and Marquardt's method with reweighting.
///
/// # Errors
/// Too few segments, no convergence, or a clock offset that leaves the margin for which there are
/// readings.
pub fn least_squares(
    observations: &Observations,
    start: &Parameters,
    unknowns: &Unknowns,
    weighting: &Weighting,
    loss: Loss,
) -> Result<Estimate, Error> {
    let count = unknowns.count();
    if observations.len() < 4 * count {
        return Err(Error::too_few(observations.len(), observations.mean_duration(), count));
    }
    let whitener = Whitener::new(weighting, observations);
    let lanes = Lanes::new(observations);
    let tau = observations.tau();
    let problem = Motions { observations, unknowns, lanes, whitener, loss };
    let start = problem.at(Point { parameters: *start, sensor: Sensor { tau, yaw: 0.0 } });
    let Minimum { point: (point, here), status, iterations, last_change } =
        minimise(&problem, start, &SETTINGS);
    let estimate = || here.estimate(&point, unknowns, observations, weighting, loss, iterations);
    match status {
        Status::Settled => Ok(estimate()),
        Status::Unobserved => {
            let margin = observations.tau_margin();
            let edge = tau + margin.copysign(point.sensor.tau - tau);
            Err(Error::ClockLeaves { tau: edge, start: tau, margin })
        }
        Status::NotSettled => {
            let estimate = estimate();
            let intervals = (0..Parameters::NAMES.len()).filter_map(|k| estimate.interval(k));
            let least = intervals.map(|of| of.deviation).fold(f64::INFINITY, f64::min);
            let is_open = last_change > MAX_OPEN_STEP * least || !least.is_finite();
            let open = Error::NotConverged { iterations, step: last_change };
            if is_open { Err(open) } else { Ok(estimate) }
        }
    }
}

/// Motions of segments, whose residuals the unknowns make small.
struct Motions<'a> {
    observations: &'a Observations,
    unknowns: &'a Unknowns,
    lanes: Lanes<'a>,
    whitener: Whitener,
    loss: Loss,
}

impl Motions<'_> {
    fn at(&self, point: Point) -> (Point, Linearisation) {
        let here = Linearisation::at(&point, self.unknowns, &self.lanes, &self.whitener);
        (point, here)
    }
}

impl Problem for Motions<'_> {
    type Point = (Point, Linearisation);

    fn cost(&self, (_, here): &Self::Point) -> f64 {
        here.cost(self.loss)
    }

    fn normal_equations(&self, (_, here): &Self::Point) -> (DMatrix<f64>, DVector<f64>) {
        here.normal_equations(&here.weights(self.loss))
    }

    fn curvature(&self, (_, here): &Self::Point) -> DMatrix<f64> {
        here.normal_equations(&here.curvatures(self.loss)).0
    }

    fn stepped(&self, (point, _): &Self::Point, step: &mut DVector<f64>) -> Self::Point {
        self.at(point.stepped(self.unknowns, step))
    }

    /// The left ICR stays left of the right one, and the readings end a margin away from the clock
    /// offset of the segments.
    fn region(&self, (point, _): &Self::Point) -> Region {
        let [x_left, x_right, ..] = point.parameters.0;
        let moved = point.sensor.tau - self.observations.tau();
        let is_ordered = x_right > x_left;
        if !is_ordered {
            Region::Impossible
        } else if moved.abs() > self.observations.tau_margin() {
            Region::Unobserved
        } else {
            Region::Inside
        }
    }
}

/// Residuals of an estimate, observed minus reported, forward (m), left (m), yaw (rad), and the
/// derivatives of what is reported by each unknown.
pub fn residuals(
    observations: &Observations,
    estimate: &Estimate,
) -> (Vec<Vector3<f64>>, Vec<Vec<Vector3<f64>>>) {
    let alike = Whitener::new(&Weighting::Distance { lever: 1.0 }, observations);
    at_estimate(observations, estimate, &alike).into_parts()
}

/// Root mean square of the residuals of an estimate, whitened by a noise that need not be the one
/// by which it was fitted.
pub fn whitened_rms(observations: &Observations, estimate: &Estimate, by: &Weighting) -> f64 {
    at_estimate(observations, estimate, &Whitener::new(by, observations)).rms(&estimate.unknowns)
}

fn at_estimate(
    observations: &Observations,
    estimate: &Estimate,
    whitener: &Whitener,
) -> Linearisation {
    let point = Point { parameters: estimate.parameters, sensor: estimate.sensor };
    Linearisation::at(&point, &estimate.unknowns, &Lanes::new(observations), whitener)
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
