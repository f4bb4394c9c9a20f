//! Simulated ICRs of Auriga-alpha with its centre of gravity at (-0.015, 0.04) m.
//!
//! Source: Martinez et al., IJRR 24(10), 2005, sec. 5.2, simulated parameters. Goal: with μ_x/μ_y =
//! 9/7, calibrated on the symmetric vehicle alone, the printed ICRs and χ to the last printed digit
//! (χ to one more unit: 0.5044 against 0.505). Not met, and not tuned to: the printed e = 0.108. By
//! eq. (13) the paper's own printed ICRs give
//! 0.0986, and so do ours.

use super::{compare, map_statistics};
use trackdyn_model::Icrs;
use trackdyn_tests::auriga;

#[test]
fn printed_parameters_come_out() {
    let statistics = map_statistics(&auriga([-0.015, 0.04], &[]));
    compare(&[
        ("x_l", statistics.mean.x_left, -0.375, 5e-4),
        ("x_r", statistics.mean.x_right, 0.457, 5e-4),
        ("y", statistics.mean.y, 0.0492, 5e-5),
        ("chi", statistics.steering_efficiency, 0.505, 1e-3),
    ]);
}

#[test]
fn printed_eccentricity_contradicts_the_printed_icrs() {
    let printed = Icrs { x_left: -0.375, x_right: 0.457, y: 0.0492 };
    compare(&[("e of the printed ICRs", printed.eccentricity(), 0.0986, 5e-5)]);
    assert!((printed.eccentricity() - 0.108).abs() > 0.009);
}

/// Computed independently in another language with another quadrature.
#[test]
fn independent_computation_agrees_to_its_last_digit() {
    let statistics = map_statistics(&auriga([-0.015, 0.04], &[]));
    compare(&[
        ("x_l", statistics.mean.x_left, -0.37538, 5e-6),
        ("x_r", statistics.mean.x_right, 0.45735, 5e-6),
        ("y", statistics.mean.y, 0.04923, 5e-6),
        ("chi", statistics.steering_efficiency, 0.50437, 5e-6),
        ("e", statistics.eccentricity, 0.09844, 5e-6),
    ]);
}
