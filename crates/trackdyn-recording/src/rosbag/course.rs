//! The yaw of a gyroscope, turned to the course of fixes.
//!
//! # Law
//! Where the robot drives straight, forward or backward, its yaw is the course c of the fixes, or
//! opposite to it:
//!
//! ψ = ψ₀ + G + b t,   maximise |Σ exp 2i(c_k − G_k − b t_k)|,   2ψ₀ = arg Σ
//!
//! G is the integral of the yaw rates and −b their bias. Of both directions, that one is forward in
//! which the longer way is driven.
//!
//! # Assumes
//! A bias that stays: the agreement of yaw and course says whether it did.

use super::date::{Received, seconds};
use crate::recording::Course;
use std::f64::consts::{PI, TAU};
use trackdyn_core::real;

/// Length of the pieces whose course is compared with the yaw, m: above the noise of a receiver
/// within some seconds.
pub(super) const COURSE_LENGTH: f64 = 3.0;

/// Largest change of yaw in a straight piece, rad.
const MAX_STRAIGHT_TURN: f64 = 0.2;

/// Fewest straight pieces for a comparison.
pub(super) const MIN_STRAIGHT_PIECES: u32 = 5;

/// Largest bias, rad/s: 3 degrees per second, above that of the cheapest.
const MAX_BIAS: f64 = 0.05;

/// Step of the search over biases, by what they turn over all fixes, rad.
const STEP: f64 = 0.1;

/// Least mean resultant length of doubled angles: courses scatter by 13 degrees then.
const MIN_AGREEMENT: f64 = 0.9;

/// Largest part of the agreement that another bias may reach.
const MAX_SECOND: f64 = 0.97;

/// An angle in [-π, π).
pub(super) fn wrapped(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}

/// A straight piece of a way.
pub(super) struct Straight {
    /// Time in its middle, ns.
    pub(super) time: i64,
    /// Its length, m.
    pub(super) length: f64,
    /// Course minus yaw, rad.
    pub(super) off: f64,
}

/// The pieces of a way in which the robot drives straight, forward or backward. The yaw of a piece
/// is the mean along its way: to first order its chord has that direction.
pub(super) fn straight(poses: &[(i64, Received<[f64; 3]>)]) -> Vec<Straight> {
    let mut pieces = Vec::new();
    let mut start = 0;
    // way, m, and its product with the yaw since the start, m rad
    let (mut way, mut turned_along) = (0.0, 0.0);
    for k in 1..poses.len() {
        let [(begins, first), (_, before), (time, pose)] =
            [start, k - 1, k].map(|index| &poses[index]);
        let ([x0, y0, yaw0], [x1, y1, yaw1]) = (first.value, before.value);
        let [x, y, yaw] = pose.value;
        let (turned, length) = (wrapped(yaw - yaw0), (x - x0).hypot(y - y0));
        let step = (x - x1).hypot(y - y1);
        way += step;
        turned_along += step * (wrapped(yaw1 - yaw0) + wrapped(yaw - yaw1) / 2.0);
        let is_long = length >= COURSE_LENGTH;
        if is_long && turned.abs() <= MAX_STRAIGHT_TURN {
            let middle = begins + time.saturating_sub(*begins) / 2;
            let off = (y - y0).atan2(x - x0) - (yaw0 + turned_along / way);
            pieces.push(Straight { time: middle, length, off });
        }
        if is_long || turned.abs() > MAX_STRAIGHT_TURN {
            (start, way, turned_along) = (k, 0.0, 0.0);
        }
    }
    pieces
}

/// Yaws, rad, with their times, ns.
type Yaws = Vec<(i64, f64)>;

/// The yaws of a gyroscope that has turned by these angles, with their times, ns, by the course of
/// straight pieces of a way, and how they agree.
///
/// # Errors
/// Too few straight pieces, or courses that no bias brings to agree.
pub(super) fn aligned(
    turned: &[(i64, f64)],
    pieces: &[Straight],
) -> Result<(Yaws, Course), String> {
    let count = pieces.len();
    if count < MIN_STRAIGHT_PIECES as usize {
        return Err(format!(
            "its way has {count} straight pieces of 3 m whose course tells the yaw: expected \
             {MIN_STRAIGHT_PIECES} at least"
        ));
    }
    let start = turned.first().map_or(0, |(time, _)| *time);
    let times: Vec<f64> = pieces.iter().map(|piece| seconds(start, piece.time)).collect();
    let span = times.iter().copied().fold(0.0, f64::max)
        - times.iter().copied().fold(f64::INFINITY, f64::min);
    // (length, argument) of the mean of exp 2i(c − G − b t)
    let resultant = |bias: f64| {
        let doubled = pieces.iter().zip(&times).map(|(piece, t)| 2.0 * (piece.off - bias * t));
        let (cos, sin) = doubled
            .fold((0.0, 0.0), |(cos, sin), angle: f64| (cos + angle.cos(), sin + angle.sin()));
        (cos.hypot(sin) / real(count), sin.atan2(cos))
    };
    let step = STEP / span.max(1.0);
    #[expect(clippy::cast_possible_truncation, reason = "a robot drives for hours at most")]
    let steps = (MAX_BIAS / step).ceil() as i32;
    let tried: Vec<(f64, f64)> = (-steps..=steps)
        .map(|k| step * f64::from(k))
        .map(|bias| (resultant(bias).0, bias))
        .collect();
    let best = tried.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, 0.0));
    let bias = summit(best.1, step, |bias| resultant(bias).0);
    let (agreement, doubled) = resultant(bias);
    if agreement < MIN_AGREEMENT {
        return Err(
            "its yaw rates, added up, do not follow the course of the fixes at any bias: expected \
             a gyroscope about the vertical, counter-clockwise in rad/s, and fixes known to some \
             centimetres (RTK)"
                .to_owned(),
        );
    }
    // Biases that turn by half a turn more over the way may look alike.
    let other = tried.iter().filter(|(_, other)| (other - bias).abs() * span > PI / 4.0);
    if other.clone().any(|(length, _)| *length > MAX_SECOND * agreement) {
        return Err(
            "the course of the fixes tells several biases of its yaw rates: expected more straight \
             driving, spread over the whole time"
                .to_owned(),
        );
    }
    let along: f64 = pieces
        .iter()
        .zip(&times)
        .map(|(piece, t)| piece.length * (piece.off - bias * t - doubled / 2.0).cos())
        .sum();
    let first = doubled / 2.0 + if along < 0.0 { PI } else { 0.0 };
    let yaw = |&(time, angle): &(i64, f64)| (time, first + angle + bias * seconds(start, time));
    // of a normal angle σ the resultant is exp(−σ²/2), here of 2σ
    let scatter = (-2.0 * agreement.min(1.0).ln()).sqrt() / 2.0;
    let course = Course { pieces: count, bias: -bias, scatter };
    Ok((turned.iter().map(yaw).collect(), course))
}

/// Where a function is largest within a step of a place: by thirds.
fn summit(at: f64, step: f64, value: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (at - step, at + step);
    for _ in 0..60 {
        let third = (high - low) / 3.0;
        if value(low + third) < value(high - third) {
            low += third;
        } else {
            high -= third;
        }
    }
    f64::midpoint(low, high)
}
