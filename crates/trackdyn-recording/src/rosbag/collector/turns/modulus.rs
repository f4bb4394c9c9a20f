//! The modulus of the positions of a joint: the angle after which its reports begin anew.
//!
//! # Law
//! Positions modulo M fill a range S ≤ M and jump by −M + u or M + u, where u is what the joint
//! turned. Steps of more than S/2 are such jumps; u is the mean of the steps beside each. M is the
//! median over three or more jumps. It is rounded to a whole number of half turns where that lies
//! within its error. Where all positions are whole numbers, such as ticks, it is rounded to a whole
//! number.
//!
//! Fewer jumps, or jumps of many sizes, determine no modulus. Whole numbers that jump by the range
//! of a counter of 8, 16 or 32 bits are its counts, however few the jumps.
//!
//! # Assumes
//! The joint turns by less than M/2 between two readings. Where it turns further, it seems to turn
//! by about M/2 or to reverse at once, and its positions determine nothing.

use super::POSITION_ROUNDING;
use std::f64::consts::{PI, TAU};
use trackdyn_core::real;
use trackdyn_core::robust::{deviation_about_zero, median};

/// Fewest jumps that tell a modulus.
const MIN_JUMPS: usize = 3;

/// Largest spread of the modulus between single jumps, as share of M.
const MAX_SPREAD: f64 = 0.1;

/// Largest standard error of M, as share of M: all speeds are off by the same share.
const MAX_ERROR: f64 = 2e-3;

/// Largest range of positions modulo M, as share of M: a little above 1 for glitches and rounding.
const MAX_RANGE: f64 = 1.001;

/// Distance from M up to which M is always rounded to a whole number of half turns, as share of M.
const MIN_ROUNDING: f64 = 1e-3;

/// Least step that may as well lead the other way, as share of M.
const MIN_FAR_STEP: f64 = 0.45;

/// Largest share of such steps, and of reversals at once, in the steps that are not zero.
const MAX_FAR_SHARE: f64 = 0.01;

/// Share of steps beyond half the range that are neither glitches nor restarts.
const MIN_JUMP_SHARE: f64 = 0.1;

/// Counts that fit into 8, 16 and 32 bits.
const COUNTERS: [f64; 3] = [256.0, 65_536.0, 4_294_967_296.0];

/// Largest error of a modulus by one jump against such a number: as share of it, and in counts.
const MAX_COUNTER_ERROR: f64 = 2e-3;
const MAX_COUNTS: f64 = 6.0;

/// Modulo what positions are reported.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Modulus {
    /// No modulus, or too few jumps to tell which.
    Unknown,
    /// This modulus, rad.
    Of(f64),
    /// Unclear, since the joint turns too far between two readings; holds the range of its
    /// positions, rad.
    Unclear(f64),
}

impl Modulus {
    /// Of positions in the order of time, rad.
    pub(super) fn of(positions: &[f64]) -> Self {
        let largest = positions.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let range = largest - positions.iter().copied().fold(f64::INFINITY, f64::min);
        let steps: Vec<f64> = positions.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let is_jump = |k: usize| steps[k].abs() > 0.5 * range;
        let jumps: Vec<usize> = (0..steps.len()).filter(|&k| is_jump(k)).collect();
        let moving = steps.iter().filter(|step| **step != 0.0).count();
        if jumps.is_empty() {
            return Self::Unknown;
        }
        let mut told: Vec<f64> = jumps
            .iter()
            .filter_map(|&k| {
                let beside = [k.checked_sub(1), Some(k + 1).filter(|next| *next < steps.len())];
                let beside = beside.into_iter().flatten().filter(|&k| !is_jump(k));
                let beside: Vec<f64> = beside.map(|k| steps[k]).collect();
                // M = |step| ∓ u
                let turned = beside.iter().sum::<f64>() / real(beside.len().max(1));
                (!beside.is_empty()).then(|| steps[k].abs() - steps[k].signum() * turned)
            })
            .collect();
        let unless_aliased = |modulus: f64| {
            let is_aliased = is_aliased(&steps, modulus, moving);
            if is_aliased { Self::Unclear(range) } else { Self::Of(modulus) }
        };
        if let Some(modulus) = of_counter(positions, range, &told) {
            return unless_aliased(modulus);
        }
        if jumps.len() < MIN_JUMPS {
            return Self::Unknown;
        }
        let count = real(told.len().max(1));
        let modulus = median(&mut told).unwrap_or(0.0);
        let mut off: Vec<f64> = told.iter().map(|one| one - modulus).collect();
        let spread = deviation_about_zero(&mut off).unwrap_or(f64::INFINITY);
        let error = 1.25 * spread / count.sqrt();
        let is_told = told.len() >= MIN_JUMPS
            && spread <= MAX_SPREAD * modulus
            && error <= MAX_ERROR * modulus
            && range <= MAX_RANGE * modulus + POSITION_ROUNDING;
        if is_told {
            return unless_aliased(rounded(modulus, error, positions));
        }
        if real(jumps.len()) > MIN_JUMP_SHARE * real(moving) {
            return Self::Unclear(range);
        }
        Self::Unknown
    }
}

/// How many counts a counter has, by its whole numbers, their range and the moduli by its jumps.
fn of_counter(positions: &[f64], range: f64, told: &[f64]) -> Option<f64> {
    if told.is_empty() || positions.iter().any(|position| position.fract() != 0.0) {
        return None;
    }
    COUNTERS.into_iter().find(|&counts| {
        let error = (MAX_COUNTER_ERROR * counts).max(MAX_COUNTS);
        range < counts && told.iter().all(|one| (one - counts).abs() <= error)
    })
}

/// A whole number, or a whole number of half turns, where it is within the error.
fn rounded(modulus: f64, error: f64, positions: &[f64]) -> f64 {
    let unit = if positions.iter().all(|position| position.fract() == 0.0) { 1.0 } else { PI };
    let nearest = unit * (modulus / unit).round();
    let is_near = (nearest - modulus).abs() <= (4.0 * error).max(MIN_ROUNDING * modulus);
    if nearest > 0.0 && is_near { nearest } else { modulus }
}

/// Whether the steps are as large as half the modulus too often.
fn is_aliased(steps: &[f64], modulus: f64, moving: usize) -> bool {
    let shortest = |step: f64| step - modulus * (step / modulus).round();
    let far = steps.iter().filter(|step| shortest(**step).abs() > MIN_FAR_STEP * modulus);
    let reversals = steps
        .windows(2)
        .filter(|pair| (shortest(pair[1]) - shortest(pair[0])).abs() > 0.5 * modulus);
    let largest = MAX_FAR_SHARE * real(moving);
    real(far.count()) > largest || real(reversals.count()) > largest.max(2.0)
}

/// Whether a jump is a wrap of a whole turn by the steps beside it, rad.
pub(super) fn is_of_a_turn(jump: f64, before: f64, after: f64) -> bool {
    let told = jump.abs() - jump.signum() * f64::midpoint(before, after);
    (told - TAU).abs() <= 0.02 * TAU + (after - before).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Positions of a joint that speeds up, stops and reverses, `rate` readings a second, up to
    /// 3.4 rad/s.
    fn positions(rate: u32, modulus: f64, resolution: f64) -> Vec<f64> {
        let angle = |t: f64| 1.5 * t + 1.9 / 0.4 * (1.0 - (0.4 * t).cos());
        let at = |k: u32| {
            let angle = angle(f64::from(k) / f64::from(rate));
            ((angle / resolution).round() * resolution).rem_euclid(modulus)
        };
        (0..60 * rate).map(at).collect()
    }

    #[test]
    fn any_modulus_is_found_from_the_jumps() {
        for (rate, modulus) in
            [(50, 1.0), (50, 0.3), (10, 3.0), (5, 3.0), (5, 6.0), (10, 6.0), (5, 12.5)]
        {
            let Modulus::Of(found) = Modulus::of(&positions(rate, modulus, 5e-4)) else {
                panic!("{rate} {modulus}: {:?}", Modulus::of(&positions(rate, modulus, 5e-4)))
            };
            assert!((found / modulus - 1.0).abs() < 2e-3, "{rate} {modulus} {found}");
        }
        for modulus in [PI, TAU, 2.0 * TAU] {
            assert_eq!(Modulus::of(&positions(10, modulus, 5e-4)), Modulus::Of(modulus));
        }
        let ticks: Vec<f64> = positions(20, TAU, TAU / 4096.0);
        let ticks: Vec<f64> = ticks.iter().map(|angle| (angle * 4096.0 / TAU).round()).collect();
        assert_eq!(Modulus::of(&ticks), Modulus::Of(4096.0));
    }

    #[test]
    fn a_joint_that_turns_too_far_between_readings_is_unclear() {
        for (rate, modulus) in [(5, 1.0), (10, 0.5), (5, 0.3)] {
            let found = Modulus::of(&positions(rate, modulus, 5e-4));
            assert!(matches!(found, Modulus::Unclear(_)), "{rate} {modulus} {found:?}");
        }
    }

    /// Ticks from the middle of the range on, as of a signed counter.
    #[test]
    fn counters_of_few_wraps_are_known() {
        for (counts, per_radian) in [(256.0, 4.0), (65_536.0, 652.0)] {
            let ticks = |angle: f64| (per_radian * angle).round();
            let wrapped = |angle: f64| (ticks(angle) + 0.5 * counts).rem_euclid(counts);
            let whole = positions(50, 1e9, 1e-9);
            let signed: Vec<f64> = whole.iter().map(|a| wrapped(*a) - 0.5 * counts).collect();
            assert_eq!(Modulus::of(&signed), Modulus::Of(counts), "{counts}");
        }
        // one that starts anew at zero
        let anew = (0..900_u32).map(|k| f64::from(if k < 600 { 100 * k } else { 100 * (k - 600) }));
        assert_eq!(Modulus::of(&anew.collect::<Vec<_>>()), Modulus::Unknown);
    }

    #[test]
    fn a_joint_that_does_not_wrap_has_no_modulus() {
        let whole = positions(20, 1e9, 5e-4);
        assert_eq!(Modulus::of(&whole), Modulus::Unknown);
        let mut anew = whole.clone();
        for (start, lost) in [(200, 30.0), (500, 90.0), (900, 20.0)] {
            for angle in &mut anew[start..] {
                *angle -= lost;
            }
        }
        assert_eq!(Modulus::of(&anew), Modulus::Unknown);
        assert_eq!(Modulus::of(&[]), Modulus::Unknown);
    }
}
