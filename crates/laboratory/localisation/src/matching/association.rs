//! Which line each return looks at.

use crate::beam::{self, Beam};
use crate::line::Line;
use crate::reference::Reference;
use crate::scan::Return;
use nalgebra::Matrix3;
use trackdyn_core::Pose;

/// A return and the line it belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pair {
    /// Index of the line.
    pub(super) line: usize,
    /// Index of the return.
    pub(super) hit: usize,
}

/// Largest distance of a return from its line, in standard deviations. Returns further away belong
/// to something else; of a normal distribution one in 16 000 lies beyond.
const MAX_DEVIATIONS: f64 = 4.0;

/// Largest number of returns that are used to come near: 20 on each of half a dozen lines.
const MAX_RETURNS: usize = 120;

/// Sines and cosines of the lines' normals.
pub(super) type Normals = Vec<(f64, f64)>;

pub(super) fn normals(lines: &[Line]) -> Normals {
    lines.iter().map(|line| line.angle.sin_cos()).collect()
}

/// What was found at one pose.
pub(super) struct Association {
    /// Pairs within the gate, by line.
    pub(super) pairs: Vec<Pair>,
    /// Returns that look at a known line.
    pub(super) candidates: usize,
}

/// Pairs at a pose that is known as well as the scans tell it: each return belongs to the line of
/// the reference's beam that looks to where it is.
pub(super) fn close(
    reference: &Reference,
    normals: &Normals,
    returns: &[Return],
    pose: &Pose,
    range_noise: f64,
) -> Association {
    let lines = reference.lines();
    let yaw = pose.yaw.sin_cos();
    let mut association = Association { pairs: Vec::with_capacity(returns.len()), candidates: 0 };
    for (index, hit) in returns.iter().enumerate() {
        let (bearing, _) = bearing(hit, pose, yaw);
        let Some(line) = reference.line_at(bearing) else { continue };
        association.candidates += 1;
        let at = beam::on_normal(normals[line], lines[line].distance, pose, yaw, hit.direction);
        let Some(beam) = at else { continue };
        let variance = variance(&beam, &lines[line], range_noise);
        if (hit.range - beam.range).powi(2) <= MAX_DEVIATIONS * MAX_DEVIATIONS * variance {
            association.pairs.push(Pair { line, hit: index });
        }
    }
    association.pairs.sort_by_key(|pair| pair.line);
    association
}

/// Pairs at a pose with covariance, each with the variance of its residual: of all lines in the
/// window that the covariance opens, the one that fits best against what is expected. To come near,
/// a part of the returns does.
pub(super) fn wide(
    reference: &Reference,
    normals: &Normals,
    returns: &[Return],
    pose: &Pose,
    covariance: &Matrix3<f64>,
    range_noise: f64,
) -> Vec<(Pair, Beam, f64)> {
    let lines = reference.lines();
    let yaw = pose.yaw.sin_cos();
    let across = covariance[(0, 0)].max(covariance[(1, 1)]).sqrt();
    let turn = covariance[(2, 2)].sqrt();
    let every = (returns.len() / MAX_RETURNS).max(1);
    let mut pairs = Vec::with_capacity(returns.len() / every + 1);
    for (index, hit) in returns.iter().enumerate().step_by(every) {
        let (bearing, distance) = bearing(hit, pose, yaw);
        let window = 2.0 * (turn + across / distance.max(across));
        let mut best: Option<(f64, usize, Beam, f64)> = None;
        for line in reference.lines_around(bearing, window) {
            let at = beam::on_normal(normals[line], lines[line].distance, pose, yaw, hit.direction);
            let Some(beam) = at else { continue };
            let variance = variance(&beam, &lines[line], range_noise)
                + beam.by_pose.dot(&(covariance * beam.by_pose));
            let squared = (hit.range - beam.range).powi(2) / variance;
            if squared <= MAX_DEVIATIONS * MAX_DEVIATIONS
                && best.is_none_or(|(least, ..)| squared < least)
            {
                best = Some((squared, line, beam, variance));
            }
        }
        if let Some((_, line, beam, variance)) = best {
            pairs.push((Pair { line, hit: index }, beam, variance));
        }
    }
    pairs
}

/// σ² + bᵀ C b: noise of the return and of the line.
fn variance(beam: &Beam, line: &Line, range_noise: f64) -> f64 {
    range_noise * range_noise + beam.by_line.dot(&(line.covariance * beam.by_line))
}

/// Bearing and distance of a return from the reference.
fn bearing(hit: &Return, pose: &Pose, (sin, cos): (f64, f64)) -> (f64, f64) {
    let [u, v] = hit.direction;
    let x = pose.x + hit.range * (cos * u - sin * v);
    let y = pose.y + hit.range * (sin * u + cos * v);
    (y.atan2(x), x.hypot(y))
}
