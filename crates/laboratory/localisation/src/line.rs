//! A straight line as a sensor sees it.

use nalgebra::Matrix2;

/// A straight line n · p = d in the frame of a sensor, with n = (cos θ, sin θ) and d > 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Bearing of its normal, away from the sensor, θ, rad.
    pub angle: f64,
    /// Distance from the sensor, d, m.
    pub distance: f64,
    /// Covariance of (θ, d), in rad², rad m and m².
    pub covariance: Matrix2<f64>,
    /// Index of the first beam that surely hits it.
    pub first_beam: usize,
    /// Index of the last beam that surely hits it.
    pub last_beam: usize,
}
