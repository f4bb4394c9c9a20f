//! How the turning of the poses follows the track speeds over time.
//!
//! # Law
//! Δψᵢ = Σⱼ cⱼ Dᵢ(τ + jδ) + a Fᵢ(τ) + b Δtᵢ + noise over times Δt of two seconds, where Dᵢ(τ) = ∫
//! (Vᵣ − Vₗ) dt and Fᵢ(τ) = ∫ (Vᵣ + Vₗ)/2 dt over the time moved back by τ, and jδ reaches three
//! seconds either way; a takes up sides whose α differ. Any element between track speeds and poses
//! that passes a constant speed unchanged leaves Σ cⱼ = 1/(x_r − x_l): a drivetrain that lags
//! behind commands, a filter of the poses or of the speeds, stamps that jitter. A fit by a delay
//! alone takes what these leave for slip: with one c₀, changes of speed that the poses show
//! smoothed make x_r − x_l too large, and speeds that are smoothed make it too small. The log has
//! such a response where both fits disagree and the delays predict blocks that they were not fitted
//! to. Track speeds that are weighted by it, Ṽ(t) = Σⱼ cⱼ V(t − jδ)/Σⱼ cⱼ, are those that the poses
//! follow at once; segments are then as long as the times Δt, over which the response was found.
//!
//! # Assumes
//! The response does not change within the log and hardly with the speed. A response beyond three
//! seconds is missed; the interval includes what half the reach misses. What a response leaves
//! beyond noise comes from no filter, but for example from tracks whose acceleration is limited.
//! The interval includes it, and where it is large nothing is given.
//!
//! # Sources
//! Distributed lags and their long-run multiplier: Greene, Econometric Analysis, 7th ed., chapter
//! 20; specification tests by two estimates: Hausman, Econometrica 46(6), 1978.

mod rows;

use crate::noise::{self, of_encoders};
use crate::{Blocks, Extent, Interval};
use nalgebra::{DMatrix, DVector};
use rows::{Delays, Part, Rows, weighted};
use trackdyn_core::{PerSide, real};
use trackdyn_recording::Recording;

/// Times over which turning is compared, s.
pub const DURATION: f64 = 2.0;

/// Step of the delays, s, and how many of them lie on either side.
const STEP: f64 = 0.5;
const REACH: usize = 6;

/// Stride through the delays for short logs: every second one.
const COARSE_STEP: usize = 2;

/// Smallest significance of a response, in standard errors: of the difference of both distances,
/// and of what the delays gain in blocks that they were not fitted to. Chance reaches it in fewer
/// than one of a thousand logs.
const MIN_ERRORS: f64 = 4.0;

/// Smallest difference of both distances, as share of one: a response that moves it by less does
/// no harm.
const MIN_DIFFERENCE: f64 = 0.005;

/// Part of the squares of the turning that a response may leave beyond the noise of poses and
/// stamps: a tenth of the turning. Rough ground leaves less; a robot that follows in another way
/// than through a filter leaves more.
const MAX_LEFT: f64 = 0.01;

/// [`MAX_LEFT`] where the speeds are commands and delays gain by so many standard errors. Tracks
/// whose acceleration is limited leave more, and then x_r − x_l is off by some percent.
const MAX_LEFT_BY_COMMANDS: f64 = 0.002;
const MIN_ERRORS_WHERE_LEFT: f64 = 2.5;

/// Least standard error of a distance by commands, as share of it. Under limits of acceleration,
/// steps of each size have a response of their own, and one response for all leaves some tenths of
/// a percent.
const ERROR_BY_COMMANDS: f64 = 0.002;

/// Least part of the squares of D that is its own: with less, noise counts tenfold.
const MIN_OWN_SHARE: f64 = 0.01;

/// Shortest block, s: longer than the times that are compared.
const MIN_BLOCK: f64 = 1.5 * DURATION;

/// Fewest blocks: of fewer, the scatter is no error.
const MIN_BLOCKS: usize = 9;

/// Blocks per unknown from which on all delays are free.
const BLOCKS_PER_UNKNOWN: usize = 2;

/// How poses follow the track speeds.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// x_r − x_l over seconds, m: for any response where delays gain, else by a delay alone.
    pub gap: Interval,
    /// x_r − x_l by a delay alone over the times of usual segments, m.
    pub gap_at_once: f64,
    /// Part of the turning that is left, in its root mean square, where the poses follow in another
    /// way than through a filter.
    pub left: Option<f64>,
    /// Weights of the delays, from the earliest on, where poses do not follow at once, and the step
    /// of the delays, s; the sum of the weights is 1.
    weights: Option<(Vec<f64>, f64)>,
}

impl Response {
    /// How the poses of a recording follow; none where it is too short to tell, or turns so alike
    /// all the time that sides with different factors would turn it as well.
    pub fn of(recording: &Recording, tau: f64) -> Option<Self> {
        let blocks = blocks(recording);
        let over = |duration: f64| Rows::of(recording, &blocks, tau, duration);
        let (long, short) = (over(DURATION), over(0.0));
        if long.own_share() < MIN_OWN_SHARE {
            return None;
        }
        let at_once = short.fit(Delays::ONE)?;
        let count = at_once.blocks.len();
        if count < MIN_BLOCKS {
            return None;
        }
        let step = if count < BLOCKS_PER_UNKNOWN * (2 * REACH + 2) { COARSE_STEP } else { 1 };
        let within = |reach: usize| long.fit(Delays::Every { half: reach / step, step });
        let [free, half, delay_alone] = [within(REACH)?, within(REACH / 2)?, within(0)?];
        let shifted = long.fit_weighted(Delays::Shifted, &free.weights)?;
        let gap_at_once = 1.0 / at_once.sum();
        let differences: Option<Vec<f64>> = free
            .blocks
            .iter()
            .map(|block| Some(1.0 / block.sum() - 1.0 / at_once.without(block.index)?))
            .collect();
        let (gap, of_delay) = (free.gap()?, delay_alone.gap()?);
        let difference = Interval::of_jackknife(gap.value - gap_at_once, &differences?)?;
        let off = difference.value.abs();
        let (gain, by_noise) = (gain(&shifted, &free), at_once.mean_left()[0]);
        let [all_left, turning] = free.mean_left();
        // The noise of poses and of their stamps is as large over a short time.
        let beyond = ((all_left - by_noise) / turning).max(0.0);
        let gains = gain > MIN_ERRORS_WHERE_LEFT;
        let are_held = are_held(recording);
        let is_left = beyond > MAX_LEFT && (gains || are_held)
            || beyond > MAX_LEFT_BY_COMMANDS && gains && are_held;
        let left = is_left.then(|| beyond.sqrt());
        let is_sure = off > MIN_ERRORS * difference.deviation
            || gain > MIN_ERRORS && off > difference.deviation;
        let shows = is_sure && off > MIN_DIFFERENCE * gap.value;
        if !shows || gap.low <= 0.0 {
            let gap = if gain > MIN_ERRORS && gap.low > 0.0 { gap } else { of_delay };
            return Some(Self { gap, gap_at_once, left, weights: None });
        }
        let missed = 1.0 / half.sum() - gap.value;
        // What is left may go with the turning.
        let share = beyond.max(if are_held { ERROR_BY_COMMANDS } else { 0.0 });
        let deviation = gap.deviation.hypot(missed).hypot(share * gap.value);
        let weights = free.coefficients.iter().map(|c| c / free.sum()).collect();
        Some(Self {
            gap: Interval::new(gap.value, deviation, free.blocks.len(), 1),
            gap_at_once,
            left,
            weights: Some((weights, STEP * real(step))),
        })
    }

    /// Time over which segments show what this response foretells, s.
    pub fn segment_duration(&self) -> f64 {
        let step = self.weights.as_ref().map_or(STEP, |(_, step)| *step);
        DURATION * STEP / step
    }

    /// Whether the poses follow the track speeds at once, but for a delay.
    pub fn is_at_once(&self) -> bool {
        self.weights.is_none()
    }

    /// The recording with the track speeds that the poses follow at once; none where these are its
    /// own. Readings near the ends of a run and near gaps, whose response is not known, are left
    /// out.
    pub fn applied(&self, recording: &Recording) -> Option<Recording> {
        let (weights, step) = self.weights.as_ref()?;
        let runs = recording.runs().iter().map(|run| weighted(run, weights, *step));
        Some(recording.with_runs(runs.filter(|run| run.tracks().len() > 1).collect()))
    }

    /// Standard deviation of a relative scale error that is common to all turning. It widens the
    /// interval of a distance of the ICRs by the track speeds as measured, `gap` with its standard
    /// `deviation` (m), until it reaches the distance over seconds and is as wide as its interval.
    pub fn scale_deviation(&self, gap: f64, deviation: f64) -> f64 {
        let off = (gap - self.gap.value) / 2.0;
        let open = if self.is_at_once() { 0.0 } else { self.gap.deviation };
        let more = (open.powi(2) - deviation.powi(2)).max(0.0).sqrt();
        off.hypot(more) / gap
    }
}

/// Gain of the delays over one that is shifted, in blocks that they were not fitted to: by the
/// logarithm of what is left, in its standard errors.
fn gain(one: &Fit, several: &Fit) -> f64 {
    let pairs = one.blocks.iter().zip(&several.blocks);
    let gains: Vec<f64> = pairs
        .filter(|(one, several)| one.left > 0.0 && several.left > 0.0)
        .map(|(one, several)| (one.left / several.left).ln())
        .collect();
    let count = real(gains.len());
    let mean = gains.iter().sum::<f64>() / count;
    let scatter: f64 = gains.iter().map(|gain| (gain - mean).powi(2)).sum();
    mean / (scatter / (count * (count - 1.0))).sqrt()
}

/// Whether the speeds of both sides are commands: they are held for longer than a measured speed.
fn are_held(recording: &Recording) -> bool {
    let PerSide { left, right } = of_encoders(recording, &noise::Settings::default());
    left.is_none() && right.is_none()
}

/// Parts that count as independent: of many runs these, else pieces that are long against the
/// times that are compared.
fn blocks(recording: &Recording) -> Vec<Extent> {
    let extents = recording.runs().iter().enumerate().filter_map(|(run, of)| {
        let start = of.poses().first()?.t;
        let duration = of.poses().last()?.t - start;
        Some(Extent { run, start, duration })
    });
    let extents: Vec<Extent> = extents.collect();
    let total: f64 = extents.iter().map(|extent| extent.duration).sum();
    let piece = (total / real(2 * Blocks::MIN_WHOLE_RUNS)).max(MIN_BLOCK);
    extents
        .into_iter()
        .flat_map(|Extent { run, start, duration }| {
            let pieces = real(whole(duration / piece).max(1));
            let length = duration / pieces;
            let starts = (0..whole(pieces)).map(move |k| start + real(k) * length);
            starts.map(move |start| Extent { run, start, duration: length })
        })
        .collect()
}

/// A number of pieces.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive, small")]
fn whole(pieces: f64) -> usize {
    pieces.round() as usize
}

/// Coefficients, and what comes of leaving out each block.
struct Fit {
    coefficients: Vec<f64>,
    /// Weights of the rows.
    weights: Vec<f64>,
    blocks: Vec<Without>,
}

/// A fit without a block.
struct Without {
    /// Its place in the list of blocks.
    index: usize,
    coefficients: Vec<f64>,
    /// Sums of the weighted squares of the block, and of those that this fit leaves.
    squares: f64,
    left: f64,
}

impl Without {
    fn sum(&self) -> f64 {
        self.coefficients.iter().sum()
    }
}

impl Fit {
    /// The solution of normal equations whose last unknowns are a and b, given those of each block.
    fn of(parts: &[Part], weights: Vec<f64>) -> Option<Self> {
        let (matrix, right) = rows::sum(parts)?;
        let count = right.len();
        let solved =
            |matrix: DMatrix<f64>, right: &DVector<f64>| Some(matrix.cholesky()?.solve(right));
        let coefficients = |of: &DVector<f64>| of.iter().take(count - 2).copied().collect();
        let all = solved(matrix.clone(), &right)?;
        let blocks: Option<Vec<Without>> = parts
            .iter()
            .map(|part| {
                let found = solved(&matrix - &part.matrix, &(&right - &part.right))?;
                // Σ w (y − xᵀc)²
                let explained = found.dot(&(&part.matrix * &found)) - 2.0 * found.dot(&part.right);
                let left = part.squares + explained;
                Some(Without {
                    index: part.block,
                    coefficients: coefficients(&found),
                    squares: part.squares,
                    left,
                })
            })
            .collect();
        let fit = Self { coefficients: coefficients(&all), weights, blocks: blocks? };
        (fit.sum() > 0.0).then_some(fit)
    }

    fn sum(&self) -> f64 {
        self.coefficients.iter().sum()
    }

    /// Means of the weighted squares that are left in blocks that were not fitted, and of those of
    /// the turns, rad².
    fn mean_left(&self) -> [f64; 2] {
        let rows: f64 = self.weights.iter().sum();
        let sums = self
            .blocks
            .iter()
            .fold([0.0; 2], |[left, all], block| [left + block.left, all + block.squares]);
        sums.map(|sum| sum / rows)
    }

    fn gap(&self) -> Option<Interval> {
        let without: Vec<f64> = self.blocks.iter().map(|block| 1.0 / block.sum()).collect();
        Interval::of_jackknife(1.0 / self.sum(), &without)
    }

    /// The sum without a block.
    fn without(&self, index: usize) -> Option<f64> {
        let place = self.blocks.binary_search_by_key(&index, |block| block.index).ok()?;
        Some(self.blocks[place].sum())
    }
}
