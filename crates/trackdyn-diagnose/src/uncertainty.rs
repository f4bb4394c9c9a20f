//! Intervals of fitted parameters.

use crate::fit::Fit;
use crate::hypothesis::Unknown;
use crate::normal::Normal;
use crate::search::{Found, Search};
use nalgebra::DVector;
use trackdyn_core::real;
use trackdyn_identify::least_squares::Interval as Student;

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
    /// Half of its 95 % interval.
    pub half: f64,
}

impl Level {
    /// Whether it surely differs from that of the vehicle file: by some three standard deviations.
    pub fn is_sure(&self) -> bool {
        self.value.abs() > 1.5 * self.half
    }
}

/// Half the 95 % intervals of what is free in a hypothesis.
///
/// The variance is the larger one of two: by the noise, and by how much the estimate changes where a block is left out,
/// (B − 1)/B Σ (θ₋ᵦ − θ)², which no noise model enters.
///
/// # Sources
/// The block jackknife: Bell, McCaffrey, Survey Methodology 28(2), 2002 (CR3).
pub struct Uncertainty {
    halves: Vec<f64>,
}

impl Uncertainty {
    /// Those of the best hypothesis.
    pub fn of(search: &Search, best: &Found) -> Self {
        let fit = &best.fit;
        let (normal, priors, _) = search.normal(fit, &[]);
        let estimate = |normal: &Normal| normal.fit(&fit.free, &priors).estimate;
        let whole = estimate(&normal);
        let last = normal.columns();
        let counts = |block: &usize| normal.block(*block)[(last, last)] != 0.0;
        let blocks: Vec<usize> = (0..normal.blocks()).filter(counts).collect();
        let mut squares = DVector::zeros(whole.len());
        for &block in &blocks {
            let change = estimate(&normal.without(&(block..block + 1))) - &whole;
            squares += change.component_mul(&change);
        }
        let count = real(blocks.len().max(2));
        let mut variances = fit.solution.covariance.diagonal();
        for (&k, squares) in fit.free.iter().zip(squares.iter()) {
            variances[k] = variances[k].max(squares * (count - 1.0) / count);
        }
        let halves = variances.iter().map(|variance| {
            let deviation = variance.max(0.0).sqrt();
            Student::new(0.0, deviation, blocks.len(), 1).high
        });
        Self { halves: halves.collect() }
    }

    /// The parameters of the added effects and instruments with their 95 % intervals. No time is known better than to a
    /// millisecond.
    pub fn intervals(&self, fit: &Fit) -> Vec<Interval> {
        let unknowns = fit.unknowns.iter().zip(&self.halves);
        unknowns
            .filter_map(|(&unknown, half)| {
                let parameter = unknown.parameter()?;
                let model = if parameter.unit == "s" { CLOCK } else { 0.0 };
                let half = half.hypot(model);
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
        Some(Level { value: fit.hypothesis.friction_level, half: self.halves[place] })
    }
}
