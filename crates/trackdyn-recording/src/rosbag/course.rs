//! The yaw of a gyroscope, turned to the course of fixes.
//!
//! # Law
//! Where the robot drives straight, forward or backward, its yaw is the course c of the fixes, or
//! opposite to it:
//!
//! ψ = ψ₀ + (1 + e) G + b t,   maximise |Σ exp 2i(c_k − (1 + e) G_k − b t_k)|,   2ψ₀ = arg Σ
//!
//! G is the integral of the yaw rates, −b their bias, and 1 + e their scale. Least squares of the
//! angles that remain refine the best of a grid. Of both directions, that one is forward in which
//! the longer way is driven.
//!
//! # Assumes
//! A bias that stays: the agreement of yaw and course says whether it did.

use super::date::{Received, seconds};
use crate::recording::Course;
use nalgebra::{Matrix3, Vector3};
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

/// Largest error of the scale: above that of the cheapest gyroscopes, and of a small tilt.
const MAX_SCALE_ERROR: f64 = 0.03;

/// Step of the search over biases and scales, by what they turn over all fixes, rad.
const STEP: f64 = 0.15;

/// Most steps of a search either way: long drives are searched more coarsely, which agreement then
/// tells.
const MAX_STEPS: i32 = 600;

/// Most straight pieces that are looked at.
const MAX_PIECES: usize = 200;

/// Fewest straight pieces: three numbers are fitted to them.
const MIN_PIECES: usize = 8;

/// Least mean resultant length of doubled angles: courses scatter by 13 degrees then.
const MIN_AGREEMENT: f64 = 0.9;

/// Largest part of the agreement that another bias or scale may reach.
const MAX_SECOND_AGREEMENT: f64 = 0.97;

/// Steps of least squares.
const ITERATIONS: usize = 10;

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
    /// Mean yaw along it, rad.
    pub(super) yaw: f64,
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
            let mean = yaw0 + turned_along / way;
            let off = (y - y0).atan2(x - x0) - mean;
            pieces.push(Straight { time: middle, length, yaw: mean, off });
        }
        if is_long || turned.abs() > MAX_STRAIGHT_TURN {
            (start, way, turned_along) = (k, 0.0, 0.0);
        }
    }
    pieces
}

/// Yaws, rad, with their times, ns.
type Yaws = Vec<(i64, f64)>;

/// A straight piece as the fit sees it: 1, yaw (rad) and time (s) about their means, course minus
/// yaw (rad), and length (m).
struct Row {
    by: Vector3<f64>,
    off: f64,
    length: f64,
}

/// Length and argument of the mean of exp 2i(c − (1 + e) G − b t); `at` is 0, e and b.
fn resultant(rows: &[Row], at: &Vector3<f64>) -> (f64, f64) {
    let (cos, sin) = rows.iter().fold((0.0, 0.0), |(cos, sin), row| {
        let doubled = 2.0 * (row.off - row.by.dot(at));
        (cos + doubled.cos(), sin + doubled.sin())
    });
    (cos.hypot(sin) / real(rows.len()), sin.atan2(cos))
}

/// The yaws of a gyroscope that has turned by these angles, with their times, ns, by the course of
/// straight pieces of a way, and how they agree.
///
/// # Errors
/// Too few straight pieces, or courses that no bias brings to agree.
pub(super) fn aligned(
    turned: &[(i64, f64)],
    pieces: &[Straight],
) -> Result<(Yaws, Course), String> {
    let pieces: Vec<&Straight> =
        pieces.iter().step_by(pieces.len().div_ceil(MAX_PIECES).max(1)).collect();
    let count = pieces.len();
    if count < MIN_PIECES {
        return Err(format!(
            "its way has {count} straight pieces of 3 m whose course tells the yaw: expected \
             {MIN_PIECES} at least"
        ));
    }
    let start = turned.first().map_or(0, |(time, _)| *time);
    let mean = |value: &dyn Fn(&Straight) -> f64| {
        pieces.iter().map(|piece| value(piece)).sum::<f64>() / real(count)
    };
    let time = |piece: &Straight| seconds(start, piece.time);
    let (mean_yaw, mean_time) = (mean(&|piece| piece.yaw), mean(&time));
    let row = |piece: &Straight| Row {
        by: Vector3::new(1.0, piece.yaw - mean_yaw, time(piece) - mean_time),
        off: piece.off,
        length: piece.length,
    };
    let rows: Vec<Row> = pieces.into_iter().map(row).collect();
    let reach = |axis: usize| rows.iter().map(|row| row.by[axis].abs()).fold(0.0, f64::max);
    let [yaws, times] = [1, 2].map(reach);
    let tried: Vec<(f64, Vector3<f64>)> = grid(MAX_SCALE_ERROR, yaws)
        .flat_map(|e| grid(MAX_BIAS, times).map(move |b| Vector3::new(0.0, e, b)))
        .map(|at| (resultant(&rows, &at).0, at))
        .collect();
    let best = tried.iter().max_by(|a, b| a.0.total_cmp(&b.0));
    let mut at = best.map_or_else(Vector3::zeros, |(_, at)| *at);
    at[0] = resultant(&rows, &at).1 / 2.0;
    let (at, scale_deviation) = refined(&rows, at);
    let (agreement, _) = resultant(&rows, &Vector3::new(0.0, at[1], at[2]));
    if agreement < MIN_AGREEMENT {
        return Err(
            "its yaw rates, added up, do not follow the course of the fixes at any bias: expected \
             a gyroscope about the vertical, counter-clockwise in rad/s, and fixes known to some \
             centimetres (RTK)"
                .to_owned(),
        );
    }
    // Others that turn by much more over the way may look alike.
    let is_other = |other: &Vector3<f64>| {
        (other[1] - at[1]).abs() * yaws + (other[2] - at[2]).abs() * times > PI / 3.0
    };
    let likely = tried.iter().filter(|(length, _)| *length > MAX_SECOND_AGREEMENT * agreement);
    if likely.map(|(_, other)| other).any(is_other) {
        return Err(
            "the course of the fixes tells several biases of its yaw rates: expected more straight \
             driving, spread over the whole time"
                .to_owned(),
        );
    }
    let along: f64 = rows.iter().map(|row| row.length * (row.off - row.by.dot(&at)).cos()).sum();
    let first = at[0] + if along < 0.0 { PI } else { 0.0 };
    let yaw = |&(time, angle): &(i64, f64)| {
        let by = Vector3::new(0.0, angle - mean_yaw, seconds(start, time) - mean_time);
        (time, first + angle + by.dot(&at))
    };
    // of a normal angle σ the resultant is exp(−σ²/2), here of 2σ
    let scatter = (-2.0 * agreement.min(1.0).ln()).sqrt() / 2.0;
    let (scale, bias) = (1.0 + at[1], -at[2]);
    let course = Course { pieces: count, bias, scale, scale_deviation, scatter };
    Ok((turned.iter().map(yaw).collect(), course))
}

/// Values from −`most` to `most` whose product with `reach` goes in steps of [`STEP`].
fn grid(most: f64, reach: f64) -> impl Iterator<Item = f64> + Clone {
    #[expect(clippy::cast_possible_truncation, reason = "bounded")]
    let steps = (most * reach / STEP).ceil().min(f64::from(MAX_STEPS)) as i32;
    let step = most / f64::from(steps.max(1));
    (-steps..=steps).map(move |k| step * f64::from(k))
}

/// ψ₀, e and b by least squares of the angles that remain, and the standard error of e.
fn refined(rows: &[Row], mut at: Vector3<f64>) -> (Vector3<f64>, f64) {
    let mut deviation = 0.0;
    for _ in 0..ITERATIONS {
        let (mut matrix, mut right, mut squares) = (Matrix3::zeros(), Vector3::zeros(), 0.0);
        for row in rows {
            // forward and backward alike
            let left = wrapped(2.0 * (row.off - row.by.dot(&at))) / 2.0;
            matrix += row.by * row.by.transpose();
            right += row.by * left;
            squares += left * left;
        }
        let Some(inverse) = matrix.try_inverse() else { break };
        at += inverse * right;
        deviation = (inverse[(1, 1)] * squares / real(rows.len() - 3)).sqrt();
    }
    (at, deviation)
}
