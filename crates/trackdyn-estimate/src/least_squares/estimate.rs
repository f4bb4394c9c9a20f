//! What a fit says: values, intervals, and what they are worth.

use super::Unknowns;
use super::covariance::{larger_deviation, with_deviations};
use crate::parameters::{COUNT, Parameters};
use crate::sensor::{Nuisance, Sensor};
use crate::{Blocks, Interval};
use nalgebra::{DMatrix, DVector};

/// Fitted parameters.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// The parameters; those that are not free keep their start.
    pub parameters: Parameters,
    /// Clock and mount of the sensor. Where they are not fitted, they are the clock offset of the
    /// observations and a yaw of 0.
    pub sensor: Sensor,
    /// What was fitted.
    pub unknowns: Unknowns,
    /// Covariance of the unknowns, kinematic parameters first, from the scatter between blocks: it
    /// holds where the noise model is wrong.
    pub covariance: DMatrix<f64>,
    /// Covariance of the unknowns if the noise model is right; by the cost (17), which has no
    /// noise, that of independent residuals as large as they are.
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

impl Estimate {
    /// The estimate, widened by a relative error of this standard deviation that all yaw of the
    /// recording shares. Neither noise nor scatter shows such an error.
    ///
    /// A yaw that is 1 + δ times as large has ICRs at x_l/(1 + δ), x_r/(1 + δ) and y/(1 + δ):
    /// ∂θ/∂δ = −θ
    #[must_use]
    pub fn with_yaw_scale(mut self, deviation: f64) -> Self {
        let icrs = DVector::from_fn(self.unknowns.count(), |k, _| {
            if k < 3 { deviation * self.parameters.0[k] } else { 0.0 }
        });
        let shared = &icrs * icrs.transpose();
        self.covariance += &shared;
        self.covariance_of_noise += shared;
        self
    }

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

    /// The interval of a function of the unknowns with this gradient, whose last zeros may be left
    /// out.
    ///
    /// Its width is the larger of two. The width by the noise model is right where that model is.
    /// The width by the scatter between blocks needs no noise model, but it is uncertain where few
    /// manoeuvres carry the information.
    fn interval_along(&self, value: f64, gradient: &[f64]) -> Interval {
        let gradient = DVector::from_column_slice(gradient);
        let variance = |of: &DMatrix<f64>| {
            let (rows, _) = gradient.shape();
            (gradient.transpose() * of.view((0, 0), (rows, rows)) * &gradient)[0]
        };
        let variances = [&self.covariance, &self.covariance_of_noise].map(variance);
        Interval::new(value, larger_deviation(variances), self.filled_blocks, self.unknowns.count())
    }

    /// The covariance of the free kinematic parameters, with the standard deviations of their
    /// intervals.
    pub fn covariance_of_parameters(&self) -> Vec<Vec<f64>> {
        let free = self.unknowns.free.count();
        with_deviations(&self.covariance, &self.deviations()[..free])
    }

    /// Standard deviations of all parameters; 0 where fixed.
    pub fn deviations(&self) -> [f64; COUNT] {
        std::array::from_fn(|k| self.interval(k).map_or(0.0, |interval| interval.deviation))
    }
}
