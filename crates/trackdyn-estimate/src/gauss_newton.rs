//! Robust least squares by Gauss and Newton's method, with control of the step.
//!
//! # Law
//! A step δ solves (Jᵀ W J + λ diag(Jᵀ W J)) δ = Jᵀ W r. Here r is what the prediction leaves of
//! the observations, J holds the derivatives of the prediction, W the weights of the [`Loss`], and
//! λ is the damping.
//!
//! Reweighting comes close from anywhere, but converges slowly in the end. Close to the minimum the
//! curvature of the loss replaces W on the left: that is Newton's step, to whose matrix outliers
//! add nothing.
//!
//! # Sources
//! Damping: Marquardt, Journal of the Society for Industrial and Applied Mathematics 11(2), 1963.
//! Reweighting: Huber, Ronchetti, Robust Statistics, 2nd ed. 2009, chapter 7.

use nalgebra::{DMatrix, DVector};
use trackdyn_core::robust::HUBER_THRESHOLD;

/// The loss of single residuals.
const HUBER: Huber = Huber { threshold: HUBER_THRESHOLD };

/// Relative increase of the cost that is rounding.
const COST_ROUNDING: f64 = 1e-14;

/// Damping of the first step, and the least one after a step that was refused.
const START_DAMPING: f64 = 1e-9;

/// Least damping after steps that were accepted.
const MIN_DAMPING: f64 = 1e-12;

/// Factor of the damping after a refused step.
const DAMPING_INCREASE: f64 = 10.0;

/// Factor of the damping after an accepted step.
const DAMPING_DECREASE: f64 = 0.1;

/// Huber's loss: sizes beyond a threshold count linearly.
///
/// # Law
/// ρ(z) = z² up to the threshold c, c (2 z − c) beyond it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Huber {
    /// c, in standard deviations of a whitened residual.
    pub threshold: f64,
}

impl Huber {
    /// Weight of a residual of this size in iteratively reweighted least squares.
    #[inline]
    pub fn weight(self, size: f64) -> f64 {
        if size > self.threshold { self.threshold / size } else { 1.0 }
    }

    /// Half the second derivative of the loss: an outlier adds nothing to the curvature, although
    /// it has a weight.
    #[inline]
    pub fn curvature(self, size: f64) -> f64 {
        if size > self.threshold { 0.0 } else { 1.0 }
    }

    /// What a residual of this size adds to the cost.
    #[inline]
    pub fn value(self, size: f64) -> f64 {
        if size > self.threshold {
            self.threshold * (2.0 * size - self.threshold)
        } else {
            size * size
        }
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
    pub fn weight(self, residual: f64) -> f64 {
        match self {
            Self::Squares => 1.0,
            Self::Huber => HUBER.weight(residual.abs()),
        }
    }

    /// Half the second derivative of the loss.
    pub fn curvature(self, residual: f64) -> f64 {
        match self {
            Self::Squares => 1.0,
            Self::Huber => HUBER.curvature(residual.abs()),
        }
    }

    /// What a whitened residual adds to the cost.
    pub fn value(self, residual: f64) -> f64 {
        match self {
            Self::Squares => residual * residual,
            Self::Huber => HUBER.value(residual.abs()),
        }
    }
}

/// Where a step leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Region {
    /// Where the unknowns may be.
    Inside,
    /// Where they cannot be: such a step is refused.
    Impossible,
    /// Where there are no observations: the search ends if the cost is lower there.
    Unobserved,
}

/// A problem of least squares.
pub trait Problem {
    /// Values of the unknowns with the residuals and the derivatives of the prediction there.
    type Point;

    /// The value of the loss.
    fn cost(&self, at: &Self::Point) -> f64;

    /// Jᵀ W J and Jᵀ W r with the weights of the loss.
    fn normal_equations(&self, at: &Self::Point) -> (DMatrix<f64>, DVector<f64>);

    /// Jᵀ C J with the curvature C of the loss.
    fn curvature(&self, at: &Self::Point) -> DMatrix<f64>;

    /// The point after a step; a problem may shorten the step that it is given.
    fn stepped(&self, at: &Self::Point, step: &mut DVector<f64>) -> Self::Point;

    /// Where a point lies.
    fn region(&self, _at: &Self::Point) -> Region {
        Region::Inside
    }
}

/// When the iteration ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Largest number of steps.
    pub max_iterations: usize,
    /// The iteration has settled when no unknown changes by more than this.
    pub settled_below: f64,
    /// Newton's step is used where no unknown changed by more than this in the last step.
    pub newton_below: f64,
}

/// How the iteration ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The last step was smaller than asked for.
    Settled,
    /// The cost falls towards where there are no observations.
    Unobserved,
    /// Still moving after the largest number of steps.
    NotSettled,
}

/// The end of an iteration.
#[derive(Clone, Debug)]
pub struct Minimum<P> {
    /// The last point that was accepted; with [`Status::Unobserved`], the one that was not.
    pub point: P,
    /// How the iteration ended.
    pub status: Status,
    /// Steps that were tried.
    pub iterations: usize,
    /// Largest change of an unknown in the last of them.
    pub last_change: f64,
}

/// Minimises the loss from a point on, by Levenberg and Marquardt: a step that raises the cost is
/// refused and damped more.
pub fn minimise<P: Problem>(
    problem: &P,
    start: P::Point,
    settings: &Settings,
) -> Minimum<P::Point> {
    let Settings { max_iterations, settled_below, newton_below } = *settings;
    let (mut point, mut damping) = (start, START_DAMPING);
    let mut cost = problem.cost(&point);
    let mut last_change = f64::INFINITY;
    for iterations in 1..=max_iterations {
        let (matrix, gradient) = problem.normal_equations(&point);
        let is_near = last_change < newton_below;
        let mut damped = if is_near { problem.curvature(&point) } else { matrix.clone() };
        for k in 0..damped.nrows() {
            // A direction that no residual shows must not send the others astray.
            damped[(k, k)] += matrix[(k, k)] * damping + f64::MIN_POSITIVE;
        }
        let Some(mut step) = damped.cholesky().map(|cholesky| cholesky.solve(&gradient)) else {
            damping = (damping * DAMPING_INCREASE).max(START_DAMPING);
            continue;
        };
        let next = problem.stepped(&point, &mut step);
        last_change = step.amax();
        let next_cost = problem.cost(&next);
        let region = problem.region(&next);
        if region == Region::Unobserved && next_cost < cost {
            return Minimum { point: next, status: Status::Unobserved, iterations, last_change };
        }
        let is_settled = last_change < settled_below;
        let is_lower = next_cost <= cost * (1.0 + COST_ROUNDING);
        if region != Region::Impossible && is_lower {
            (point, cost) = (next, next_cost);
            damping = (damping * DAMPING_DECREASE).max(MIN_DAMPING);
        } else if !is_settled {
            damping = (damping * DAMPING_INCREASE).max(START_DAMPING);
        }
        if is_settled {
            return Minimum { point, status: Status::Settled, iterations, last_change };
        }
    }
    let status = Status::NotSettled;
    Minimum { point, status, iterations: max_iterations, last_change }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_core::real;

    /// Observations of a exp(−b t) at even times; b below `observed_from` is unobserved.
    struct Decay {
        observed: Vec<f64>,
        observed_from: f64,
        loss: Loss,
    }

    struct At {
        unknowns: [f64; 2],
        residuals: Vec<f64>,
        rows: Vec<[f64; 2]>,
    }

    impl Decay {
        /// 40 observations of 2 exp(−0.7 t), of which some are of a curve that begins this much
        /// higher.
        fn new(outlier: f64, loss: Loss) -> Self {
            let value = |k: usize| {
                let off = if k % 10 == 3 { outlier } else { 0.0 };
                (2.0 + off) * (-0.07 * real(k)).exp()
            };
            Self { observed: (0..40).map(value).collect(), observed_from: 0.0, loss }
        }

        fn at(&self, unknowns: [f64; 2]) -> At {
            let [a, b] = unknowns;
            let times = (0..self.observed.len()).map(|k| 0.1 * real(k));
            let rows: Vec<[f64; 2]> = times
                .map(|t| {
                    let decayed = (-b * t).exp();
                    [decayed, -a * t * decayed]
                })
                .collect();
            let pairs = self.observed.iter().zip(&rows);
            let residuals = pairs.map(|(observed, row)| observed - a * row[0]).collect();
            At { unknowns, residuals, rows }
        }

        fn weighted(&self, at: &At, weight: fn(Loss, f64) -> f64) -> DMatrix<f64> {
            DMatrix::from_fn(2, 2, |i, j| {
                let pairs = at.rows.iter().zip(&at.residuals);
                pairs.map(|(row, r)| weight(self.loss, *r) * row[i] * row[j]).sum()
            })
        }
    }

    impl Problem for Decay {
        type Point = At;

        fn cost(&self, at: &At) -> f64 {
            at.residuals.iter().map(|r| self.loss.value(*r)).sum()
        }

        fn normal_equations(&self, at: &At) -> (DMatrix<f64>, DVector<f64>) {
            let score = DVector::from_fn(2, |i, _| {
                let pairs = at.rows.iter().zip(&at.residuals);
                pairs.map(|(row, r)| self.loss.weight(*r) * row[i] * r).sum()
            });
            (self.weighted(at, Loss::weight), score)
        }

        fn curvature(&self, at: &At) -> DMatrix<f64> {
            self.weighted(at, Loss::curvature)
        }

        fn stepped(&self, at: &At, step: &mut DVector<f64>) -> At {
            self.at([at.unknowns[0] + step[0], at.unknowns[1] + step[1]])
        }

        fn region(&self, at: &At) -> Region {
            let is_observed = at.unknowns[1] >= self.observed_from;
            if is_observed { Region::Inside } else { Region::Unobserved }
        }
    }

    const SETTINGS: Settings =
        Settings { max_iterations: 50, settled_below: 1e-8, newton_below: 1e-4 };

    fn found(problem: &Decay, settings: &Settings) -> ([f64; 2], Status) {
        let minimum = minimise(problem, problem.at([1.5, 1.0]), settings);
        (minimum.point.unknowns, minimum.status)
    }

    #[test]
    fn exact_observations_give_the_unknowns_back() {
        let ([a, b], status) = found(&Decay::new(0.0, Loss::Squares), &SETTINGS);
        assert_eq!(status, Status::Settled);
        assert!((a - 2.0).abs() < 1e-9 && (b - 0.7).abs() < 1e-9, "{a} {b}");
    }

    /// The score of the robust loss is zero at its minimum, and outliers move it by their weight,
    /// not by their size.
    #[test]
    fn outliers_count_linearly() {
        let off = |outlier, loss| {
            let problem = Decay::new(outlier, loss);
            let minimum = minimise(&problem, problem.at([1.5, 1.0]), &SETTINGS);
            assert_eq!(minimum.status, Status::Settled);
            let (_, score) = problem.normal_equations(&minimum.point);
            assert!(score.amax() < 1e-6, "{score}");
            (minimum.point.unknowns[0] - 2.0).abs()
        };
        let (far, farther) = (off(20.0, Loss::Huber), off(40.0, Loss::Huber));
        assert!((far - farther).abs() < 1e-6 && far < 0.5, "{far} {farther}");
        assert!(off(40.0, Loss::Squares) > 1.5 * off(20.0, Loss::Squares));
    }

    #[test]
    fn weight_and_curvature_are_those_of_the_loss() {
        const STEP: f64 = 1e-4;
        for size in [0.3, 1.3, 1.4, 5.0] {
            let [before, here, after] = [-STEP, 0.0, STEP].map(|step| HUBER.value(size + step));
            let slope = (after - before) / (2.0 * STEP);
            assert!((slope - 2.0 * size * HUBER.weight(size)).abs() < 1e-9, "{size}");
            let curvature = (after - 2.0 * here + before) / (STEP * STEP);
            assert!((curvature - 2.0 * HUBER.curvature(size)).abs() < 1e-6, "{size}");
        }
    }

    #[test]
    fn an_iteration_says_why_it_ended() {
        let exact = Decay::new(0.0, Loss::Squares);
        let short = Settings { max_iterations: 2, ..SETTINGS };
        assert_eq!(found(&exact, &short).1, Status::NotSettled);
        let unobserved = Decay { observed_from: 1.0, ..exact };
        assert_eq!(found(&unobserved, &SETTINGS).1, Status::Unobserved);
        let nothing = Decay { observed: Vec::new(), observed_from: 0.0, loss: Loss::Squares };
        assert_eq!(found(&nothing, &SETTINGS).1, Status::Settled);
    }
}
