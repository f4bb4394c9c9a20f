//! Departures from constant ICRs, as columns of a linear fit.

use super::IcrColumns;
use nalgebra::Vector3;
use trackdyn_model::effect::Symmetry;

/// Departures that break one symmetry in one way.
#[derive(Clone, Debug)]
pub struct Contrasts {
    /// The symmetry.
    pub symmetry: Symmetry,
    /// Symmetries whose plain contrasts, those beside nothing, do not count as departures of this
    /// kind.
    pub beside: &'static [Symmetry],
    /// The departures, not whitened.
    pub columns: Vec<Vec<Vector3<f64>>>,
}

/// Derivatives of the prediction by a = (x_l + x_r)/2, h = (x_r − x_l)/2 and y, each ICR as far as
/// it moves.
pub fn middle_half_y([left, right, y]: &IcrColumns) -> [Vec<Vector3<f64>>; 3] {
    let combine = |sign: f64| -> Vec<Vector3<f64>> {
        left.iter().zip(right).map(|(left, right)| right + left * sign).collect()
    };
    [combine(1.0), combine(-1.0), y.clone()]
}
