//! Whether joints move alike.
//!
//! # Law
//! Two wheels of one side turn alike where the squares of the differences of their speeds are at
//! most a fifth of the mean of the squares, and their sizes differ by at most a third. Speeds are
//! means over some readings, and are limited to what the joints usually do: wrong readings and
//! starts of an encoder must not decide.

use super::turns;
use crate::rosbag::date::Received;
use trackdyn_core::real;
use trackdyn_core::robust::quantile;

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

/// Least speed of a joint whose ratio to another one counts, in root mean squares of its speeds.
const MIN_SPEED: f64 = 0.5;

/// Fewest means whose ratio tells one that holds all along.
const MIN_RATIOS: usize = 20;

/// Largest ratio of the quartiles of such ratios.
const MAX_QUARTILE_RATIO: f64 = 1.05;

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

/// Speed of a joint per speed of another by their means, where it is one all along: wheels of other
/// sizes, or gears. Slip, and readings that are wrong for a while, come and go.
pub(super) fn ratio_all_along(a: &[f64], b: &[f64]) -> Option<f64> {
    let both = || a.iter().zip(b).filter(|(a, b)| a.is_finite() && b.is_finite());
    let size = (both().map(|(_, b)| b * b).sum::<f64>() / real(both().count().max(1))).sqrt();
    let is_fast = |(_, b): &(&f64, &f64)| b.abs() >= MIN_SPEED * size && size > 0.0;
    let mut ratios: Vec<f64> = both().filter(is_fast).map(|(a, b)| a / b).collect();
    if ratios.len() < MIN_RATIOS {
        return None;
    }
    let [lower, ratio, upper] = [0.25, 0.5, 0.75].map(|share| quantile(&mut ratios, share));
    let (lower, ratio, upper) = (lower?, ratio?, upper?);
    (lower > 0.0 && upper <= MAX_QUARTILE_RATIO * lower).then_some(ratio)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ratio_is_one_that_holds_all_along() {
        let b: Vec<f64> = (0..200).map(|k| (0.1 * f64::from(k)).sin()).collect();
        let times = |of: &dyn Fn(usize) -> f64| -> Vec<f64> {
            b.iter().enumerate().map(|(k, b)| of(k) * b).collect()
        };
        let near = |found: Option<f64>, ratio: f64| {
            found.is_some_and(|found| (found - ratio).abs() < 1e-9)
        };
        assert!(near(ratio_all_along(&times(&|_| 1.1), &b), 1.1));
        // a wheel that slips in one of ten
        let slips = times(&|k| if k % 10 == 0 { 1.5 } else { 1.0 });
        assert!(near(ratio_all_along(&slips, &b), 1.0));
        let often = times(&|k| if k % 2 == 0 { 1.2 } else { 1.0 });
        assert_eq!(ratio_all_along(&often, &b), None);
        assert_eq!(ratio_all_along(&[], &[]), None);
        assert_eq!(ratio_all_along(&[0.0; 50], &[0.0; 50]), None);
    }
}
