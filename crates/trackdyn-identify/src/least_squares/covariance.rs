//! Uncertainty from the scatter between blocks of consecutive segments.

use crate::observations::Observations;
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, StudentsT};
use std::ops::Range;

/// Fewer blocks than this make a poor variance: long runs are cut.
const FEWEST: usize = 24;

/// Parts of a recording that are taken as independent: runs, or pieces of runs where there are few.
#[derive(Clone, Debug, PartialEq)]
pub struct Blocks {
    ranges: Vec<Range<usize>>,
    /// Whether runs had to be cut.
    pub cut: bool,
}

impl Blocks {
    /// The blocks of these observations.
    pub fn of(observations: &Observations) -> Self {
        let segments = observations.segments();
        let mut runs: Vec<Range<usize>> = Vec::new();
        for index in 0..segments.len() {
            match runs.last_mut() {
                Some(last) if segments[last.start].run == segments[index].run => {
                    last.end = index + 1;
                }
                _ => runs.push(index..index + 1),
            }
        }
        if runs.len() >= FEWEST {
            return Self { ranges: runs, cut: false };
        }
        let length = (segments.len() / (2 * FEWEST)).max(1);
        let ranges = runs
            .into_iter()
            .flat_map(|run| {
                let pieces = (run.len() / length).max(1);
                (0..pieces).map(move |k| {
                    let at = |k: usize| run.start + k * run.len() / pieces;
                    at(k)..at(k + 1)
                })
            })
            .collect();
        Self { ranges, cut: true }
    }

    /// Number of blocks.
    pub fn count(&self) -> usize {
        self.ranges.len()
    }

    /// What each block gives.
    pub fn map<T>(&self, of: impl Fn(Range<usize>) -> T) -> Vec<T> {
        self.ranges.iter().cloned().map(of).collect()
    }
}

/// Covariance of an estimate by leaving out each block: (B − 1)/B Σ δᵦ δᵦᵀ, with the change
/// δᵦ = (H − Hᵦ)⁻¹ gᵦ of one Newton step without block b, whose share of the normal equations H is Hᵦ
/// and whose score is gᵦ.
///
/// With a robust loss H is the curvature: the second derivative of the loss, and not the weight that
/// stands in for it in the iteration.
///
/// # Sources
/// M-estimates: Huber, Ronchetti, Robust Statistics, 2nd ed. 2009, chapter 7. The block jackknife: Bell, McCaffrey, Survey Methodology 28(2), 2002 (CR3). Unlike the plain sandwich
/// it does not shrink where single blocks steer the estimate, as manoeuvres do.
pub fn jackknife(curvature: &DMatrix<f64>, parts: &[(DMatrix<f64>, DVector<f64>)]) -> DMatrix<f64> {
    let count = curvature.nrows();
    let scatter = parts.iter().fold(DMatrix::zeros(count, count), |sum, (part, score)| {
        let change = super::identifiability::inverse(&(curvature - part)) * score;
        sum + &change * change.transpose()
    });
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 blocks")]
    let blocks = parts.len() as f64;
    scatter * ((blocks - 1.0) / blocks)
}

/// A number with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The estimate.
    pub value: f64,
    /// Its standard deviation.
    pub deviation: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// Student's interval with as many degrees of freedom as blocks exceed parameters.
    pub(super) fn new(value: f64, deviation: f64, blocks: &Blocks, parameters: usize) -> Self {
        Self::of_groups(value, deviation, blocks.count(), parameters)
    }

    /// The same for this many groups.
    pub(crate) fn of_groups(value: f64, deviation: f64, groups: usize, parameters: usize) -> Self {
        #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 groups")]
        let freedom = groups.saturating_sub(parameters).max(1) as f64;
        let quantile =
            StudentsT::new(0.0, 1.0, freedom).map_or(1.96, |student| student.inverse_cdf(0.975));
        let half = quantile * deviation;
        Self { value, deviation, low: value - half, high: value + half }
    }
}
