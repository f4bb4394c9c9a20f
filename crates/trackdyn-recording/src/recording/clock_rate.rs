//! Poses whose clock runs faster or slower than that of the tracks.
//!
//! # Law
//! turn = k D(τ + ρ (t − t̄)) over pieces of a quarter second, with D the way that the right track
//! ran more than the left one in the piece moved back by a delay: τ in the middle t̄ of each run,
//! growing by ρ. k, τ and ρ are least squares by Gauss-Newton steps. They begin with the delays of
//! the largest correlation in parts of the runs, and with the median of the slopes between these.
//!
//! Errors are those of blocks of time, so that slip that comes and goes counts. Where ρ shows and
//! makes clocks part by more than poses are known in time, stamps of poses are set back by
//! ρ (t − t̄).

use super::Run;
use super::finding::{Cleaning, Finding};
use super::motion::{DELAY_STEP, DELAYS, Fits, Piece, pieces};
use crate::hold::travelled;
use crate::sample::Stream;
use nalgebra::{Matrix3, Vector3};
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

/// Least time by which the clocks part within a run, s: a part of the time that poses are late.
const MIN_GAIN: f64 = 0.03;

/// The rate at which the clock of the poses gains on that of the tracks.
struct Rate {
    /// ρ, s per s.
    value: f64,
    /// Its standard error.
    error: f64,
}

/// Sets the stamps of poses back to the clock of the tracks; `cleanings` takes what was found.
pub(super) fn set_back(runs: &mut [Run], cleanings: &mut Vec<Cleaning>) {
    let longest = runs.iter().map(Run::duration).fold(0.0, f64::max);
    let Some(Rate { value, error }) = Rate::of(runs) else { return };
    if value.abs() < MIN_ERRORS * error || value.abs() * longest < MIN_GAIN {
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
    fn of(runs: &[Run]) -> Option<Self> {
        if runs.iter().all(|run| run.duration() < real(MIN_PARTS) * PART) {
            return None;
        }
        let all: Vec<Vec<Piece>> = runs.iter().map(thinned).collect();
        let parts = parts(runs, &all);
        if parts.len() < MIN_PARTS {
            return None;
        }
        let tau = median(&mut parts.iter().map(|part| part.delay).collect::<Vec<_>>())?;
        let pairs = parts.iter().enumerate().flat_map(|(place, one)| {
            let later = parts[place + 1..].iter().filter(|other| other.run == one.run);
            later.map(move |other| (other.delay - one.delay) / (other.t - one.t))
        });
        let rate = median(&mut pairs.collect::<Vec<_>>())?;
        Self::fitted(runs, &all, tau, rate)
    }

    /// Least squares from a delay, s, and a rate.
    fn fitted(runs: &[Run], all: &[Vec<Piece>], mut tau: f64, mut rate: f64) -> Option<Self> {
        let mut found = None;
        for _ in 0..ITERATIONS {
            let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
            let mut blocks: Vec<Vec<(Vector3<f64>, f64)>> = Vec::new();
            let (mut last_block, mut slope) = (None, [0.0; 2]);
            for (index, (run, pieces)) in runs.iter().zip(all).enumerate() {
                let middle = middle(run);
                for piece in pieces {
                    let t = f64::midpoint(piece.start, piece.end) - middle;
                    let Some([by, later]) = differences(run, piece, tau + rate * t) else {
                        continue;
                    };
                    slope = [slope[0] + by * by, slope[1] + by * piece.turn];
                    let block = (index, (piece.start / BLOCK).floor());
                    if last_block != Some(block) {
                        blocks.push(Vec::new());
                        last_block = Some(block);
                    }
                    let row = (Vector3::new(by, later, later * t), piece.turn);
                    blocks.last_mut()?.push(row);
                }
            }
            // k as it is: the derivatives by the delay go with it
            let k = slope[1] / slope[0];
            let scaled = |row: &Vector3<f64>| Vector3::new(row.x, k * row.y, k * row.z);
            for (row, turn) in blocks.iter().flatten() {
                let row = scaled(row);
                matrix += row * row.transpose();
                right += row * (turn - k * row.x);
            }
            let inverse = matrix.try_inverse()?;
            let step = inverse * right;
            tau += step.y;
            rate += step.z;
            let score = |block: &Vec<(Vector3<f64>, f64)>| -> Vector3<f64> {
                let of = |(row, turn): &(Vector3<f64>, f64)| {
                    let row = scaled(row);
                    row * (turn - k * row.x - row.dot(&step))
                };
                block.iter().map(of).sum()
            };
            let count = real(blocks.len());
            let squares: f64 = blocks.iter().map(|block| (inverse * score(block)).z.powi(2)).sum();
            let error = (squares * count / (count - 1.0)).sqrt();
            found = (blocks.len() >= MIN_BLOCKS).then_some(Self { value: rate, error });
            if step.z.abs() < 1e-3 * error {
                break;
            }
        }
        found.filter(|found| found.value.is_finite() && found.error.is_finite())
    }
}

/// The pieces of a run, some of very many.
fn thinned(run: &Run) -> Vec<Piece> {
    let pieces = pieces(run);
    let step = pieces.len().div_ceil(MAX_PIECES).max(1);
    pieces.into_iter().step_by(step).collect()
}

/// D in a piece at a delay, m, and its derivative by the delay, m/s; none where readings lack.
fn differences(run: &Run, piece: &Piece, delay: f64) -> Option<[f64; 2]> {
    let [first, .., last] = run.tracks() else { return None };
    let half = DELAY_STEP / 2.0;
    let is_covered = piece.start - delay - half >= first.t && piece.end - delay + half <= last.t;
    let at = |delay: f64| {
        let ways = travelled(run.tracks(), piece.start, piece.end, delay);
        ways.right - ways.left
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
            set_back(&mut runs, &mut cleanings);
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
        set_back(&mut runs, &mut cleanings);
        assert!(cleanings.is_empty(), "{cleanings:?}");
        assert_eq!(runs[0], before);
    }
}
