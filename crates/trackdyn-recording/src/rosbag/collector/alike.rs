//! Whether joints move alike.
//!
//! # Law
//! Two wheels of one side turn alike where the squares of the differences of their speeds are at
//! most a fifth of the mean of the squares, and their sizes differ by at most a third. Speeds are
//! means over some readings, and are limited to what the joints usually do: wrong readings and
//! starts of an encoder must not decide.

use super::turns;
use crate::rosbag::date::Received;

/// Largest ratio of Σ(a − b)² to (Σa² + Σb²)/2.
const MAX_DIFFERENCE: f64 = 0.2;

/// Largest ratio of √Σa² to √Σb².
const MAX_SIZE_RATIO: f64 = 4.0 / 3.0;

/// Number of means that a recording gives.
const MEANS: usize = 1000;

/// Fewest readings in a mean.
const MIN_READINGS: usize = 5;

/// Largest speed that counts, in 90 % quantiles of the speeds that are not zero.
const LIMIT: f64 = 1.5;

/// Correlation about zero of joints that go by a fixed ratio.
const MIN_CORRELATION: f64 = 0.98;

/// How two joints move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Likeness {
    /// Alike.
    Alike,
    /// Alike, the second one with the opposite sign.
    Reversed,
    /// Otherwise.
    Apart,
}

/// Speeds of a joint by the time of their logging, rad/s: its velocities, or the quotients of its
/// positions. Numbers that are not finite are left out.
pub(super) fn speeds(signals: &[Received<[f64; 2]>], are_positions: bool) -> Vec<(i64, f64)> {
    let value = |one: &Received<[f64; 2]>| one.value[usize::from(!are_positions)];
    let finite = signals.iter().filter(|one| value(one).is_finite());
    if !are_positions {
        return finite.map(|one| (one.log_ns, value(one))).collect();
    }
    let mut finite: Vec<(i64, f64)> = finite.map(|one| (one.log_ns, value(one))).collect();
    // What is to be said of wraps is said when the positions are used, also why they cannot be.
    let _ = turns::unwrap("", &mut finite, |_| 0.0);
    let steps = finite.windows(2).filter(|pair| pair[1].0 > pair[0].0);
    steps
        .map(|pair| {
            let interval = crate::rosbag::date::seconds(pair[0].0, pair[1].0);
            (pair[0].0, (pair[1].1 - pair[0].1) / interval)
        })
        .collect()
}

/// Times at which the means begin, from the joint that is read most often.
pub(super) fn edges<'a>(all: impl Iterator<Item = &'a Vec<(i64, f64)>>) -> Vec<i64> {
    let Some(most) = all.max_by_key(|speeds| speeds.len()) else { return Vec::new() };
    let step = most.len().div_ceil(MEANS).max(MIN_READINGS);
    let mut edges: Vec<i64> = most.iter().step_by(step).map(|(time, _)| *time).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// Means of the limited speeds from each edge to the next; NaN where there is no reading.
pub(super) fn means(speeds: &[(i64, f64)], edges: &[i64]) -> Vec<f64> {
    let mut sizes: Vec<f64> =
        speeds.iter().map(|(_, speed)| speed.abs()).filter(|size| *size > 0.0).collect();
    sizes.sort_by(f64::total_cmp);
    let limit = LIMIT * sizes.get(sizes.len().saturating_sub(1) * 9 / 10).copied().unwrap_or(0.0);
    let mut sums = vec![(0.0, 0.0); edges.len()];
    for (time, speed) in speeds {
        let Some(at) = edges.partition_point(|edge| edge <= time).checked_sub(1) else { continue };
        sums[at].0 += speed.clamp(-limit, limit);
        sums[at].1 += 1.0;
    }
    sums.into_iter().map(|(sum, count)| sum / count).collect()
}

/// How two joints move by their means.
pub(super) fn likeness(a: &[f64], b: &[f64]) -> Likeness {
    let (mut aa, mut bb, mut ab) = (0.0, 0.0, 0.0);
    for (a, b) in a.iter().zip(b).filter(|(a, b)| a.is_finite() && b.is_finite()) {
        aa += a * a;
        bb += b * b;
        ab += a * b;
    }
    let size_ratio = (aa / bb).sqrt();
    // Σ(a ∓ b)² = Σa² + Σb² ∓ 2 Σab
    let difference = |sign: f64| (aa + bb - 2.0 * sign * ab) / (0.5 * (aa + bb));
    if !(1.0 / MAX_SIZE_RATIO..=MAX_SIZE_RATIO).contains(&size_ratio) {
        // Joints that both stand move alike.
        return if aa + bb == 0.0 { Likeness::Alike } else { Likeness::Apart };
    }
    if difference(1.0) <= MAX_DIFFERENCE {
        Likeness::Alike
    } else if difference(-1.0) <= MAX_DIFFERENCE {
        Likeness::Reversed
    } else {
        Likeness::Apart
    }
}

/// Speed of a joint per speed of another by their means, where they go by a fixed ratio.
pub(super) fn ratio(a: &[f64], b: &[f64]) -> Option<f64> {
    let both = || a.iter().zip(b).filter(|(a, b)| a.is_finite() && b.is_finite());
    let sum = |of: fn(f64, f64) -> f64| both().map(|(a, b)| of(*a, *b)).sum::<f64>();
    let (aa, bb, ab) = (sum(|a, _| a * a), sum(|_, b| b * b), sum(|a, b| a * b));
    (ab > MIN_CORRELATION * (aa * bb).sqrt() && bb > 0.0).then(|| (aa / bb).sqrt())
}
