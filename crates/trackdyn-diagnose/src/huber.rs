//! What a residual weighs that lies far out.
//!
//! # Sources
//! Huber, Ronchetti, Robust Statistics, 2nd ed. 2009, chapter 7.

use nalgebra::Vector3;
use trackdyn_estimate::gauss_newton::Huber;

/// The loss of the length of a whitened residual: 1 % of normal residuals are longer than its
/// threshold.
const LOSS: Huber = Huber { threshold: 3.4 };

/// The weight of each sample: one near, less far out.
pub fn weights(residual: &[Vector3<f64>]) -> Vec<f64> {
    residual.iter().map(|sample| LOSS.weight(sample.norm())).collect()
}

/// Twice the loss.
pub fn loss(residual: &[Vector3<f64>]) -> f64 {
    residual.iter().map(|sample| LOSS.value(sample.norm())).sum()
}
