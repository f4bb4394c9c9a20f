//! Departures from constant ICRs, as columns of a linear fit.

use super::IcrColumns;
use nalgebra::Vector3;
use trackdyn_model::effect::Symmetry;

/// Contrasts that break one symmetry in one way.
#[derive(Clone, Debug)]
pub struct Contrasts {
    /// The symmetry.
    pub symmetry: Symmetry,
    /// Symmetries whose plain contrasts (those with an empty `beside`) are projected out first.
    pub beside: &'static [Symmetry],
    /// Columns, not whitened.
    pub columns: Vec<Vec<Vector3<f64>>>,
}

/// Jacobian of the prediction by a = (x_l + x_r)/2, h = (x_r − x_l)/2 and y: ∂/∂a = ∂/∂x_r +
/// ∂/∂x_l, ∂/∂h = ∂/∂x_r − ∂/∂x_l.
pub fn middle_half_y([left, right, y]: &IcrColumns) -> [Vec<Vector3<f64>>; 3] {
    let combine = |sign: f64| -> Vec<Vector3<f64>> {
        left.iter().zip(right).map(|(left, right)| right + left * sign).collect()
    };
    [combine(1.0), combine(-1.0), y.clone()]
}
