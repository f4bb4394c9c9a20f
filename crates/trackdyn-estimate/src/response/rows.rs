//! Turns of the poses beside ways of the tracks at several delays.

use super::{DURATION, Fit, REACH, STEP};
use crate::Extent;
use crate::gaps::Gaps;
use crate::gauss_newton::Loss;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use trackdyn_core::robust::{deviation_about_zero, usual_interval};
use trackdyn_core::{PerSide, Side, real};
use trackdyn_recording::hold::holding;
use trackdyn_recording::{Recording, Run, TrackSample};

/// Shortest time over which turning is compared, s: that of segments.
const MIN_DURATION: f64 = 0.27;

/// Time from one row to the next, s: rows overlap.
const STRIDE: f64 = 0.27;

/// Longest time in place of the one that is wanted: gaps of the poses are not bridged.
const MAX_STRETCH: f64 = 1.3;

/// Rounds of reweighting.
const ROUNDS: usize = 10;

/// Most rows: a long log says enough by a part of them.
const MAX_ROWS: usize = 30_000;

/// By which delays turns are fitted.
#[derive(Clone, Copy)]
pub(super) enum Delays {
    /// By one, and by how it is shifted.
    Shifted,
    /// By so many steps either way, each of so many of the steps of rows.
    Every { half: usize, step: usize },
}

impl Delays {
    /// One delay.
    pub(super) const ONE: Self = Self::Every { half: 0, step: 1 };

    /// Number of unknowns, the last of which are a and b.
    fn count(self) -> usize {
        match self {
            Self::Shifted => 4,
            Self::Every { half, .. } => 2 * half + 3,
        }
    }
}

/// Turns over times of one length.
pub(super) struct Rows {
    /// Δψ, rad.
    turns: Vec<f64>,
    /// D at the delays −`REACH` to `REACH`, m, F, m, and Δt, s.
    ways: Vec<[f64; 2 * REACH + 3]>,
    /// Block of each row, ascending.
    blocks: Vec<usize>,
}

impl Rows {
    /// The rows of a recording over times of at least `duration`, s.
    pub(super) fn of(recording: &Recording, blocks: &[Extent], tau: f64, duration: f64) -> Self {
        let mut rows = Self { turns: Vec::new(), ways: Vec::new(), blocks: Vec::new() };
        let total: f64 = blocks.iter().map(|block| block.duration).sum();
        let stride = STRIDE.max(total / real(MAX_ROWS));
        for (index, run) in recording.runs().iter().enumerate() {
            rows.add(run, index, blocks, tau, duration.max(MIN_DURATION), stride);
        }
        rows
    }

    fn add(
        &mut self,
        run: &Run,
        index: usize,
        blocks: &[Extent],
        tau: f64,
        duration: f64,
        stride: f64,
    ) {
        let (poses, ways) = (run.poses(), Ways::of(run.tracks()));
        let gaps = Gaps::of(run.tracks());
        let interval = usual_interval(poses.iter().map(|pose| pose.t));
        let longest = MAX_STRETCH * duration.max(interval) + interval;
        let [first, .., last] = run.tracks() else { return };
        let reach = STEP * real(REACH);
        let of_run = |block: &&Extent| block.run == index;
        let Some(begins) = blocks.iter().position(|block| block.run == index) else { return };
        let own: Vec<&Extent> = blocks[begins..].iter().take_while(of_run).collect();
        let mut next = f64::NEG_INFINITY;
        for pose in poses {
            if pose.t < next {
                continue;
            }
            let after = poses.partition_point(|other| other.t < pose.t + duration - 1e-9);
            let Some(end) = poses.get(after) else { break };
            next = pose.t + stride;
            let [from, until] = [pose.t - tau - reach, end.t - tau + reach];
            let is_covered = from >= first.t && until <= last.t && !gaps.meet(from, until);
            if !is_covered || end.t - pose.t > longest {
                continue;
            }
            let mut row = [end.t - pose.t; 2 * REACH + 3];
            let both = ways.between(pose.t - tau, end.t - tau);
            row[2 * REACH + 1] = f64::midpoint(both.left, both.right);
            for (k, way) in row.iter_mut().take(2 * REACH + 1).enumerate() {
                let delay = tau + STEP * (real(k) - real(REACH));
                let both = ways.between(pose.t - delay, end.t - delay);
                *way = both.right - both.left;
            }
            let block = own.partition_point(|block| block.start <= pose.t).max(1) - 1;
            self.turns.push(end.pose.yaw - pose.pose.yaw);
            self.ways.push(row);
            self.blocks.push(begins + block);
        }
    }

    /// Part of the squares of D that neither the mean way of both tracks nor time explains: what
    /// tells turning from sides with different factors.
    pub(super) fn own_share(&self) -> f64 {
        let columns = self.ways.iter().map(|row| {
            let [.., both, time] = *row;
            Vector3::new(row[REACH], both, time)
        });
        let products = columns.fold(Matrix3::zeros(), |sum, row| sum + row * row.transpose());
        let others = products.fixed_view::<2, 2>(1, 1).into_owned();
        let beside = products.fixed_view::<2, 1>(1, 0).into_owned();
        let Some(inverse) = others.try_inverse() else { return 0.0 };
        // 1 − dᵀX (XᵀX)⁻¹ Xᵀd/(dᵀd)
        let explained = (beside.transpose() * inverse * beside)[0] / products[(0, 0)];
        if explained.is_finite() { (1.0 - explained).max(0.0) } else { 0.0 }
    }

    /// What a turn is fitted by.
    fn row(&self, k: usize, delays: Delays) -> DVector<f64> {
        let ways = &self.ways[k];
        let beside = &ways[2 * REACH + 1..];
        let by_delays: Vec<f64> = match delays {
            Delays::Shifted => vec![ways[REACH], ways[REACH + 1] - ways[REACH - 1]],
            Delays::Every { half, step } => {
                (0..=2 * half).map(|j| ways[REACH + j * step - half * step]).collect()
            }
        };
        DVector::from_iterator(delays.count(), by_delays.iter().chain(beside).copied())
    }

    /// Least squares by these weights.
    pub(super) fn fit_weighted(&self, delays: Delays, weights: &[f64]) -> Option<Fit> {
        let row = |k: usize| self.row(k, delays);
        Fit::of(&self.parts(delays.count(), &row, weights), weights.to_vec())
    }

    /// Robust least squares, with the fits without each block; none where rows are few or the
    /// delays are not told apart.
    pub(super) fn fit(&self, delays: Delays) -> Option<Fit> {
        let count = delays.count();
        let row = |k: usize| self.row(k, delays);
        if self.turns.len() < 4 * count {
            return None;
        }
        let mut weights = vec![1.0; self.turns.len()];
        let mut parts = self.parts(count, &row, &weights);
        for _ in 0..ROUNDS {
            let (matrix, right) = sum(&parts)?;
            let found = matrix.cholesky()?.solve(&right);
            let left: Vec<f64> =
                (0..self.turns.len()).map(|k| self.turns[k] - row(k).dot(&found)).collect();
            let spread = deviation_about_zero(&mut left.clone())?.max(f64::MIN_POSITIVE);
            weights = left.iter().map(|left| Loss::Huber.weight(left / spread)).collect();
            parts = self.parts(count, &row, &weights);
        }
        Fit::of(&parts, weights)
    }

    /// The normal equations of each block.
    fn parts(
        &self,
        count: usize,
        row: &dyn Fn(usize) -> DVector<f64>,
        weights: &[f64],
    ) -> Vec<Part> {
        let mut parts: Vec<Part> = Vec::new();
        for (k, &block) in self.blocks.iter().enumerate() {
            if parts.last().is_none_or(|part| part.block != block) {
                let (matrix, right) = (DMatrix::zeros(count, count), DVector::zeros(count));
                parts.push(Part { block, matrix, right, squares: 0.0 });
            }
            let (row, turn) = (row(k), self.turns[k]);
            if let Some(part) = parts.last_mut() {
                part.matrix.ger(weights[k], &row, &row, 1.0);
                part.right.axpy(weights[k] * turn, &row, 1.0);
                part.squares += weights[k] * turn * turn;
            }
        }
        parts
    }
}

/// The normal equations of a block, and the weighted squares of its turns.
pub(super) struct Part {
    pub(super) block: usize,
    pub(super) matrix: DMatrix<f64>,
    pub(super) right: DVector<f64>,
    pub(super) squares: f64,
}

/// The normal equations of all blocks; none without any.
pub(super) fn sum(parts: &[Part]) -> Option<(DMatrix<f64>, DVector<f64>)> {
    let (first, others) = parts.split_first()?;
    let start = (first.matrix.clone(), first.right.clone());
    Some(others.iter().fold(start, |(a, b), part| (a + &part.matrix, b + &part.right)))
}

/// Ways of both tracks from the first reading on.
struct Ways<'a> {
    tracks: &'a [TrackSample],
    /// Up to each reading, m.
    sums: Vec<PerSide<f64>>,
}

impl<'a> Ways<'a> {
    fn of(tracks: &'a [TrackSample]) -> Self {
        let mut sum = PerSide::new(0.0, 0.0);
        let mut sums = Vec::with_capacity(tracks.len());
        for (index, reading) in tracks.iter().enumerate() {
            sums.push(sum);
            let until = tracks.get(index + 1).map_or(reading.t, |next| next.t);
            let duration = until - reading.t;
            sum = PerSide::from_fn(|side: Side| sum[side] + duration * reading.speeds()[side]);
        }
        Self { tracks, sums }
    }

    fn at(&self, t: f64) -> PerSide<f64> {
        let index = holding(self.tracks, t).unwrap_or(0);
        let reading = self.tracks[index];
        PerSide::from_fn(|side: Side| {
            self.sums[index][side] + (t - reading.t) * reading.speeds()[side]
        })
    }

    fn between(&self, from: f64, until: f64) -> PerSide<f64> {
        let (start, end) = (self.at(from), self.at(until));
        PerSide::from_fn(|side: Side| end[side] - start[side])
    }
}

/// A run with the track speeds Σⱼ wⱼ V(t − jδ), over the time that each reading holds.
pub(super) fn weighted(run: &Run, weights: &[f64], step: f64) -> Run {
    let tracks = run.tracks();
    let (ways, gaps) = (Ways::of(tracks), Gaps::of(tracks));
    let half = real(weights.len() / 2);
    let reach = step * half;
    let mut rows = run.clone().into_rows();
    let [first, .., last] = tracks else { return run.clone() };
    let mut kept = Vec::with_capacity(tracks.len());
    for (index, pair) in tracks.windows(2).enumerate() {
        let [from, until] = [pair[0].t - reach, pair[1].t + reach];
        if from < first.t || until > last.t || gaps.meet(from, until) {
            continue;
        }
        let mut speeds = PerSide::new(0.0, 0.0);
        for (j, weight) in weights.iter().enumerate() {
            let delay = step * (real(j) - half);
            let way = ways.between(pair[0].t - delay, pair[1].t - delay);
            let share = weight / (pair[1].t - pair[0].t);
            speeds = PerSide::from_fn(|side: Side| speeds[side] + share * way[side]);
        }
        let reading = &mut rows.tracks.samples[index];
        (reading.v_left, reading.v_right) = (speeds.left, speeds.right);
        kept.push(index);
    }
    rows.tracks = rows.tracks.part(&kept);
    Run::new(rows, &mut Vec::new())
}

const _: () = assert!(DURATION > MIN_DURATION);
