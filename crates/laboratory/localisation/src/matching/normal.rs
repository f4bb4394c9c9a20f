//! The normal equations of a match, with the lines eliminated.
//!
//! Unknown are the motion x and, for each line k, its error δₖ, of which the reference knows the
//! covariance Cₖ. With residuals e = ρ − h and derivatives a = ∂h/∂x, b = ∂h/∂δ, the likelihood
//! asks for the least
//!
//! Σₖ ( Σ_j (e − a · δx − b · δₖ)²/σ² + δₖᵀ Cₖ⁻¹ δₖ ).
//!
//! Each δₖ occurs in its own term only, so that it can be eliminated line by line.

use crate::beam;
use crate::matching::association::{Normals, Pair};
use crate::reference::Reference;
use crate::scan::Return;
use nalgebra::{Matrix2, Matrix3, Matrix3x2, Vector2, Vector3};
use trackdyn_core::Pose;

/// H δx = g.
#[derive(Clone, Copy, Debug)]
pub(super) struct Normal {
    /// Information of the motion, H; its inverse is the covariance.
    pub(super) information: Matrix3<f64>,
    /// g.
    pub(super) gradient: Vector3<f64>,
    /// Least of the sum at δx = 0.
    pub(super) chi_square: f64,
    /// Information along the lines, F, that H holds or lacks by noise: a wall whose direction is
    /// off by two standard deviations 2σ_θ takes a displacement along it for one of 2σ_θ times that
    /// across.
    pub(super) feigned: Matrix3<f64>,
}

/// Builds them for pairs in the order of their lines; `None` where a beam no longer meets its line.
pub(super) fn equations(
    reference: &Reference,
    normals: &Normals,
    returns: &[Return],
    pairs: &[Pair],
    pose: &Pose,
    range_noise: f64,
) -> Option<Normal> {
    let per_variance = (range_noise * range_noise).recip();
    let yaw = pose.yaw.sin_cos();
    let mut sum = Normal {
        information: Matrix3::zeros(),
        gradient: Vector3::zeros(),
        chi_square: 0.0,
        feigned: Matrix3::zeros(),
    };
    for group in pairs.chunk_by(|one, next| one.line == next.line) {
        let index = group[0].line;
        let line = &reference.lines()[index];
        let mut by_pose = Matrix3::zeros();
        let mut by_both = Matrix3x2::zeros();
        let mut by_line = Matrix2::zeros();
        let mut pose_side = Vector3::zeros();
        let mut line_side = Vector2::zeros();
        let mut squares = 0.0;
        for pair in group {
            let hit = &returns[pair.hit];
            let beam = beam::on_normal(normals[index], line.distance, pose, yaw, hit.direction)?;
            let residual = hit.range - beam.range;
            by_pose += beam.by_pose * beam.by_pose.transpose();
            by_both += beam.by_pose * beam.by_line.transpose();
            by_line += beam.by_line * beam.by_line.transpose();
            pose_side += beam.by_pose * residual;
            line_side += beam.by_line * residual;
            squares += residual * residual;
        }
        // Sₖ = Σ b bᵀ/σ² + Cₖ⁻¹
        let own = by_line * per_variance + line.covariance.try_inverse()?;
        let eliminated = by_both * per_variance * own.try_inverse()?;
        // Hₖ = Σ a aᵀ/σ² − Σ a bᵀ/σ² Sₖ⁻¹ Σ b aᵀ/σ²
        let information = by_pose * per_variance - eliminated * by_both.transpose() * per_variance;
        sum.information += information;
        // Fₖ = (2σ_θ)² (n · Hₖ n) n′ n′ᵀ
        let (n_sin, n_cos) = normals[index];
        let normal = Vector3::new(n_cos, n_sin, 0.0);
        let along = Vector3::new(-n_sin, n_cos, 0.0);
        let offset = normal.dot(&(information * normal));
        sum.feigned += along * along.transpose() * (4.0 * line.covariance[(0, 0)] * offset);
        // g = Σₖ ( Σ a e/σ² − Σ a bᵀ/σ² Sₖ⁻¹ Σ b e/σ² )
        sum.gradient += pose_side * per_variance - eliminated * line_side * per_variance;
        sum.chi_square += squares * per_variance
            - line_side.dot(&(own.try_inverse()? * line_side)) * per_variance * per_variance;
    }
    Some(sum)
}
