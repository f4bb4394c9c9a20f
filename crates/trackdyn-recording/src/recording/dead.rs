//! Readings of a side that stay the same while its track moves otherwise: an encoder that is dead
//! for a while, and shows zero or its last speed.
//!
//! # Law
//! Three zeros of a side in a row are suspect if the speed drops to them and recovers abruptly, in
//! the same direction and by more than a third of the usual speed. Where they last for long, one of
//! the two is enough. Another speed is suspect if it stays for five times as many readings as
//! nearly all speeds of the side do, and jumps by that much at the end or lasts for long. Commands
//! and coarse encoders repeat their speeds as well.
//!
//! With the way of the other side, the poses show twice how far the track ran then: by their turn,
//! and by their way forward. The encoder was dead where both agree on a way that is off by more
//! than a third of the usual speed, in the second half of the time as well: where the readings are
//! commands, a track rolls out and stands. A robot that stops stands by its poses as well; on ice
//! it slides on for a while, which is why a speed has to come back. Commands stay the same as well,
//! and a robot that slides, or lags, does not follow them: a speed that is not zero has to be off
//! by twice what nearly all the rest of the log is, and rarely.
//!
//! A few readings are replaced by the line between those beside them; more are dropped, which
//! leaves a gap: nobody knows what the track did within.

use super::Run;
use super::cleaning::MIN_GAP_RATIO;
use super::finding::{Cleaning, Finding};
use super::motion::{Following, Piece, agreement, pieces};
use super::spikes::bridge;
use crate::sample::{PoseSample, Stream};
use std::ops::Range;
use trackdyn_core::robust::{median, quantile, usual_interval};
use trackdyn_core::{PerSide, Side, real};

/// Fewest equal readings in a row; fewer are spikes or chance.
const MIN_EQUAL_READINGS: usize = 3;

/// Times that a speed stays longer than nearly all speeds of its side, where it is in question.
const MIN_DURATION_RATIO: f64 = 5.0;

/// Largest share of the readings of a side that show the last speed of a dead encoder.
const MAX_STUCK_SHARE: f64 = 0.05;

/// Share of the log that counts as nearly all of it, and by how much more a stuck speed is off.
const MAIN_SHARE: f64 = 0.95;
const MIN_DEVIATION_RATIO: f64 = 2.0;

/// Fewest pieces of a time at a speed that is not zero: one alone may be a lag.
const MIN_PIECES: usize = 2;

/// Share of the usual speed that a track has to have had.
const MIN_SHARE: f64 = 1.0 / 3.0;

/// Time that no slide lasts, s.
const MAX_SLIDE_TIME: f64 = 3.0;

/// Agreement of both ways from which on they are those of one track.
const MIN_AGREEMENT: f64 = 0.5;

/// Longest time between the poses around equal readings, as multiple of the time of these readings.
const MAX_WIDENING: f64 = 2.0;

/// Least time of the pieces that a long time is cut into, s.
const MIN_PIECE: f64 = 0.25;

/// Equal readings in a row of a side.
#[derive(Clone, Debug)]
struct Equal {
    run: usize,
    side: Side,
    rows: Range<usize>,
    /// What they show, m/s.
    shown: f64,
    /// Stamps of the first and of the reading after the last, s.
    time: [f64; 2],
}

/// Bridges or drops the readings of dead encoders; `cleanings` takes what was found.
pub(super) fn leave_out(runs: &mut [Run], cleanings: &mut Vec<Cleaning>) {
    let usual = PerSide::from_fn(|side: Side| usual_speed(runs, side));
    let questioned: Vec<Equal> = (0..runs.len())
        .flat_map(|run| Side::BOTH.map(|side| equals(run, &runs[run], side, usual[side])))
        .flatten()
        .collect();
    if questioned.is_empty() {
        return;
    }
    let times: Vec<Vec<[f64; 2]>> = (0..runs.len()).map(|run| times(&questioned, run)).collect();
    let meets = |run: usize, piece: &Piece, delay: f64| {
        let next = times[run].partition_point(|[_, until]| *until <= piece.start - delay);
        times[run].get(next).is_some_and(|[from, _]| *from < piece.end - delay)
    };
    let Some(following) = Following::of(runs, &meets) else { return };
    let usually_off = PerSide::from_fn(|side: Side| usually_off(runs, side, &following, &meets));
    let is_dead = |equal: &Equal| {
        let least = MIN_SHARE * usual[equal.side];
        let run = &runs[equal.run];
        if equal.shown == 0.0 {
            moved(run, equal, &following, least, 1)
        } else {
            let least = least.max(MIN_DEVIATION_RATIO * usually_off[equal.side]);
            moved(run, equal, &following, least, MIN_PIECES)
        }
    };
    let mut dead: Vec<Equal> = questioned.iter().filter(|equal| is_dead(equal)).cloned().collect();
    let readings: usize = runs.iter().map(|run| run.tracks().len()).sum();
    for side in Side::BOTH {
        let is_stuck = |equal: &Equal| equal.side == side && equal.shown != 0.0;
        let stuck = dead.iter().filter(|equal| is_stuck(equal)).map(|equal| equal.rows.len());
        if real(stuck.sum()) > MAX_STUCK_SHARE * real(readings) {
            dead.retain(|equal| !is_stuck(equal));
        }
    }
    for (index, run) in runs.iter_mut().enumerate() {
        let of_run: Vec<&Equal> = dead.iter().filter(|equal| equal.run == index).collect();
        let Some(first) = of_run.first() else { continue };
        cleanings.push(Cleaning {
            stream: Stream::Tracks,
            finding: Finding::Dead {
                longest: of_run.iter().map(|of| of.time[1] - of.time[0]).fold(0.0, f64::max),
            },
            count: of_run.iter().map(|of| of.rows.len()).sum(),
            runs: 1,
            run: run.id(),
            t: of_run.iter().map(|of| of.time[0]).fold(first.time[0], f64::min),
        });
        mend(run, &of_run);
    }
}

/// The times of a run that are in question, apart from each other and in order, s.
fn times(questioned: &[Equal], run: usize) -> Vec<[f64; 2]> {
    let of_run = questioned.iter().filter(|equal| equal.run == run);
    let mut all: Vec<[f64; 2]> = of_run.map(|equal| equal.time).collect();
    all.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut apart: Vec<[f64; 2]> = Vec::with_capacity(all.len());
    for [from, until] in all {
        match apart.last_mut().filter(|last| last[1] >= from) {
            Some(last) => last[1] = last[1].max(until),
            None => apart.push([from, until]),
        }
    }
    apart
}

/// Median of the speeds of a side that are not zero, m/s; infinite where there are none.
fn usual_speed(runs: &[Run], side: Side) -> f64 {
    let speeds = runs.iter().flat_map(Run::tracks).map(|reading| reading.speeds()[side].abs());
    median(&mut speeds.filter(|speed| *speed > 0.0).collect::<Vec<_>>()).unwrap_or(f64::INFINITY)
}

/// Equal readings of a side that are in question.
fn equals(index: usize, run: &Run, side: Side, usual: f64) -> Vec<Equal> {
    let tracks = run.tracks();
    let speed = |row: usize| tracks[row].speeds()[side];
    let is_fast = |speed: f64| speed.abs() > MIN_SHARE * usual;
    let chunks = || tracks.chunk_by(|a, b| a.speeds()[side] == b.speeds()[side]);
    let of_speeds = chunks().filter(|equal| equal[0].speeds()[side] != 0.0);
    let mut lengths: Vec<f64> = of_speeds.map(|equal| real(equal.len())).collect();
    let usual_length = quantile(&mut lengths, MAIN_SHARE).unwrap_or_default();
    let mut found = Vec::new();
    let mut end = 0;
    for equal in chunks() {
        let rows = end..end + equal.len();
        end = rows.end;
        let shown = speed(rows.start);
        if rows.len() < MIN_EQUAL_READINGS {
            continue;
        }
        let beside = [rows.start.checked_sub(1), Some(end).filter(|end| *end < tracks.len())];
        let [before, after] = beside.map(|row| row.map(speed));
        let last = end.min(tracks.len() - 1);
        let time = [tracks[rows.start].t, tracks[last].t];
        let is_long = time[1] - time[0] >= MAX_SLIDE_TIME;
        let is_questioned = if shown == 0.0 {
            match [before, after] {
                [None, None] => is_long,
                [Some(a), Some(b)] if is_fast(a) && is_fast(b) && a * b > 0.0 => true,
                both => is_long && both.into_iter().flatten().any(is_fast),
            }
        } else {
            real(rows.len()) >= MIN_DURATION_RATIO * usual_length
                && (is_long || after.is_some_and(|after| is_fast(after - shown)))
        };
        if is_questioned {
            found.push(Equal { run: index, side, rows, shown, time });
        }
    }
    found
}

/// Ways (m) that a track ran more than its readings say in a piece, by the turn of the poses and by
/// their way forward.
fn off(run: &Run, side: Side, following: &Following, piece: &Piece) -> [f64; 2] {
    let read = following.ways(run, piece);
    let [by_turn, by_way] = following.way(side, piece, read);
    let by_turn = by_turn.unwrap_or(0.0) - read[side];
    [by_turn, by_way.map_or(by_turn, |way| way - read[side])]
}

/// Speed (m/s) below which the error of the readings of a side stays in nearly all of the log that
/// is not in question.
fn usually_off(
    runs: &[Run],
    side: Side,
    following: &Following,
    meets: &dyn Fn(usize, &Piece, f64) -> bool,
) -> f64 {
    let of_run = |(index, run): (usize, &Run)| -> Vec<f64> {
        let delay = following.delay;
        let is_taken =
            |piece: &Piece| piece.is_covered(run.tracks(), delay) && !meets(index, piece, delay);
        let taken = pieces(run).into_iter().filter(is_taken);
        let speed = |piece: Piece| {
            let [by_turn, by_way] = off(run, side, following, &piece);
            f64::midpoint(by_turn, by_way).abs() / (piece.end - piece.start)
        };
        taken.map(speed).collect()
    };
    let mut all: Vec<f64> = runs.iter().enumerate().flat_map(of_run).collect();
    quantile(&mut all, MAIN_SHARE).unwrap_or(f64::INFINITY)
}

/// Whether the track moved otherwise by what the poses say: by more than `least`, m/s, in so many
/// pieces or more.
fn moved(run: &Run, equal: &Equal, following: &Following, least: f64, fewest: usize) -> bool {
    let [from, until] = equal.time.map(|t| t + following.delay);
    let poses = run.poses();
    let first = poses.partition_point(|pose| pose.t <= from).saturating_sub(1);
    let last = poses.partition_point(|pose| pose.t < until).min(poses.len().saturating_sub(1));
    let Some(poses) = poses.get(first..=last).filter(|poses| poses.len() > 1) else { return false };
    let length = until - from;
    if poses[poses.len() - 1].t - poses[0].t > MAX_WIDENING * length {
        return false;
    }
    let pieces = cut(poses);
    let ways: Vec<[f64; 2]> =
        pieces.iter().map(|piece| off(run, equal.side, following, piece)).collect();
    if ways.len() < fewest {
        return false;
    }
    // A track that rolls out stands in the end.
    let missing =
        |ways: &[[f64; 2]]| -> f64 { ways.iter().map(|[a, b]| f64::midpoint(*a, *b).abs()).sum() };
    let share = least * length;
    let last = &ways[ways.len() / 2..];
    let goes_on = missing(last) > share * real(last.len()) / real(ways.len());
    missing(&ways) > share && goes_on && agreement(&ways) > MIN_AGREEMENT
}

/// The pieces between poses, of a least length but for the last.
fn cut(poses: &[PoseSample]) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let mut start = &poses[0];
    for (place, end) in poses.iter().enumerate().skip(1) {
        if end.t - start.t >= MIN_PIECE || place + 1 == poses.len() {
            pieces.push(Piece::between(start, end));
            start = end;
        }
    }
    pieces
}

/// Bridges few equal readings and drops more of them.
fn mend(run: &mut Run, dead: &[&Equal]) {
    let times: Vec<f64> = run.tracks().iter().map(|reading| reading.t).collect();
    let longest = MIN_GAP_RATIO * usual_interval(times.iter().copied());
    let (short, long): (Vec<&Equal>, Vec<&Equal>) =
        dead.iter().partition(|equal| equal.time[1] - equal.time[0] < longest);
    for side in Side::BOTH {
        let of_side = short.iter().filter(|equal| equal.side == side);
        let rows: Vec<usize> = of_side.flat_map(|equal| equal.rows.clone()).collect();
        if rows.is_empty() {
            continue;
        }
        let mut speeds: Vec<f64> =
            run.tracks().iter().map(|reading| reading.speeds()[side]).collect();
        bridge(&times, &mut speeds, &rows);
        for row in rows {
            let reading = &mut run.readings_mut()[row];
            match side {
                Side::Left => reading.v_left = speeds[row],
                Side::Right => reading.v_right = speeds[row],
            }
        }
    }
    let mut is_kept = vec![true; times.len()];
    for equal in long {
        is_kept[equal.rows.clone()].fill(false);
    }
    let kept: Vec<usize> = (0..times.len()).filter(|row| is_kept[*row]).collect();
    if kept.len() < times.len() {
        run.keep_readings(&kept);
    }
}
