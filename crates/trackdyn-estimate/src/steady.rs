//! Parameters from steady operating points: a measured map of ICRs.
//!
//! # Law
//! Eqs (7)-(9) at each point: ω = (α_r V_r − α_l V_l)/(x_r − x_l), forward α_l V_l − ω x_l, to the
//! left −ω y. Residuals of each channel count by its own scatter, whose size comes from the
//! residuals (1.48 median absolute deviations), with Huber's loss.
//!
//! # Assumes
//! Track speeds are known. Deviations are independent between points, or between groups of points
//! with one left track speed, or between groups with one right track speed. Intervals are the
//! widest of the jackknifes over these three.

mod groups;
mod lagging;
mod row;

pub use groups::Grouping;
pub use lagging::{Lagging, lagging};

use crate::Interval;
use crate::contradiction::Contradiction;
use crate::doubt::Doubt;
use crate::error::Error;
use crate::gauss_newton::{Minimum, Problem, Settings, Status, minimise};
use crate::least_squares::covariance::{inverse, jackknife, larger_deviation, with_deviations};
use crate::least_squares::{Loss, too_wide};
use crate::parameters::{Free, Parameters};
use nalgebra::{DMatrix, DVector, Matrix2, Vector2};
use row::{Row, observed};
use trackdyn_core::real;
use trackdyn_core::robust::deviation_about_zero;
use trackdyn_recording::OperatingPoint;

/// Channels of a point: forward (m/s), left (m/s), yaw rate (rad/s).
pub const CHANNELS: usize = 3;

/// Place of y_icr among the parameters.
const Y_ICR: usize = 2;

/// Speeds that differ by less than this part of their size are alike: tables round to four digits.
const SPEED_ROUNDING: f64 = 1e-3;

/// Rounds of a fit, each with the scatters that the one before left: medians may jump between two
/// residuals for ever.
const MAX_ROUNDS: usize = 30;

/// The scatters have settled when none changes by more than this part.
const SCATTER_SETTLED: f64 = 1e-6;

/// Least scatter of a channel, m/s or rad/s: that of a table that a model explains to rounding.
/// Some channels are exact at ICRs far from the others' (forward, at any ICRs with the robot in
/// their middle), and weights further apart than 1e12 leave the normal equations no digits.
const MIN_SCATTER: f64 = 1e-6;

/// Changes of parameters are in m or 1.
const SETTINGS: Settings =
    Settings { max_iterations: 200, settled_below: 1e-10, newton_below: 1e-4 };

/// Fitted parameters of steady points.
#[derive(Clone, Debug)]
pub struct SteadyEstimate {
    /// The parameters; those that are not free keep their start.
    pub parameters: Parameters,
    /// Which were free.
    pub free: Free,
    /// Covariance of the free parameters, by the jackknife of `grouping`.
    pub covariance: DMatrix<f64>,
    /// Covariance of the free parameters if every residual were independent of all others.
    pub covariance_of_scatter: DMatrix<f64>,
    /// What was taken as independent of one another.
    pub grouping: Grouping,
    /// How many of these there are.
    pub groups: usize,
    /// Scatter of each channel, m/s, m/s, rad/s; none where it was not measured.
    pub scatter: [Option<f64>; CHANNELS],
    /// Residuals of each point in these scatters, by channel; none where not measured.
    pub residuals: Vec<[Option<f64>; CHANNELS]>,
    /// Iterations.
    pub iterations: usize,
}

/// Fits the parameters to steady points, from `start` on.
///
/// # Errors
/// Too few measurements, no turning or (with α) one ratio of speeds, or no convergence.
pub fn fit_points(
    points: &[OperatingPoint],
    start: &Parameters,
    free: Free,
    loss: Loss,
) -> Result<SteadyEstimate, Error> {
    let count = free.count();
    let measured = points.iter().flat_map(observed).flatten().count();
    if measured < 4 * count {
        let (found, needed) = (measured, 4 * count);
        return Err(Error::TooFewMeasurements { found, needed, parameters: count });
    }
    if let Some(doubt) = lacks(points, free) {
        return Err(Error::NotDetermined(doubt));
    }
    let (table, at, iterations) = settled(points, start, loss, count)?;
    let (matrix, _) = table.normal_equations(&at);
    let parts = table.parts(&at, |residual| loss.curvature(residual));
    let (curvature, _) = sum(&parts, count);
    let (grouping, groups, covariance) =
        groups::widest(points, &parts, |grouped| jackknife(&curvature, grouped));
    Ok(SteadyEstimate {
        parameters: at.parameters,
        free,
        covariance,
        covariance_of_scatter: inverse(&matrix),
        grouping,
        groups,
        scatter: table.scatter,
        residuals: at.rows.iter().map(|row| row.whitened(&table.scatter)).collect(),
        iterations,
    })
}

/// The minimum whose residuals have the scatters that it was found with, and the steps to it.
fn settled<'a>(
    points: &'a [OperatingPoint],
    start: &Parameters,
    loss: Loss,
    count: usize,
) -> Result<(Table<'a>, At, usize), Error> {
    let mut at = At::new(points, *start);
    let mut table = Table { points, loss, count, scatter: scatter_of(&at.rows, loss) };
    let mut steps = 0;
    for _ in 0..MAX_ROUNDS {
        let Minimum { point, status, iterations, last_change } = minimise(&table, at, &SETTINGS);
        steps += iterations;
        if status != Status::Settled {
            return Err(Error::NotConverged { iterations: steps, step: last_change });
        }
        at = point;
        let scatter = scatter_of(&at.rows, loss);
        let is_settled = (0..CHANNELS).all(|channel| {
            let (before, now) = (table.scatter[channel], scatter[channel]);
            before.zip(now).is_none_or(|(b, n)| (b - n).abs() <= SCATTER_SETTLED * b)
        });
        if is_settled {
            break;
        }
        table.scatter = scatter;
    }
    Ok((table, at, steps))
}

/// Points whose residuals, in these scatters, the first parameters make small.
struct Table<'a> {
    points: &'a [OperatingPoint],
    loss: Loss,
    /// Number of free parameters.
    count: usize,
    scatter: [Option<f64>; CHANNELS],
}

/// Parameters with the residuals that they leave.
struct At {
    parameters: Parameters,
    rows: Vec<Row>,
}

impl At {
    fn new(points: &[OperatingPoint], parameters: Parameters) -> Self {
        let rows = points.iter().map(|point| Row::at(point, &parameters)).collect();
        Self { parameters, rows }
    }
}

impl Table<'_> {
    /// What each point adds to the normal equations, with these weights of the residuals.
    fn parts(&self, at: &At, weight: impl Fn(f64) -> f64) -> Vec<Part> {
        let part = |row: &Row| row.part(&self.scatter, self.loss, &weight, self.count);
        at.rows.iter().map(part).collect()
    }
}

impl Problem for Table<'_> {
    type Point = At;

    fn cost(&self, at: &At) -> f64 {
        let whitened = at.rows.iter().flat_map(|row| row.whitened(&self.scatter));
        whitened.flatten().map(|residual| self.loss.value(residual)).sum()
    }

    fn normal_equations(&self, at: &At) -> Part {
        sum(&self.parts(at, |residual| self.loss.weight(residual)), self.count)
    }

    fn curvature(&self, at: &At) -> DMatrix<f64> {
        sum(&self.parts(at, |residual| self.loss.curvature(residual)), self.count).0
    }

    fn stepped(&self, at: &At, step: &mut DVector<f64>) -> At {
        let mut parameters = at.parameters;
        // The left ICR stays left of the right one.
        while parameters.0[1] + step[1] <= parameters.0[0] + step[0] {
            *step *= 0.5;
        }
        for k in 0..self.count {
            parameters.0[k] += step[k];
        }
        At::new(self.points, parameters)
    }
}

impl SteadyEstimate {
    /// The 95 % interval of a free parameter; none of one that is fixed.
    pub fn interval(&self, parameter: usize) -> Option<Interval> {
        (parameter < self.free.count()).then(|| {
            let deviation = self.deviation(|of| of[(parameter, parameter)]);
            let value = self.parameters.0[parameter];
            Interval::new(value, deviation, self.groups, self.free.count())
        })
    }

    /// The larger standard deviation by both covariances: the jackknife is blind to a parameter on
    /// which no residual depends.
    fn deviation(&self, variance: impl Fn(&DMatrix<f64>) -> f64) -> f64 {
        larger_deviation([&self.covariance, &self.covariance_of_scatter].map(variance))
    }

    /// The parameters that are too uncertain for a vehicle with this gauge, m.
    pub fn doubts(&self, gauge: f64) -> Vec<Doubt> {
        let (mut deviations, mut doubts) = (self.deviations(), Vec::new());
        // y shows in the lateral speed alone.
        if self.scatter[1].is_none() {
            deviations[Y_ICR] = 0.0;
            doubts.push(Doubt::NoLateralSpeed);
        }
        doubts.extend(too_wide(&deviations, gauge));
        doubts
    }

    /// What contradicts the parameters on a vehicle with this gauge, m.
    pub fn contradictions(&self, gauge: f64) -> Vec<Contradiction> {
        let efficiency = self.gap().dividing(gauge);
        Contradiction::of_parameters(&self.parameters, &efficiency)
    }

    /// The covariance of the free parameters, with the standard deviations of their intervals.
    pub fn covariance_of_parameters(&self) -> Vec<Vec<f64>> {
        with_deviations(&self.covariance, &self.deviations())
    }

    /// Standard deviations of the free parameters.
    fn deviations(&self) -> Vec<f64> {
        let deviation = |k| self.interval(k).map_or(0.0, |interval| interval.deviation);
        (0..self.free.count()).map(deviation).collect()
    }

    /// Distance between the ICRs x_r − x_l with its 95 % interval, m.
    pub fn gap(&self) -> Interval {
        let [x_l, x_r, ..] = self.parameters.0;
        let deviation = self.deviation(|of| of[(0, 0)] + of[(1, 1)] - 2.0 * of[(0, 1)]);
        Interval::new(x_r - x_l, deviation, self.groups, self.free.count())
    }

    /// Indices of the points with the largest residuals, the largest first.
    pub fn worst(&self) -> Vec<usize> {
        let size = |index: usize| {
            self.residuals[index].iter().flatten().fold(0.0, |worst: f64, r| worst.max(r.abs()))
        };
        let mut order: Vec<usize> = (0..self.residuals.len()).collect();
        order.sort_by(|&a, &b| size(b).total_cmp(&size(a)).then(a.cmp(&b)));
        order
    }
}

/// What the speeds of a table lack for these parameters; none where they lack nothing. The
/// intervals show how well the table determines them.
fn lacks(points: &[OperatingPoint], free: Free) -> Option<Doubt> {
    let moments = points.iter().fold(Matrix2::zeros(), |sum, point| {
        let speeds = Vector2::new(point.v_left, point.v_right);
        sum + speeds * speeds.transpose()
    });
    let across = moments[(0, 0)] + moments[(1, 1)] - 2.0 * moments[(0, 1)];
    let least = match free {
        Free::Icrs => across,
        Free::IcrsAndAlphas => moments.symmetric_eigenvalues().min(),
    };
    let doubt = match free {
        Free::Icrs => Doubt::NoTurning,
        Free::IcrsAndAlphas => Doubt::OneRatio,
    };
    // written so that no motion at all is a lack too
    let enough = least > SPEED_ROUNDING.powi(2) * moments.trace();
    (!enough).then_some(doubt)
}

/// What some points add to the normal equations.
type Part = (DMatrix<f64>, DVector<f64>);

fn sum(parts: &[Part], count: usize) -> Part {
    let start = (DMatrix::zeros(count, count), DVector::zeros(count));
    parts.iter().fold(start, |sum, part| (sum.0 + &part.0, sum.1 + &part.1))
}

/// Scatter of each channel: by the median where outliers count linearly, by the mean square else.
fn scatter_of(rows: &[Row], loss: Loss) -> [Option<f64>; CHANNELS] {
    std::array::from_fn(|channel| {
        let mut sizes: Vec<f64> = rows.iter().filter_map(|row| row.residuals[channel]).collect();
        let by_median = deviation_about_zero(&mut sizes)?;
        let mean_square = sizes.iter().map(|size| size * size).sum::<f64>() / real(sizes.len());
        let size = match loss {
            // where most residuals are rounded away, the median says nothing
            Loss::Huber if by_median > 0.0 => by_median,
            _ => mean_square.sqrt(),
        };
        Some(size.max(MIN_SCATTER))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_model::{Icrs, Kinematics};

    /// Points by these ICRs, with a scatter of the yaw rate, rad/s; the forward and lateral speeds
    /// are exact.
    fn points(icrs: Icrs, scatter: f64) -> Vec<OperatingPoint> {
        let kinematics = Kinematics::new(icrs);
        let point = |(i, j): (i32, i32)| {
            let (v_left, v_right) = (0.2 * f64::from(i), 0.2 * f64::from(j));
            let [forward, left, yaw_rate] = predict(&kinematics, v_left, v_right);
            let off = scatter * f64::from((7 * i + 3 * j).rem_euclid(5) - 2);
            OperatingPoint {
                v_left,
                v_right,
                v_forward: Some(forward),
                v_lateral: Some(left - icrs.y * off),
                yaw_rate: Some(yaw_rate + off),
            }
        };
        (-4..=4).flat_map(|i| (-4..=4).map(move |j| (i, j))).map(point).collect()
    }

    fn predict(kinematics: &Kinematics, v_left: f64, v_right: f64) -> [f64; CHANNELS] {
        let Icrs { x_left, x_right, y } = kinematics.icrs;
        let yaw_rate = (v_right - v_left) / (x_right - x_left);
        [v_left - yaw_rate * x_left, -yaw_rate * y, yaw_rate]
    }

    #[test]
    fn points_give_their_icrs_back() {
        // The forward speed is as exact at the start as at the end.
        let icrs = Icrs { x_left: -0.416, x_right: 0.416, y: 0.05 };
        let start = Parameters::of(&Kinematics::ideal(0.42));
        for (scatter, tolerance) in [(0.0, 1e-8), (1e-6, 1e-6), (1e-3, 1e-3)] {
            for loss in [Loss::Squares, Loss::Huber] {
                for free in [Free::Icrs, Free::IcrsAndAlphas] {
                    let fit = fit_points(&points(icrs, scatter), &start, free, loss);
                    let fit = fit.unwrap_or_else(|e| panic!("{scatter} {loss:?} {free:?}: {e}"));
                    let [x_l, x_r, y, ..] = fit.parameters.0;
                    let off = [x_l - icrs.x_left, x_r - icrs.x_right, y - icrs.y];
                    assert!(off.iter().all(|off| off.abs() < tolerance), "{off:?}");
                }
            }
        }
    }
}
