//! Motion of the poses per way of each side and per time: a fit that does not assume which column
//! is which side.
//!
//! # Law
//! turn = b_l D_l + b_r D_r + b_0 T and way forward = a_l D_l + a_r D_r + a_0 T over pieces of a
//! second, with D the way by the readings of a side and T the time. Of a robot with tracks
//! b_l = −b_r, whatever its ICRs, and b_0 = a_0 = 0. Readings that are off by o_l and o_r all the
//! time have b_0 = −(b_l o_l + b_r o_r), a_0 = −(a_l o_l + a_r o_r). Columns that hold the mean and
//! the difference of both sides, or speed and yaw rate, have b = (0, b_r) and a = (a_l, 0).
//!
//! Errors are those of a jackknife over twenty parts of the log, so that slopes, slip and drifts
//! that come and go count.

use super::Run;
use super::motion::{DELAY_STEP, DELAYS, Piece, pieces_of, thinned};
use crate::hold::travelled;
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use trackdyn_core::robust::{HUBER_THRESHOLD, deviation_about_zero};
use trackdyn_core::{PerSide, Side, real};

/// Usual least time of a piece, s.
pub(super) const MIN_PIECE: f64 = 1.0;

/// Fewest pieces for a fit.
const MIN_PIECES: usize = 40;

/// Most pieces of a run that are looked at.
const MAX_PIECES: usize = 2000;

/// Parts of the log that count as independent.
const PARTS: usize = 20;

/// Rounds of reweighting by Huber's loss.
const ROUNDS: usize = 10;

/// Row of a fit: D_l, D_r, T, and turn, way forward.
type Row = (Vector3<f64>, [f64; 2]);

/// A fit with the fits without each of the parts.
pub(super) struct Linear {
    /// Coefficients of the turn: rad/m, rad/m, rad/s; and of the way forward: 1, 1, m/s.
    pub(super) all: [Vector3<f64>; 2],
    /// Delay of the poses, s.
    pub(super) delay: f64,
    without: Vec<[Vector3<f64>; 2]>,
}

impl Linear {
    /// Fits pieces of at least `least` seconds, but for those that are left out, at the delay of
    /// the poses that leaves least of the turns. None where pieces are few, or where the ways of
    /// both sides are proportional.
    pub(super) fn of(
        runs: &[Run],
        least: f64,
        is_left_out: &dyn Fn(usize, &Piece, f64) -> bool,
    ) -> Option<Self> {
        let pieces: Vec<Vec<Piece>> = runs.iter().map(|run| pieces_of(run, least)).collect();
        let tried = DELAYS.filter_map(|step| {
            let delay = DELAY_STEP * f64::from(step);
            let rows = rows(runs, &pieces, delay, is_left_out);
            let by = solved(&rows, &|_| 1.0, 0)?;
            let left = |(of, seen): &Row| (seen[0] - of.dot(&by)).powi(2);
            let share = rows.iter().map(left).sum::<f64>()
                / rows.iter().map(|row| row.1[0].powi(2)).sum::<f64>();
            Some((share, delay, rows))
        });
        let (_, delay, rows) = tried.min_by(|(a, ..), (b, ..)| a.total_cmp(b))?;
        let weights = [0, 1].map(|channel| weights(&rows, channel));
        let both = |rows: &[Row], is_in: &dyn Fn(usize) -> bool| {
            let of = |channel: usize| {
                let weights: &[f64] = &weights[channel];
                let weight = |k: usize| if is_in(k) { weights[k] } else { 0.0 };
                solved(rows, &weight, channel)
            };
            Some([of(0)?, of(1)?])
        };
        let all = both(&rows, &|_| true)?;
        let without: Option<Vec<_>> =
            (0..PARTS).map(|left_out| both(&rows, &|k| part(k, rows.len()) != left_out)).collect();
        Some(Self { all, delay, without: without? })
    }

    /// Ways of a side in a piece (m) by its turn and by its way forward, given those that its
    /// readings tell of both sides.
    pub(super) fn ways(&self, side: Side, piece: &Piece, read: PerSide<f64>) -> [f64; 2] {
        let (own, other) = if side == Side::Left { (0, 1) } else { (1, 0) };
        let time = piece.end - piece.start;
        let seen = [piece.turn, piece.arc()];
        std::array::from_fn(|channel| {
            let by = &self.all[channel];
            (seen[channel] - by[other] * read[side.other()] - by.z * time) / by[own]
        })
    }

    /// Factors of another column in place of the time, by the turn and by the way forward, with
    /// their standard errors; none where it does not run apart from the sides. The pieces are the
    /// usual ones.
    pub(super) fn factors(
        &self,
        runs: &[Run],
        column: &dyn Fn(usize, &Piece) -> [f64; 2],
    ) -> Option<[[f64; 2]; 2]> {
        let pieces: Vec<Vec<Piece>> = runs.iter().map(|run| pieces_of(run, MIN_PIECE)).collect();
        let factor = |channel: usize| -> Option<[f64; 2]> {
            let of_piece = |run: usize, piece: &Piece| column(run, piece)[channel];
            let rows = rows_with(runs, &pieces, self.delay, &|_, _, _| false, &of_piece);
            let weights = weights(&rows, channel);
            let without = |left_out: usize| {
                let weight =
                    |k: usize| if part(k, rows.len()) == left_out { 0.0 } else { weights[k] };
                Some(solved(&rows, &weight, channel)?.z)
            };
            let all = solved(&rows, &|k| weights[k], channel)?.z;
            Some([all, jackknifed(&(0..PARTS).map(without).collect::<Option<Vec<_>>>()?)])
        };
        Some([factor(0)?, factor(1)?])
    }

    /// A number of the fit with its standard error.
    pub(super) fn number(&self, of: impl Fn(&[Vector3<f64>; 2]) -> f64) -> [f64; 2] {
        let without: Vec<f64> = self.without.iter().map(&of).collect();
        [of(&self.all), jackknifed(&without)]
    }
}

/// Standard error of a number by its values without each of the parts.
fn jackknifed(without: &[f64]) -> f64 {
    let count = real(without.len());
    let mean = without.iter().sum::<f64>() / count;
    let scatter: f64 = without.iter().map(|value| (value - mean).powi(2)).sum();
    (scatter * (count - 1.0) / count).sqrt()
}

/// The part that one of so many rows belongs to.
fn part(row: usize, of: usize) -> usize {
    row * PARTS / of
}

/// o_l and o_r of a fit, m/s.
pub(super) fn offsets([turn, forward]: &[Vector3<f64>; 2]) -> Vector2<f64> {
    let by_offsets = Matrix2::new(turn.x, turn.y, forward.x, forward.y);
    let found = by_offsets.lu().solve(&-Vector2::new(turn.z, forward.z));
    found.unwrap_or(Vector2::repeat(f64::NAN))
}

/// The rows of pieces whose readings are at hand.
fn rows(
    runs: &[Run],
    pieces: &[Vec<Piece>],
    delay: f64,
    is_left_out: &dyn Fn(usize, &Piece, f64) -> bool,
) -> Vec<Row> {
    rows_with(runs, pieces, delay, is_left_out, &|_, piece| piece.end - piece.start)
}

/// The rows of pieces whose readings are at hand, with another column in place of the time.
fn rows_with(
    runs: &[Run],
    pieces: &[Vec<Piece>],
    delay: f64,
    is_left_out: &dyn Fn(usize, &Piece, f64) -> bool,
    column: &dyn Fn(usize, &Piece) -> f64,
) -> Vec<Row> {
    let of_run = |(index, (run, pieces)): (usize, (&Run, &Vec<Piece>))| -> Vec<Row> {
        let is_taken = |piece: &&Piece| {
            piece.is_covered(run.tracks(), delay) && !is_left_out(index, piece, delay)
        };
        let row = |piece: &Piece| {
            let ways = travelled(run.tracks(), piece.start, piece.end, delay);
            let of = Vector3::new(ways.left, ways.right, column(index, piece));
            (of, [piece.turn, piece.arc()])
        };
        thinned(pieces, MAX_PIECES).filter(is_taken).map(row).collect()
    };
    runs.iter().zip(pieces).enumerate().flat_map(of_run).collect()
}

/// Weights of Huber's loss.
fn weights(rows: &[Row], channel: usize) -> Vec<f64> {
    let mut weights = vec![1.0; rows.len()];
    for _ in 0..ROUNDS {
        let Some(by) = solved(rows, &|k| weights[k], channel) else { break };
        let left: Vec<f64> = rows.iter().map(|(of, seen)| seen[channel] - of.dot(&by)).collect();
        let spread = deviation_about_zero(&mut left.clone()).unwrap_or_default();
        let limit = HUBER_THRESHOLD * spread.max(f64::MIN_POSITIVE);
        weights = left.iter().map(|left| (limit / left.abs()).min(1.0)).collect();
    }
    weights
}

/// Least squares; none where the readings do not tell the sides apart.
fn solved(rows: &[Row], weight: &dyn Fn(usize) -> f64, channel: usize) -> Option<Vector3<f64>> {
    if rows.len() < MIN_PIECES {
        return None;
    }
    let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (k, (of, seen)) in rows.iter().enumerate() {
        matrix += weight(k) * of * of.transpose();
        right += weight(k) * seen[channel] * of;
    }
    let scale = matrix.diagonal().map(|square| 1.0 / square.sqrt());
    let scaled = Matrix3::from_diagonal(&scale) * matrix * Matrix3::from_diagonal(&scale);
    let is_told = scaled.determinant() > 1e-4;
    if is_told { Some(matrix.try_inverse()? * right) } else { None }
}
