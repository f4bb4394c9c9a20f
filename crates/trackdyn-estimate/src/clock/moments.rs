//! The clock offset by instrumental variables: the residual is orthogonal to instruments that do
//! not share the noise of D.

use super::Settings;
use super::intervals::{Intervals, RunIntervals, Turn};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use trackdyn_core::real;

/// Pose intervals with their instruments, and where to look for the offset.
pub(super) struct Moments<'a> {
    rows: Vec<Row<'a>>,
    coarse: f64,
    width: f64,
    track_interval: f64,
}

/// A pose interval with its instruments.
struct Row<'a> {
    run: &'a RunIntervals,
    turn: &'a Turn,
    /// Run and block of time.
    block: (usize, f64),
    /// Lead plus lag, Δt, lead minus lag.
    instruments: [f64; 3],
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
    pub(super) fn new(intervals: &'a Intervals, coarse: f64, settings: &Settings) -> Option<Self> {
        let width = intervals.track_interval + settings.step;
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
                let block = (index, (turn.start / settings.block_duration).floor());
                let instruments = [lead + lag, turn.end - turn.start, lead - lag];
                rows.push(Row { run, turn, block, instruments });
            }
        }
        let track_interval = intervals.track_interval;
        (rows.len() >= settings.min_intervals).then_some(Self {
            rows,
            coarse,
            width,
            track_interval,
        })
    }

    pub(super) fn count(&self) -> usize {
        self.rows.len()
    }

    /// The offset at which the third moment vanishes, to 1 µs: first looked for within the reach of
    /// the instruments, then up to four times as far, where they begin to share readings with D.
    /// None where the moment keeps its sign.
    pub(super) fn root(&self) -> Option<f64> {
        let brackets = [1.0, 2.0, 4.0]
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
        for Row { run, turn, instruments: [sum, duration, _], .. } in &self.rows {
            let instruments = Vector2::new(*sum, *duration);
            let regressors = Vector2::new(run.difference(turn, tau), *duration);
            matrix += instruments * regressors.transpose();
            right += instruments * turn.yaw;
        }
        matrix.lu().solve(&right)
    }

    /// Σ (lead − lag) (Δψ − k D − b Δt).
    fn moment(&self, tau: f64) -> Option<f64> {
        let parameters = self.linear(tau)?;
        let terms = self.rows.iter().map(|row| row.instruments[2] * row.residual(tau, &parameters));
        Some(terms.sum())
    }

    /// Standard error by the jackknife over blocks, linear in the parameters: leaving block g out
    /// moves them by Δg = (G − Gg)⁻¹ sg, with G = Σ Z Jᵀ and sg = Σ Z r over the block; the
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
                    let instruments = Vector3::from(row.instruments);
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

impl Row<'_> {
    /// Δψ − k D − b Δt.
    fn residual(&self, tau: f64, parameters: &Vector2<f64>) -> f64 {
        let difference = self.run.difference(self.turn, tau);
        self.turn.yaw - parameters[0] * difference - parameters[1] * self.instruments[1]
    }
}
