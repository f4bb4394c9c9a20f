//! Intervals of fitted parameters.

use crate::fit::Fit;
use crate::hypothesis::Unknown;
use crate::search::{Found, Search};
use nalgebra::{DMatrix, DVector};
use trackdyn_core::real;

/// A fitted parameter with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Which.
    pub unknown: Unknown,
    /// Estimate, in its unit.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// What no time is known better than, s: half the width of an interval. Friction that holds at once is a model; belts and
/// ground give way by some tenths of a millimetre before they slide, which takes that long at the slip of a slow turn.
const CLOCK: f64 = 1e-3;

/// A level of friction that was found: the logarithm of the factor of both coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Estimate.
    pub value: f64,
    /// Its standard deviation.
    pub deviation: f64,
}

impl Level {
    /// Whether it surely differs from that of the vehicle file: three standard deviations.
    pub fn is_sure(&self) -> bool {
        self.value.abs() > 3.0 * self.deviation
    }
}

/// Standard deviations of what is free in a hypothesis.
///
/// The variance is the larger one of two: by the noise, and by the scatter of the scores from block to block,
/// which no noise model enters.
pub struct Uncertainty {
    deviations: Vec<f64>,
    /// Student's t at 97.5 %.
    t: f64,
}

impl Uncertainty {
    /// Those of the best hypothesis.
    pub fn of(search: &Search, best: &Found) -> Self {
        let fit = &best.fit;
        let (normal, _, _) = search.normal(fit, &[]);
        let covariance = &fit.solution.covariance;
        let count = fit.unknowns.len();
        let step = &fit.solution.estimate;
        let mut scatter = DMatrix::zeros(count, count);
        let mut blocks = 0;
        for block in 0..normal.blocks() {
            let products = normal.block(block);
            if products[(count, count)] == 0.0 {
                continue;
            }
            blocks += 1;
            let information = products.view((0, 0), (count, count));
            let score = DVector::from_fn(count, |k, _| products[(k, count)]) - information * step;
            scatter += &score * score.transpose();
        }
        let blocks = real(blocks.max(2));
        let robust = covariance * scatter * covariance * (blocks / (blocks - 1.0));
        let deviation = |k| f64::max(covariance[(k, k)], robust[(k, k)]).max(0.0).sqrt();
        // by its expansion for many blocks
        let t = 1.959_964 + 2.372_3 / (blocks - 1.0);
        Self { deviations: (0..count).map(deviation).collect(), t }
    }

    /// The parameters of the added effects and instruments with their 95 % intervals. No time is known better than to a
    /// millisecond.
    pub fn intervals(&self, fit: &Fit) -> Vec<Interval> {
        let unknowns = fit.unknowns.iter().zip(&self.deviations);
        unknowns
            .filter_map(|(&unknown, deviation)| {
                let parameter = unknown.parameter()?;
                let model = if parameter.unit == "s" { CLOCK } else { 0.0 };
                let half = (self.t * deviation).hypot(model);
                let value = fit.hypothesis.get(unknown);
                let [low, high] = parameter.range;
                Some(Interval {
                    unknown,
                    value,
                    low: (value - half).max(low),
                    high: (value + half).min(high),
                })
            })
            .collect()
    }

    /// The level of friction; none where it is not free.
    pub fn friction_level(&self, fit: &Fit) -> Option<Level> {
        let place = fit.unknowns.iter().position(|one| *one == Unknown::FrictionLevel)?;
        Some(Level { value: fit.hypothesis.friction_level, deviation: self.deviations[place] })
    }
}
