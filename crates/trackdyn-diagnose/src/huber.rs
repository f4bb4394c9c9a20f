//! What a residual weighs that lies far out.
//!
//! # Sources
//! Huber, Ronchetti, Robust Statistics, 2nd ed. 2009, chapter 7.

use nalgebra::Vector3;

/// Length of a whitened residual from which on it counts linearly: 1 % of normal residuals are longer.
const FAR: f64 = 3.4;

/// The weight of each sample: one near, less far out.
pub fn weights(residual: &[Vector3<f64>]) -> Vec<f64> {
    let lengths = residual.iter().map(Vector3::norm);
    lengths.map(|length| if length > FAR { FAR / length } else { 1.0 }).collect()
}

/// Twice the loss: |z|² near, c (2 |z| − c) from c on.
pub fn loss(residual: &[Vector3<f64>]) -> f64 {
    let lengths = residual.iter().map(Vector3::norm);
    lengths
        .map(|length| if length > FAR { FAR * (2.0 * length - FAR) } else { length * length })
        .sum()
}
