//! Relative and absolute pose errors, as the Python package `evo` defines them, in the plane.
//!
//! Paths are compared pose by pose: both have the same stamps. `tests/suite/odometry/evo.rs`
//! compares the results with those of `evo`.
//!
//! # Sources
//! Sturm et al., A Benchmark for the Evaluation of RGB-D SLAM Systems, IROS 2012, section IV;
//! Umeyama, Least-squares estimation of transformation parameters between two point patterns, IEEE
//! PAMI 13(4), 1991; Grupp, evo: Python package for the evaluation of odometry and SLAM,
//! <https://github.com/MichaelGrupp/evo>.

mod alignment;
mod pairs;
mod statistics;

pub use alignment::align;
pub use pairs::{Delta, pairs};
pub use statistics::Statistics;

use trackdyn_core::Pose;
use trackdyn_core::pose::wrap_angle;

/// Errors of the estimated motion between pairs of poses: E = (Qᵢ⁻¹Qⱼ)⁻¹ (Pᵢ⁻¹Pⱼ), Q the reference
/// and P the estimate. `evo` picks the pairs on the estimate unless it is told otherwise.
pub fn relative(reference: &[Pose], estimate: &[Pose], pairs: &[[usize; 2]]) -> Vec<Pose> {
    let motion = |path: &[Pose], [from, to]: [usize; 2]| path[from].relative(&path[to]);
    pairs.iter().map(|&pair| motion(reference, pair).relative(&motion(estimate, pair))).collect()
}

/// Errors of the estimated poses: E = P⁻¹Q.
pub fn absolute(reference: &[Pose], estimate: &[Pose]) -> Vec<Pose> {
    estimate
        .iter()
        .zip(reference)
        .map(|(estimate, reference)| estimate.relative(reference))
        .collect()
}

/// Lengths of the errors, m: evo's `translation_part`.
pub fn lengths(errors: &[Pose]) -> Vec<f64> {
    errors.iter().map(|error| error.x.hypot(error.y)).collect()
}

/// Angles of the errors, rad, 0 to π: evo's `rotation_angle_rad`.
pub fn angles(errors: &[Pose]) -> Vec<f64> {
    errors.iter().map(|error| wrap_angle(error.yaw).abs()).collect()
}
