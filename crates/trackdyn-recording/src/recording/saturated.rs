//! Readings of a side that stand at its largest speed while its track runs faster: the limit of an
//! encoder, of a filter, or of the type of a message.
//!
//! # Law
//! No measured speed meets its largest value again and again, but a robot that is driven at one
//! speed may. So the readings at the largest value of a side and a sense are in question where they
//! are many, and what the track ran in them is told by the poses: by the turn and by the way
//! forward, as these follow the tracks in the rest of the log. They are left out where the track
//! ran further than they say by more than it did at speeds that are nearly as large. What is left
//! out is chosen by the reading and not by what the poses say of it, so that the rest is no biased
//! choice.

use super::Run;
use super::finding::{Cleaning, Finding};
use super::linear::Linear;
use super::motion::{MIN_PIECE, Piece, pieces};
use crate::hold::travelled;
use crate::sample::Stream;
use trackdyn_core::{Side, real};

/// Fewest readings at the largest speed, their smallest share in all that move, and fewest times in
/// which they come: a step of a drive is one.
const MIN_READINGS: usize = 20;
const MIN_SHARE: f64 = 0.01;
const MIN_TIMES: usize = 3;

/// Part of the largest speed by which readings at it may differ: digits of a table.
const ROUNDING: f64 = 1e-5;

/// Fewest pieces between poses that lie in such readings.
const MIN_PIECES: usize = 12;

/// Least share by which a track runs further than its readings say: beyond that share at speeds
/// nearly as large, and where there are no such speeds. Loads that shift at top speed change what
/// tracks do by some percent.
const MIN_MISSING_SHARE: f64 = 0.1;
const MIN_MISSING_SHARE_ALONE: f64 = 0.15;

/// Speeds that are nearly as large, as share of the largest.
const COMPARED_SPEEDS: [f64; 2] = [0.5, 0.97];

/// Least significance of that share, in standard errors.
const MIN_ERRORS: f64 = 6.0;

/// Smallest part of a piece that lies in such readings.
const MIN_WITHIN_SHARE: f64 = 0.8;

/// The largest speed of a side in one sense.
#[derive(Clone, Copy, Debug)]
struct Limit {
    side: Side,
    speed: f64,
}

impl Limit {
    fn is_met(&self, speed: f64) -> bool {
        speed / self.speed > 1.0 - ROUNDING
    }

    /// Whether another one is as large.
    fn is_like(&self, other: &Self) -> bool {
        (self.speed / other.speed).abs().ln().abs() < ROUNDING
    }
}

/// Drops saturated readings; `cleanings` takes what was found.
pub(super) fn leave_out(runs: &mut [Run], cleanings: &mut Vec<Cleaning>) {
    if !runs.iter().all(Run::has_positions) {
        return;
    }
    let limits = questioned(runs);
    if limits.is_empty() {
        return;
    }
    let within: Vec<Vec<Vec<[f64; 2]>>> =
        limits.iter().map(|limit| runs.iter().map(|run| times(run, limit)).collect()).collect();
    let meets = |run: usize, piece: &Piece, delay: f64| {
        within.iter().any(|limit| overlap(&limit[run], piece, delay) > 0.0)
    };
    let Some(linear) = Linear::of(runs, MIN_PIECE, &meets) else { return };
    let is_saturated = |index: usize| {
        let others = |run: usize, piece: &Piece| {
            let of = |k: usize| limits[k].side != limits[index].side;
            let mut others = (0..limits.len()).filter(|k| of(*k));
            others.any(|k| overlap(&within[k][run], piece, linear.delay) > 0.0)
        };
        runs_faster(runs, limits[index], &within[index], &others, &linear)
    };
    // One limit is that of both sides and senses.
    let saturated: Vec<Limit> =
        (0..limits.len()).filter(|k| is_saturated(*k)).map(|k| limits[k]).collect();
    let is_found = |limit: &&Limit| saturated.iter().any(|found| found.is_like(limit));
    let found: Vec<Limit> = limits.iter().filter(is_found).copied().collect();
    for run in runs.iter_mut().filter(|_| !found.is_empty()) {
        let is_out = |row: &usize| {
            let speeds = run.tracks()[*row].speeds();
            found.iter().any(|limit| limit.is_met(speeds[limit.side]))
        };
        let rows = 0..run.tracks().len();
        let Some(first) = rows.clone().find(is_out) else { continue };
        let kept: Vec<usize> = rows.clone().filter(|row| !is_out(row)).collect();
        let limit = found.iter().map(|limit| limit.speed.abs()).fold(0.0, f64::max);
        let (stream, finding) = (Stream::Tracks, Finding::Saturated { limit });
        let (count, t) = (rows.len() - kept.len(), run.tracks()[first].t);
        cleanings.push(Cleaning { stream, finding, count, runs: 1, run: run.id(), t });
        run.keep_readings(&kept);
    }
}

/// The largest speeds of sides and senses that many readings meet, those of one size together.
fn questioned(runs: &[Run]) -> Vec<Limit> {
    let sides = Side::BOTH.into_iter().flat_map(|side| [1.0, -1.0].map(|sense| (side, sense)));
    let largest = |(side, sense): (Side, f64)| {
        let speeds = runs.iter().flat_map(Run::tracks).map(|one| sense * one.speeds()[side]);
        Limit { side, speed: sense * speeds.fold(0.0, f64::max) }
    };
    let all: Vec<Limit> = sides.map(largest).filter(|limit| limit.speed != 0.0).collect();
    let are_many = |limit: &Limit| {
        let (mut met, mut moving, mut count) = (0_usize, 0_usize, 0_usize);
        for like in all.iter().filter(|like| like.is_like(limit)) {
            let speeds = || runs.iter().flat_map(Run::tracks).map(|one| one.speeds()[like.side]);
            met += speeds().filter(|speed| like.is_met(*speed)).count();
            moving += speeds().filter(|speed| speed / like.speed > 0.0).count();
            count += runs.iter().map(|run| times(run, like).len()).sum::<usize>();
        }
        met >= MIN_READINGS && real(met) >= MIN_SHARE * real(moving) && count >= MIN_TIMES
    };
    all.iter().filter(|limit| are_many(limit)).copied().collect()
}

/// The times in which the readings of a run meet a limit, s.
fn times(run: &Run, limit: &Limit) -> Vec<[f64; 2]> {
    let tracks = run.tracks();
    let mut times: Vec<[f64; 2]> = Vec::new();
    for pair in tracks.windows(2).filter(|pair| limit.is_met(pair[0].speeds()[limit.side])) {
        match times.last_mut().filter(|last| last[1] >= pair[0].t) {
            Some(last) => last[1] = pair[1].t,
            None => times.push([pair[0].t, pair[1].t]),
        }
    }
    times
}

/// Part of a piece that lies in these times.
fn overlap(times: &[[f64; 2]], piece: &Piece, delay: f64) -> f64 {
    let [start, end] = [piece.start - delay, piece.end - delay];
    let first = times.partition_point(|[_, until]| *until <= start);
    let met = times[first..].iter().take_while(|[from, _]| *from < end);
    met.map(|[from, until]| until.min(end) - from.max(start)).sum::<f64>() / (end - start)
}

/// Whether a track runs faster than its readings at a limit say.
fn runs_faster(
    runs: &[Run],
    limit: Limit,
    times: &[Vec<[f64; 2]>],
    others: &dyn Fn(usize, &Piece) -> bool,
    linear: &Linear,
) -> bool {
    // Part of the way of the readings that is missing, where the other side is right, where it is
    // in question as well, and at speeds nearly as large.
    let (mut alone, mut together, mut nearly) = (Vec::new(), Vec::new(), Vec::new());
    for (index, run) in runs.iter().enumerate() {
        for piece in &pieces(run) {
            let read = travelled(run.tracks(), piece.start, piece.end, linear.delay);
            let whole = limit.speed * (piece.end - piece.start);
            let part = read[limit.side] / whole;
            let within = overlap(&times[index], piece, linear.delay);
            let is_other = others(index, piece);
            let [low, high] = COMPARED_SPEEDS;
            let is_nearly = within == 0.0 && !is_other && (low..high).contains(&part);
            if within <= MIN_WITHIN_SHARE && !is_nearly {
                continue;
            }
            let ways = linear.ways(limit.side, piece, read);
            let [by_turn, by_way] = ways.map(|way| (way - read[limit.side]) / whole);
            if is_other {
                // The way forward lacks what both sides lack.
                together.push(0.5 * by_way);
            } else if is_nearly {
                nearly.push(f64::midpoint(by_turn, by_way) / part);
            } else {
                alone.push(f64::midpoint(by_turn, by_way));
            }
        }
    }
    let usual = Mean::of(&nearly);
    [alone, together].iter().filter_map(|missing| Mean::of(missing)).any(|missing| {
        let (beyond, error, least) = match usual {
            Some(usual) => {
                (missing.value - usual.value, missing.error.hypot(usual.error), MIN_MISSING_SHARE)
            }
            None => (missing.value, missing.error, MIN_MISSING_SHARE_ALONE),
        };
        beyond > least && beyond > MIN_ERRORS * error
    })
}

/// A mean with its standard error.
#[derive(Clone, Copy)]
struct Mean {
    value: f64,
    error: f64,
}

impl Mean {
    /// None of too few.
    fn of(values: &[f64]) -> Option<Self> {
        let count = real(values.len());
        let value = values.iter().sum::<f64>() / count;
        let scatter: f64 = values.iter().map(|one| (one - value).powi(2)).sum();
        let error = (scatter / (count * (count - 1.0))).sqrt();
        (values.len() >= MIN_PIECES).then_some(Self { value, error })
    }
}
