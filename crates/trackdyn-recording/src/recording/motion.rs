//! How the poses of a recording follow its tracks, roughly: by a delay and two factors.
//!
//! # Law
//! turn = k (D_r − D_l) and way forward = a (D_l + D_r)/2, with D the way of a track between two
//! poses moved back by the delay. k and a are least squares, the delay is that of the largest
//! correlation of the turns.

use super::Run;
use crate::hold::travelled;
use crate::sample::{PoseSample, TrackSample};
use trackdyn_core::{PerSide, Side};

/// Least time of a piece, s.
pub(super) const MIN_PIECE: f64 = 0.25;

/// Longest time of a piece, s: a gap of the poses is no piece.
const MAX_PIECE: f64 = 5.0;

/// Fewest pieces that tell how poses follow.
const MIN_PIECES: usize = 20;

/// Correlation from which on poses follow the tracks.
const MIN_CORRELATION: f64 = 0.7;

/// Delays of the poses that are tried, in units of [`DELAY_STEP`].
pub(super) const DELAYS: std::ops::RangeInclusive<i32> = -10..=20;

/// Step of the delays, s.
pub(super) const DELAY_STEP: f64 = 0.05;

/// What poses did between two of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// Stamp of the first, s.
    pub(super) start: f64,
    /// Stamp of the last, s.
    pub(super) end: f64,
    /// Turn, rad.
    pub(super) turn: f64,
    /// Way along the mean heading, m.
    forward: f64,
}

impl Piece {
    pub(super) fn between(start: &PoseSample, end: &PoseSample) -> Self {
        let turn = end.pose.yaw - start.pose.yaw;
        let (x, y) = (end.pose.x - start.pose.x, end.pose.y - start.pose.y);
        let (sin, cos) = (start.pose.yaw + 0.5 * turn).sin_cos();
        Self { start: start.t, end: end.t, turn, forward: cos * x + sin * y }
    }

    /// Whether readings of the tracks cover it, moved back by a delay, s.
    pub(super) fn is_covered(&self, tracks: &[TrackSample], delay: f64) -> bool {
        let [first, .., last] = tracks else { return false };
        self.start - delay >= first.t && self.end - delay <= last.t
    }

    /// Way along the heading, m: of the arc whose chord the way along the mean heading is.
    pub(super) fn arc(&self) -> f64 {
        let half = 0.5 * self.turn;
        // s = c (φ/2)/sin(φ/2); a turn by more than half of one leaves no chord to tell it by.
        let is_chord = (1e-6..1.5).contains(&half.abs());
        if is_chord { self.forward * half / half.sin() } else { self.forward }
    }
}

/// The pieces of a run, each between the first poses that are far enough apart.
pub(super) fn pieces(run: &Run) -> Vec<Piece> {
    pieces_of(run, MIN_PIECE)
}

/// The pieces of a run of at least a time, s.
pub(super) fn pieces_of(run: &Run, least: f64) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let mut poses = run.poses().iter();
    let Some(mut start) = poses.next() else { return pieces };
    for end in poses {
        if end.t - start.t < least {
            continue;
        }
        if end.t - start.t <= MAX_PIECE {
            pieces.push(Piece::between(start, end));
        }
        start = end;
    }
    pieces
}

/// Every so many of the pieces of a run, about `most` of them: a part of a long one says enough.
pub(super) fn thinned(pieces: &[Piece], most: usize) -> impl Iterator<Item = &Piece> {
    pieces.iter().step_by(pieces.len().div_ceil(most).max(1))
}

/// How poses follow the tracks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Following {
    /// Delay of the poses, s.
    pub(super) delay: f64,
    /// k, rad/m.
    pub(super) turn: f64,
    /// a, 1; none where the way forward does not follow, or is not known.
    forward: Option<f64>,
}

impl Following {
    /// By all pieces but those that `is_left_out` names by the index of their run; none where the
    /// poses do not follow.
    pub(super) fn of(
        runs: &[Run],
        is_left_out: &dyn Fn(usize, &Piece, f64) -> bool,
    ) -> Option<Self> {
        let all: Vec<Vec<Piece>> = runs.iter().map(pieces).collect();
        let at = |delay: f64| Fits::of(runs, &all, delay, is_left_out);
        let delays = DELAYS.map(|step| DELAY_STEP * f64::from(step));
        let tried = delays.map(|delay| (delay, at(delay)));
        let tried = tried.filter(|(_, fits)| fits.count >= MIN_PIECES);
        let (delay, fits) =
            tried.max_by(|(_, a), (_, b)| a.turn.correlation().total_cmp(&b.turn.correlation()))?;
        let turn = fits.turn.slope_where_correlated()?;
        let has_positions = runs.iter().all(Run::has_positions);
        let forward = fits.forward.slope_where_correlated().filter(|_| has_positions);
        Some(Self { delay, turn, forward })
    }

    /// Ways that a track ran in a piece, m, as the poses and the other track tell it: by the turn
    /// and, where that is known, by the way forward.
    pub(super) fn way(&self, side: Side, piece: &Piece, ways: PerSide<f64>) -> [Option<f64>; 2] {
        // turn = k (D_r − D_l);  forward = a (D_l + D_r)/2
        let difference = piece.turn / self.turn;
        let other = ways[side.other()];
        [
            Some(other + side.sign() * difference),
            self.forward.map(|a| 2.0 * piece.forward / a - other),
        ]
    }

    /// Ways of the tracks in a piece by their readings, m.
    pub(super) fn ways(&self, run: &Run, piece: &Piece) -> PerSide<f64> {
        travelled(run.tracks(), piece.start, piece.end, self.delay)
    }
}

/// Sums of a fit through zero.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Line {
    xx: f64,
    xy: f64,
    yy: f64,
}

impl Line {
    pub(super) fn add(&mut self, x: f64, y: f64) {
        self.xx += x * x;
        self.xy += x * y;
        self.yy += y * y;
    }

    pub(super) fn correlation(&self) -> f64 {
        let scale = (self.xx * self.yy).sqrt();
        if scale > 0.0 { self.xy / scale } else { 0.0 }
    }

    /// y per x, where they are correlated.
    pub(super) fn slope_where_correlated(&self) -> Option<f64> {
        (self.correlation() >= MIN_CORRELATION).then(|| self.xy / self.xx)
    }
}

/// The fits at a delay.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Fits {
    pub(super) turn: Line,
    forward: Line,
    pub(super) count: usize,
}

impl Fits {
    pub(super) fn of(
        runs: &[Run],
        all: &[Vec<Piece>],
        delay: f64,
        is_left_out: &dyn Fn(usize, &Piece, f64) -> bool,
    ) -> Self {
        let mut fits = Self::default();
        for (index, (run, pieces)) in runs.iter().zip(all).enumerate() {
            for piece in thinned(pieces, MAX_PIECES) {
                if !piece.is_covered(run.tracks(), delay) || is_left_out(index, piece, delay) {
                    continue;
                }
                let PerSide { left, right } =
                    travelled(run.tracks(), piece.start, piece.end, delay);
                fits.turn.add(right - left, piece.turn);
                fits.forward.add(f64::midpoint(left, right), piece.forward);
                fits.count += 1;
            }
        }
        fits
    }
}

/// Most pieces of a run that are looked at.
const MAX_PIECES: usize = 2000;

/// Whether ways by the turn and by the way forward are ways of one track: 2 Σ ab / Σ (a² + b²).
pub(super) fn agreement(pairs: &[[f64; 2]]) -> f64 {
    let (ab, squares) = pairs
        .iter()
        .fold((0.0, 0.0), |(ab, squares), [a, b]| (ab + a * b, squares + 0.5 * (a * a + b * b)));
    if squares > 0.0 && !pairs.is_empty() { ab / squares } else { 0.0 }
}
