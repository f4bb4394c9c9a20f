//! What the scans do not see.

use crate::matching::normal::Normal;
use nalgebra::{Matrix3, SymmetricEigen, Vector3};

/// Directions about which the guess says more than the scans.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weak {
    /// Information of the guess along them, zero across.
    pub(super) information: Matrix3<f64>,
    /// The displacement that is seen least, one standard deviation of the guess long.
    pub(super) least: Vector3<f64>,
}

/// In units of the guess's standard deviations D, the guess has information 1 in every direction.
/// Directions in which D (H − F) D has less are weak, with F what noise may feign.
/// `None` where there are none.
pub(super) fn weak(normal: &Normal, deviations: &Vector3<f64>) -> Option<Weak> {
    let scale = Matrix3::from_diagonal(deviations);
    let scaled = scale * (normal.information - normal.feigned) * scale;
    let eigen = SymmetricEigen::new((scaled + scaled.transpose()) / 2.0);
    let per_scale = Matrix3::from_diagonal(&deviations.map(f64::recip));
    let mut information = Matrix3::zeros();
    let mut least = (1.0, None);
    for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *value < 1.0 {
            let direction = per_scale * vector;
            information += direction * direction.transpose();
            if *value < least.0 {
                least = (*value, Some(scale * vector));
            }
        }
    }
    Some(Weak { information, least: least.1? })
}
