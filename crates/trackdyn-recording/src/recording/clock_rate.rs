//! Poses whose clock runs faster or slower than that of the tracks.
//!
//! # Law
//! turn = b_l D_l(δ) + b_r D_r(δ) over pieces of a quarter second, with D the ways of the tracks in
//! the piece moved back by a delay δ = τ + ρ (t − t̄): τ in the middle t̄ of each run, growing by
//! ρ. b, τ and ρ are least squares by Gauss-Newton steps. They begin with the delays of the largest
//! correlation in parts of the runs, and with the median of the slopes between these.
//!
//! Errors are those of a jackknife over blocks of time, so that slip that comes and goes counts.
//! Stamps of poses are set back by ρ (t − t̄) on three conditions: ρ is significant, it leaves less
//! of the turns than any one delay, and the clocks drift apart by more than poses are known in
//! time.

use super::Run;
use super::finding::{Cleaning, Finding};
use super::motion::{DELAY_STEP, DELAYS, Fits, Piece, pieces, thinned};
use crate::hold::travelled;
use crate::sample::Stream;
use nalgebra::{Matrix2, Matrix4, Vector2, Vector4};
use trackdyn_core::real;
use trackdyn_core::robust::median;

/// Time of a part of a run that has a delay of its own, s.
const PART: f64 = 20.0;

/// Most parts of a recording that are looked at.
const MAX_PARTS: usize = 120;

/// Fewest parts whose delay is known.
const MIN_PARTS: usize = 4;

/// Fewest pieces of such a part.
const MIN_PIECES: usize = 20;

/// Most pieces of a run that are looked at.
const MAX_PIECES: usize = 4000;

/// Length of a block whose residuals may be correlated, s.
const BLOCK: f64 = 10.0;

/// Fewest blocks that tell an error.
const MIN_BLOCKS: usize = 8;

/// Gauss-Newton steps.
const ITERATIONS: usize = 8;

/// Fewest standard errors of the rate. Slip and lags of real robots, which the errors take for
/// chance, reach three.
const MIN_ERRORS: f64 = 6.0;

/// Largest ratio of the squares that a rate leaves of the turns to those that one delay leaves.
const MAX_RESIDUAL_SHARE: f64 = 0.9;

/// Delays around that of the rate that are tried as one delay, in steps of a fraction of
/// [`DELAY_STEP`].
const ONE_DELAY_STEPS: i32 = 60;
const ONE_DELAY_STEP: f64 = DELAY_STEP / 20.0;

/// Least time by which the clocks part within a run, s: a part of the time that poses are late.
const MIN_GAIN: f64 = 0.03;

/// Least such time in intervals of the readings: within one, nobody knows when a speed changed.
const MIN_INTERVALS: f64 = 2.0;

/// The rate at which the clock of the poses gains on that of the tracks.
struct Rate {
    /// τ, s.
    tau: f64,
    /// ρ, s per s.
    value: f64,
    /// Its standard error.
    error: f64,
}

/// Sets the stamps of poses back to the clock of the tracks; `cleanings` takes what was found.
pub(super) fn take_off(runs: &mut [Run], cleanings: &mut Vec<Cleaning>) {
    let longest = runs.iter().map(Run::duration).fold(0.0, f64::max);
    if longest < real(MIN_PARTS) * PART {
        return;
    }
    let all: Vec<Vec<Piece>> = runs.iter().map(some_pieces).collect();
    let Some(rate) = Rate::of(runs, &all) else { return };
    let Rate { value, error, .. } = rate;
    let readings = runs.iter().flat_map(|run| run.tracks().windows(2));
    let mut intervals: Vec<f64> = readings.map(|pair| pair[1].t - pair[0].t).collect();
    let interval = median(&mut intervals).unwrap_or_default();
    let least = MIN_GAIN.max(MIN_INTERVALS * interval);
    let shows = value.abs() >= MIN_ERRORS * error && value.abs() * longest >= least;
    if !shows || !rate.leaves_less(runs, &all) {
        return;
    }
    for run in runs {
        let middle = middle(run);
        let Some(t) = run.poses().first().map(|pose| pose.t) else { continue };
        let gained = value * run.duration();
        for pose in run.poses_mut() {
            pose.t -= value * (pose.t - middle);
        }
        let finding = Finding::ClockRate { rate: value, gained };
        let (stream, count, run) = (Stream::Poses, run.poses().len(), run.id());
        cleanings.push(Cleaning { stream, finding, count, runs: 1, run, t });
    }
}

/// The middle of the poses of a run, s.
fn middle(run: &Run) -> f64 {
    let [first, .., last] = run.poses() else { return 0.0 };
    f64::midpoint(first.t, last.t)
}

/// Part of a run with a delay of its own.
struct Part {
    run: usize,
    /// Its middle, from that of the run, s.
    t: f64,
    /// Its delay, s.
    delay: f64,
}

impl Rate {
    /// By the turns of all runs; none where parts do not show their delays.
    fn of(runs: &[Run], all: &[Vec<Piece>]) -> Option<Self> {
        let parts = parts(runs, all);
        if parts.len() < MIN_PARTS {
            return None;
        }
        let tau = median(&mut parts.iter().map(|part| part.delay).collect::<Vec<_>>())?;
        let pairs = parts.iter().enumerate().flat_map(|(place, one)| {
            let later = parts[place + 1..].iter().filter(|other| other.run == one.run);
            later.map(move |other| (other.delay - one.delay) / (other.t - one.t))
        });
        let rate = median(&mut pairs.collect::<Vec<_>>())?;
        Self::fitted(runs, all, tau, rate)
    }

    /// Least squares from a delay, s, and a rate.
    fn fitted(runs: &[Run], all: &[Vec<Piece>], mut tau: f64, mut rate: f64) -> Option<Self> {
        let mut found = None;
        for _ in 0..ITERATIONS {
            let blocks = blocks(runs, all, tau, rate);
            if blocks.len() < MIN_BLOCKS {
                return None;
            }
            let (by_ways, _) = by_ways(&blocks)?;
            let sums: Vec<(Matrix4<f64>, Vector4<f64>)> =
                blocks.iter().map(|block| sums(block, &by_ways)).collect();
            let whole: Matrix4<f64> = sums.iter().map(|(matrix, _)| matrix).sum();
            let right: Vector4<f64> = sums.iter().map(|(_, right)| right).sum();
            let step = whole.try_inverse()? * right;
            // Without a block the step is another one.
            let moved = |(matrix, score): &(Matrix4<f64>, Vector4<f64>)| {
                let without = (whole - matrix).lu().solve(&(right - score));
                without.map_or(f64::INFINITY, |without| (without - step).w.powi(2))
            };
            let count = real(blocks.len());
            let squares: f64 = sums.iter().map(moved).sum();
            let error = (squares * (count - 1.0) / count).sqrt();
            tau += step.z;
            rate += step.w;
            found = (step.w.abs() < error).then_some(Self { tau, value: rate, error });
            if step.w.abs() < 1e-3 * error {
                break;
            }
        }
        found
    }

    /// Whether it leaves less of the turns than any one delay.
    fn leaves_less(&self, runs: &[Run], all: &[Vec<Piece>]) -> bool {
        let left = |tau: f64, rate: f64| Some(by_ways(&blocks(runs, all, tau, rate))?.1);
        let one_delay = (-ONE_DELAY_STEPS..=ONE_DELAY_STEPS)
            .filter_map(|step| left(self.tau + ONE_DELAY_STEP * f64::from(step), 0.0));
        let best = one_delay.fold(f64::INFINITY, f64::min);
        left(self.tau, self.value).is_some_and(|left| left < MAX_RESIDUAL_SHARE * best)
    }
}

/// b_l and b_r by least squares, and the mean square that they leave of the turns.
fn by_ways(blocks: &[Vec<Row>]) -> Option<(Vector2<f64>, f64)> {
    let (mut matrix, mut right) = (Matrix2::zeros(), Vector2::zeros());
    let rows = || blocks.iter().flatten();
    for row in rows() {
        matrix += row.ways * row.ways.transpose();
        right += row.ways * row.turn;
    }
    let by_ways = matrix.try_inverse()? * right;
    let squares: f64 = rows().map(|row| (row.turn - by_ways.dot(&row.ways)).powi(2)).sum();
    Some((by_ways, squares / real(rows().count())))
}

/// A piece at its delay.
struct Row {
    /// D_l and D_r, m.
    ways: Vector2<f64>,
    /// Their derivatives by the delay, m/s.
    later: Vector2<f64>,
    /// Time from the middle of the run, s.
    t: f64,
    /// Turn of the poses, rad.
    turn: f64,
}

/// The pieces of all runs in blocks of time.
fn blocks(runs: &[Run], all: &[Vec<Piece>], tau: f64, rate: f64) -> Vec<Vec<Row>> {
    let mut blocks = Vec::new();
    for (run, pieces) in runs.iter().zip(all) {
        let middle = middle(run);
        let of = |piece: &Piece| (piece.start / BLOCK).floor();
        for block in pieces.chunk_by(|a, b| of(a) == of(b)) {
            let row = |piece: &Piece| {
                let t = f64::midpoint(piece.start, piece.end) - middle;
                let [ways, later] = ways(run, piece, tau + rate * t)?;
                Some(Row { ways, later, t, turn: piece.turn })
            };
            let rows: Vec<Row> = block.iter().filter_map(row).collect();
            if !rows.is_empty() {
                blocks.push(rows);
            }
        }
    }
    blocks
}

/// Jᵀ J and Jᵀ r of a block, by b_l, b_r, τ and ρ.
fn sums(block: &[Row], by_ways: &Vector2<f64>) -> (Matrix4<f64>, Vector4<f64>) {
    let (mut matrix, mut right) = (Matrix4::zeros(), Vector4::zeros());
    for Row { ways, later, t, turn } in block {
        let later = by_ways.dot(later);
        let by = Vector4::new(ways.x, ways.y, later, later * t);
        matrix += by * by.transpose();
        right += by * (turn - by_ways.dot(ways));
    }
    (matrix, right)
}

/// The pieces of a run, some of very many.
fn some_pieces(run: &Run) -> Vec<Piece> {
    thinned(&pieces(run), MAX_PIECES).copied().collect()
}

/// Ways of both tracks in a piece at a delay, m, and their derivatives by the delay, m/s; none
/// where readings lack.
fn ways(run: &Run, piece: &Piece, delay: f64) -> Option<[Vector2<f64>; 2]> {
    let half = DELAY_STEP / 2.0;
    let is_covered =
        [delay - half, delay + half].iter().all(|delay| piece.is_covered(run.tracks(), *delay));
    let at = |delay: f64| {
        let ways = travelled(run.tracks(), piece.start, piece.end, delay);
        Vector2::new(ways.left, ways.right)
    };
    is_covered.then(|| [at(delay), (at(delay + half) - at(delay - half)) / (2.0 * half)])
}

/// Parts of the runs with the delay of the largest correlation of their turns.
fn parts(runs: &[Run], all: &[Vec<Piece>]) -> Vec<Part> {
    let long = |run: &&Run| run.duration() >= 2.0 * PART;
    let total: f64 = runs.iter().filter(long).map(|run| run.duration() / PART).sum();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let step = (total / real(MAX_PARTS)).ceil().max(1.0) as usize;
    let mut parts = Vec::new();
    for (index, (run, pieces)) in runs.iter().zip(all).enumerate() {
        if !long(&run) {
            continue;
        }
        let middle = middle(run);
        let cut = pieces.chunk_by(|a, b| (a.start / PART).floor() == (b.start / PART).floor());
        for part in cut.step_by(step).filter(|part| part.len() >= MIN_PIECES) {
            let before = parts.last().filter(|part: &&Part| part.run == index);
            let around = before.map_or(0.0, |part| part.delay);
            if let Some(delay) = delay_of(run, part, around) {
                let t = f64::midpoint(part[0].start, part[part.len() - 1].end) - middle;
                parts.push(Part { run: index, t, delay });
            }
        }
    }
    parts
}

/// The delay of these pieces, s, looked for around one; none where they do not follow, or where
/// it lies at an end of the search.
fn delay_of(run: &Run, pieces: &[Piece], around: f64) -> Option<f64> {
    let whole = std::slice::from_ref(run);
    let all = [pieces.to_vec()];
    let at = |step: i32| {
        let delay = around + DELAY_STEP * f64::from(step);
        (step, delay, Fits::of(whole, &all, delay, &|_, _, _| false))
    };
    let tried = DELAYS.map(at).filter(|(.., fits)| fits.count >= MIN_PIECES);
    let (step, delay, fits) =
        tried.max_by(|(.., a), (.., b)| a.turn.correlation().total_cmp(&b.turn.correlation()))?;
    let is_inside = step > *DELAYS.start() && step < *DELAYS.end();
    (is_inside && fits.turn.slope_where_correlated().is_some()).then_some(delay)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::UncheckedRun;
    use crate::sample::{PoseSample, TrackSample};
    use trackdyn_core::Pose;

    /// A run of 160 s of turns that change, of poses whose clock gains by a rate and is 0.2 s off
    /// in the middle.
    fn turning(rate: f64) -> Run {
        let difference = |t: f64| 0.6 * (0.9 * t).sin() + 0.4 * (0.37 * t + 1.0).sin();
        let reading = |k: u32| {
            let t = 0.02 * f64::from(k);
            let held = difference(t + 0.01);
            TrackSample { t, v_left: 0.5 - 0.5 * held, v_right: 0.5 + 0.5 * held }
        };
        let yaw = |t: f64| -0.6 / 0.9 * (0.9 * t).cos() - 0.4 / 0.37 * (0.37 * t + 1.0).cos();
        let pose = |k: u32| {
            let true_t = 0.1 * f64::from(k);
            let t = true_t + 0.2 + rate * (true_t - 80.0);
            PoseSample { t, pose: Pose::new(0.0, 0.0, yaw(true_t)) }
        };
        let tracks: Vec<TrackSample> = (0..=8000).map(reading).collect();
        let poses: Vec<PoseSample> = (5..=1590).map(pose).collect();
        let (tracks, poses) = (tracks.into(), poses.into());
        let rows = UncheckedRun { id: 0, tracks, poses, ..UncheckedRun::default() };
        Run::new(rows, &mut Vec::new())
    }

    #[test]
    fn a_clock_that_gains_is_set_back() {
        for rate in [0.01, -0.01, 1e-3] {
            let mut runs = [turning(rate)];
            let mut cleanings = Vec::new();
            take_off(&mut runs, &mut cleanings);
            let Some(Finding::ClockRate { rate: found, .. }) =
                cleanings.first().map(|of| of.finding)
            else {
                panic!("{rate}: {cleanings:?}")
            };
            // the stamps grow by 1 + ρ, of which ρ/(1 + ρ) of their own time is taken back
            assert!((found - rate / (1.0 + rate)).abs() < 2e-5, "{rate}: {found}");
            for (pose, k) in runs[0].poses().iter().zip(5_u32..) {
                let off = pose.t - 0.1 * f64::from(k) - 0.2;
                assert!(off.abs() < 0.01, "{rate}: {off} s at {k}");
            }
        }
    }

    #[test]
    fn a_clock_that_keeps_time_is_left() {
        let (mut runs, before) = ([turning(0.0)], turning(0.0));
        let mut cleanings = Vec::new();
        take_off(&mut runs, &mut cleanings);
        assert!(cleanings.is_empty(), "{cleanings:?}");
        assert_eq!(runs[0], before);
    }
}
