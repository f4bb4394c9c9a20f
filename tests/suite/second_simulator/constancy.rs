//! The base case turns about the same three points at whatever speeds.

use crate::second_simulator::turn::{Turn, auriga, distance};
use trackdyn_core::Pose;
use trackdyn_second_simulator::Setup;

/// Speeds left and right, m/s: arcs, counter-rotations and spins, slow and fast, forward and in
/// reverse.
const SPEEDS: [(f64, f64); 8] = [
    (-0.4, 1.0),
    (0.4, 1.0),
    (0.1, 0.25),
    (-0.4, -1.0),
    (1.0, 0.4),
    (0.7, -0.7),
    (-0.05, 0.05),
    (0.45, 0.5),
];

#[test]
fn one_point_for_each_track() {
    let vehicle = auriga([-0.015, 0.04]);
    for elastic_range in [5e-6, 20e-6] {
        let setup = Setup { elastic_range, ..Setup::default() };
        let icrs = |speeds| {
            let target = Pose::default();
            Turn { vehicle: &vehicle, active: &[], setup: &setup, speeds, target, at: 0.0 }.icrs()
        };
        let reference = icrs(SPEEDS[0]);
        for speeds in SPEEDS {
            let (left, right): (f64, f64) = speeds;
            let off = distance(icrs(speeds), reference);
            // A shoe follows a change of the slip's direction within its elastic range z of
            // sliding. Until then it is carried on by z V/|s|, and |s| is ω (|x_j| − L/2) at least.
            let slowest_slip = (right - left).abs() / 0.8325 * 0.165;
            let carried = elastic_range * left.abs().max(right.abs()) / slowest_slip;
            println!("{speeds:?}: {:.1} µm off, {:.1} µm allowed", 1e6 * off, 1e6 * carried);
            // of shoes that come and go 10 µm remain, a thousandth of their size
            assert!(off < 2.0 * carried + 1e-5, "{speeds:?}: {off} m");
        }
    }
}
