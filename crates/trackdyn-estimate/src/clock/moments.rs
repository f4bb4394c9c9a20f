//! The offset at which the residual is orthogonal to instruments without the noise of D.
//!
//! A track that slips for a moment leaves residuals far beyond all others. They would pull the
//! offset. So weights fall with the square of a residual beyond a bound that noise does not reach,
//! as those of a t distribution do, from a start by least absolute values.
//!
//! # Sources
//! Holland, Welsch, Communications in Statistics A 6(9), 1977 (weights).

use super::intervals::{Intervals, RunIntervals, Turn};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use trackdyn_core::real;
use trackdyn_core::robust::deviation_about_zero;

/// Length of a block whose residuals may be correlated, s.
const BLOCK_DURATION: f64 = 5.0;

/// Residual, in their robust deviation, from which on a pose interval counts less: noise reaches it
/// once in a million times.
const MAX_RESIDUAL: f64 = 5.0;

/// How far the offset is looked for, in reaches of the instruments.
const MAX_REACH: f64 = 4.0;

/// Step of the offset to the start of the weights, s.
const START_STEP: f64 = 0.01;

/// Most rounds of weighting.
const MAX_ROUNDS: usize = 10;

/// Change of the offset that ends them, s.
const MIN_CHANGE: f64 = 1e-5;

/// Pose intervals with their instruments, and where to look for the offset.
pub(super) struct Moments<'a> {
    rows: Vec<Row<'a>>,
    coarse: f64,
    width: f64,
    track_interval: f64,
}

/// A pose interval with its instruments.
#[derive(Clone, Copy)]
struct Row<'a> {
    run: &'a RunIntervals,
    turn: &'a Turn,
    /// Run and block of time.
    block: (usize, f64),
    /// Lead plus lag, Δt, lead minus lag.
    instruments: [f64; 3],
    /// At most one.
    weight: f64,
}

/// What goes with an offset.
pub(super) struct Estimate {
    /// k, rad/m.
    pub(super) gain: f64,
    /// Standard error of the offset, s.
    pub(super) standard_error: f64,
}

impl<'a> Moments<'a> {
    /// Instruments for offsets around `coarse`; none where no interval has readings around it.
    pub(super) fn new(intervals: &'a Intervals, coarse: f64) -> Option<Self> {
        let width = intervals.track_interval + super::SEARCH_STEP;
        let mut rows = Vec::new();
        for (index, run) in intervals.runs.iter().enumerate() {
            for turn in &run.turns {
                // Far enough that D and its instruments share no update for any offset in reach.
                let away = turn.end - turn.start + intervals.update_interval + width;
                let reach = [coarse - away, coarse + away];
                if !run.covers(turn, reach) {
                    continue;
                }
                let lag = run.difference(turn, coarse + away);
                let lead = run.difference(turn, coarse - away);
                let block = (index, (turn.start / BLOCK_DURATION).floor());
                let instruments = [lead + lag, turn.end - turn.start, lead - lag];
                rows.push(Row { run, turn, block, instruments, weight: 1.0 });
            }
        }
        let track_interval = intervals.track_interval;
        (rows.len() >= super::MIN_INTERVALS).then_some(Self { rows, coarse, width, track_interval })
    }

    pub(super) fn count(&self) -> usize {
        self.rows.len()
    }

    /// As [`Moments::new`]: where residuals at a robust start lie far off, around that start, with
    /// weights.
    pub(super) fn robust(intervals: &'a Intervals, coarse: f64) -> Option<Self> {
        let plain = Self::new(intervals, coarse)?;
        let weighted = plain.start().and_then(|(tau, gain)| {
            let of_start = |moments: &Self| moments.weighted_at(tau, [gain, 0.0].into());
            let has_outliers = of_start(&plain)?.rows.iter().any(|row| row.weight < 1.0);
            has_outliers.then(|| of_start(&Self::new(intervals, tau)?)).flatten()
        });
        Some(weighted.unwrap_or(plain))
    }

    /// The offset, with the weights that go with it; none where the moment keeps its sign.
    pub(super) fn solved(mut self) -> Option<(Self, f64)> {
        let mut tau = self.root()?;
        for _ in 0..MAX_ROUNDS {
            let there = self.linear(tau).and_then(|parameters| self.weighted_at(tau, parameters));
            let Some(there) = there else { break };
            let Some(next) = there.root() else { break };
            let change = next - tau;
            (tau, self) = (next, there);
            if change.abs() < MIN_CHANGE {
                break;
            }
        }
        Some((self, tau))
    }

    /// Offset and k with the least sum of absolute residuals, b = 0.
    fn start(&self) -> Option<(f64, f64)> {
        let reach = MAX_REACH * self.width;
        let taus = (0..).map(|k| -reach + START_STEP * real(k)).take_while(|by| *by <= reach);
        let at = |by: f64| {
            let tau = self.coarse + by;
            let turn = |row: &Row<'a>| [row.run.difference(row.turn, tau), row.turn.yaw];
            let turns: Vec<[f64; 2]> = self.rows.iter().map(turn).collect();
            let gain = least_absolute_slope(&turns)?;
            let sum = turns.iter().map(|[by, yaw]| (yaw - gain * by).abs()).sum::<f64>();
            Some((sum, (tau, gain)))
        };
        taus.filter_map(at).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, start)| start)
    }

    /// With weights by the residuals at an offset, k and b; none where most residuals are zero.
    fn weighted_at(&self, tau: f64, parameters: Vector2<f64>) -> Option<Self> {
        let residuals: Vec<f64> =
            self.rows.iter().map(|row| row.residual(tau, &parameters)).collect();
        let deviation = deviation_about_zero(&mut residuals.clone())?;
        let weighted = |(row, residual): (&Row<'a>, f64)| Row {
            weight: (MAX_RESIDUAL * deviation / residual).powi(2).min(1.0),
            ..*row
        };
        let rows = self.rows.iter().zip(residuals).map(weighted).collect();
        (deviation > 0.0).then_some(Self { rows, ..*self })
    }

    /// The offset at which the third moment vanishes, to 1 µs: first looked for within the reach of
    /// the instruments, then up to four times as far, where they begin to share readings with D.
    /// None where the moment keeps its sign.
    fn root(&self) -> Option<f64> {
        let brackets = [1.0, 2.0, MAX_REACH]
            .map(|times| [self.coarse - times * self.width, self.coarse + times * self.width]);
        let change = |[low, high]: &[f64; 2]| {
            let (at_low, at_high) = (self.moment(*low)?, self.moment(*high)?);
            (at_low.signum() != at_high.signum()).then_some((*low, *high, at_low))
        };
        let (mut low, mut high, at_low) = brackets.iter().find_map(change)?;
        while high - low > 1e-6 {
            let middle = f64::midpoint(low, high);
            if self.moment(middle)?.signum() == at_low.signum() {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(f64::midpoint(low, high))
    }

    /// k and b at an offset, from the first two moments.
    fn linear(&self, tau: f64) -> Option<Vector2<f64>> {
        let mut matrix = Matrix2::zeros();
        let mut right = Vector2::zeros();
        for Row { run, turn, instruments: [sum, duration, _], weight, .. } in &self.rows {
            let instruments = Vector2::new(*sum, *duration) * *weight;
            let regressors = Vector2::new(run.difference(turn, tau), *duration);
            matrix += instruments * regressors.transpose();
            right += instruments * turn.yaw;
        }
        matrix.lu().solve(&right)
    }

    /// Σ w (lead − lag) (Δψ − k D − b Δt), w the weights.
    fn moment(&self, tau: f64) -> Option<f64> {
        let parameters = self.linear(tau)?;
        let term = |row: &Row| row.weight * row.instruments[2] * row.residual(tau, &parameters);
        Some(self.rows.iter().map(term).sum())
    }

    /// Standard error by the jackknife over blocks, linear in the parameters: leaving block g out
    /// moves them by Δg = (G − Gg)⁻¹ sg, with G = Σ w Z Jᵀ and sg = Σ w Z r over the block; the
    /// covariance is (n − 1)/n Σ Δg Δgᵀ for n blocks. With few blocks the sandwich formula, which
    /// has G⁻¹ instead, is too small.
    ///
    /// # Sources
    /// Bell and `McCaffrey`, Survey Methodology 28 (2002), 169-181.
    pub(super) fn estimate(&self, tau: f64) -> Estimate {
        let parameters = self.linear(tau).unwrap_or_default();
        let gain = parameters[0];
        // D is piecewise linear in τ: its slope is taken over the length of a piece.
        let half = self.track_interval.max(1e-3) / 2.0;
        let blocks: Vec<(Matrix3<f64>, Vector3<f64>)> = self
            .rows
            .chunk_by(|a, b| a.block == b.block)
            .map(|block| {
                let mut slopes = Matrix3::zeros();
                let mut score = Vector3::zeros();
                for row in block {
                    let instruments = Vector3::from(row.instruments) * row.weight;
                    let at = |tau| row.run.difference(row.turn, tau);
                    let slope = (at(tau + half) - at(tau - half)) / (2.0 * half);
                    let gradient = Vector3::new(at(tau), row.instruments[1], gain * slope);
                    slopes += instruments * gradient.transpose();
                    score += instruments * row.residual(tau, &parameters);
                }
                (slopes, score)
            })
            .collect();
        let whole: Matrix3<f64> = blocks.iter().map(|(slopes, _)| slopes).sum();
        let moved = |(slopes, score): &(Matrix3<f64>, Vector3<f64>)| {
            (whole - slopes).lu().solve(score).map_or(f64::INFINITY, |moves| moves[2] * moves[2])
        };
        let count = real(blocks.len());
        let squares: f64 = blocks.iter().map(moved).sum();
        let variance = if count > 1.0 { (count - 1.0) / count * squares } else { f64::INFINITY };
        Estimate { gain, standard_error: variance.sqrt() }
    }
}

/// The slope k with the least Σ |y − k x| of pairs (x, y): the median of y/x weighted by |x|.
fn least_absolute_slope(pairs: &[[f64; 2]]) -> Option<f64> {
    let slope = |&[x, y]: &[f64; 2]| (x != 0.0).then(|| (y / x, x.abs()));
    let mut slopes: Vec<(f64, f64)> = pairs.iter().filter_map(slope).collect();
    slopes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let whole: f64 = slopes.iter().map(|(_, weight)| weight).sum();
    let mut below = 0.0;
    let reaches_half = |(_, weight): &&(f64, f64)| {
        below += weight;
        below >= whole / 2.0
    };
    slopes.iter().find(reaches_half).map(|(slope, _)| *slope)
}

impl Row<'_> {
    /// Δψ − k D − b Δt.
    fn residual(&self, tau: f64, parameters: &Vector2<f64>) -> f64 {
        let difference = self.run.difference(self.turn, tau);
        self.turn.yaw - parameters[0] * difference - parameters[1] * self.instruments[1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slope_of_least_absolute_values_ignores_a_minority() {
        let pair = |k: u32| {
            let x = f64::from(k % 7) - 3.0;
            [x, if k.is_multiple_of(3) { 5.0 * x + 1.0 } else { 0.5 * x }]
        };
        let pairs: Vec<[f64; 2]> = (0..70).map(pair).collect();
        assert_eq!(least_absolute_slope(&pairs), Some(0.5));
        assert_eq!(least_absolute_slope(&[[0.0, 1.0]]), None);
    }
}
