//! The cloud of ICRs that centripetal force and load transfer make of the point.
//!
//! Source: an independent computation (numpy, Gauss-Legendre 16 x 96 per track), in the manner of
//! Martinez et al., IJRR 24(10), 2005, Figs 6-7, where the left ICRs scatter less than the right
//! ones. Goal: means and standard deviations. Conditions: μ = 0.9/0.7, centre of gravity at
//! (-0.015, 0.04) m, 0.05 m high, 11 x 11 speeds over ±1 m/s without V_l = V_r.

use super::{compare, map_statistics};
use trackdyn_tests::auriga;

#[test]
fn means_and_spreads_come_out() {
    let effects = ["centripetal", "load-transfer:cog_height_m=0.05"];
    let statistics = map_statistics(&auriga([-0.015, 0.04], &effects));
    compare(&[
        ("mean x_l", statistics.mean.x_left, -0.375_280, 1e-6),
        ("mean x_r", statistics.mean.x_right, 0.457_246, 1e-6),
        ("mean y", statistics.mean.y, 0.049_001, 1e-6),
        ("spread of x_l", statistics.spread.x_left, 0.002_702, 1e-6),
        ("spread of x_r", statistics.spread.x_right, 0.005_301, 1e-6),
        ("spread of y", statistics.spread.y, 0.014_751, 1e-6),
    ]);
    assert!(statistics.spread.x_left < statistics.spread.x_right);
}
