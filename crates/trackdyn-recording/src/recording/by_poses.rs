//! What the poses did in pieces of a recording, beside the readings of the tracks, at any delay.
//!
//! # Law
//! The way of a track is p s + q φ, with s the way forward and φ the turn of the poses. What that
//! leaves of a number tells whether the number is such a way, whatever the delay, the unit and the
//! place of the sensor.

use super::Run;
use super::linear::MIN_PIECE;
use super::motion::{DELAY_STEP, DELAYS, Piece, pieces_of, thinned};
use crate::hold::{holding, travelled};
use nalgebra::{Matrix2, Vector2};
use std::cell::OnceCell;
use trackdyn_core::PerSide;

/// Fewest pieces for an explanation.
const MIN_PIECES: usize = 40;

/// Most pieces of a run that are looked at.
const MAX_PIECES: usize = 2000;

/// Delays beyond those of [`DELAYS`] that are tried, s.
const LONG_DELAYS: [f64; 9] = [-4.0, -3.0, -2.0, -1.5, -1.0, 1.5, 2.0, 3.0, 4.0];

/// What the poses did in a piece and what the readings say of it.
#[derive(Clone, Copy)]
pub(super) struct Row {
    /// Way forward of the poses, m.
    pub(super) forward: f64,
    /// Their turn, rad.
    pub(super) turn: f64,
    /// Ways of the tracks, m.
    pub(super) ways: PerSide<f64>,
    /// Readings at the end less those at the start, m/s.
    pub(super) changes: PerSide<f64>,
}

/// The rows of all runs by the delay of the poses, each found when it is asked for.
pub(super) struct ByDelay<'a> {
    runs: &'a [Run],
    pieces: OnceCell<Vec<Vec<Piece>>>,
    /// Delays that are tried, s, the likelier first, with their rows.
    rows: Vec<(f64, OnceCell<Vec<Row>>)>,
}

impl<'a> ByDelay<'a> {
    pub(super) fn new(runs: &'a [Run]) -> Self {
        let delays = DELAYS.map(|step| DELAY_STEP * f64::from(step)).chain(LONG_DELAYS);
        let mut rows: Vec<_> = delays.map(|delay| (delay, OnceCell::new())).collect();
        rows.sort_by(|(a, _), (b, _)| a.abs().total_cmp(&b.abs()));
        Self { runs, pieces: OnceCell::new(), rows }
    }

    /// The rows at each delay that has enough of them.
    pub(super) fn rows(&self) -> impl Iterator<Item = &[Row]> {
        let all = self.rows.iter().map(|(delay, rows)| &rows.get_or_init(|| self.at(*delay))[..]);
        all.filter(|rows| rows.len() >= MIN_PIECES)
    }

    fn at(&self, delay: f64) -> Vec<Row> {
        let pieces = || self.runs.iter().map(|run| pieces_of(run, MIN_PIECE)).collect();
        let pieces = self.pieces.get_or_init(pieces);
        let of_run = |(run, pieces): (&Run, &Vec<Piece>)| -> Vec<Row> {
            let covered = thinned(pieces, MAX_PIECES);
            let covered = covered.filter(|piece| piece.is_covered(run.tracks(), delay));
            covered.filter_map(|piece| row(run, piece, delay)).collect()
        };
        self.runs.iter().zip(pieces).flat_map(of_run).collect()
    }
}

/// The row of a piece that readings cover.
fn row(run: &Run, piece: &Piece, delay: f64) -> Option<Row> {
    let tracks = run.tracks();
    let speeds = |t: f64| Some(tracks[holding(tracks, t - delay)?].speeds());
    let (first, last) = (speeds(piece.start)?, speeds(piece.end)?);
    Some(Row {
        forward: piece.arc(),
        turn: piece.turn,
        ways: travelled(tracks, piece.start, piece.end, delay),
        changes: PerSide::new(last.left - first.left, last.right - first.right),
    })
}

/// The larger parts of those of two sides.
pub(super) fn larger(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].max(b[0]), a[1].max(b[1])]
}

/// Part of the squares of a number of the rows that no p s + q φ explains.
pub(super) fn unexplained(rows: &[Row], of: impl Fn(&Row) -> f64) -> f64 {
    let (mut matrix, mut right, mut all) = (Matrix2::zeros(), Vector2::zeros(), 0.0);
    for row in rows {
        let (by, number) = (Vector2::new(row.forward, row.turn), of(row));
        matrix += by * by.transpose();
        right += number * by;
        all += number * number;
    }
    // Where the poses go straight, or only turn, one of both explains as much as both.
    let by = matrix.try_inverse().map_or_else(
        || right.zip_map(&matrix.diagonal(), |xy, xx| if xx > 0.0 { xy / xx } else { 0.0 }),
        |inverse| inverse * right,
    );
    if all > 0.0 { (1.0 - right.dot(&by) / all).max(0.0) } else { 0.0 }
}
