//! Simulated ICRs of the symmetric Auriga-alpha.
//!
//! Source: Martinez et al., IJRR 24(10), 2005, sec. 5.2, simulated parameters.
//! Goal: with the one free number μ_x/μ_y = 9/7, all printed parameters to the last printed digit.
//! Conditions: centre of gravity at the origin; the paper prints no friction coefficients.

use super::{compare, map_statistics};
use trackdyn_tests::auriga;

#[test]
fn printed_parameters_come_out() {
    let statistics = map_statistics(&auriga([0.0, 0.0], &[]));
    compare(&[
        ("x_l", statistics.mean.x_left, -0.422, 5e-4),
        ("x_r", statistics.mean.x_right, 0.422, 5e-4),
        ("y", statistics.mean.y, 0.0, 1e-12),
        ("chi", statistics.steering_efficiency, 0.497, 5e-4),
        ("e", statistics.eccentricity, 0.0, 1e-12),
    ]);
}

/// Computed independently in another language with another quadrature.
#[test]
fn independent_computation_agrees_to_its_last_digit() {
    let statistics = map_statistics(&auriga([0.0, 0.0], &[]));
    compare(&[
        ("x_l", statistics.mean.x_left, -0.42233, 5e-6),
        ("chi", statistics.steering_efficiency, 0.49724, 5e-6),
    ]);
}
