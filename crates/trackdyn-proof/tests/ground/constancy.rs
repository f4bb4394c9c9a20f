//! The base case turns about the same three points at whatever speeds.

use crate::turn::{Turn, auriga, distance};
use trackdyn_core::Pose;
use trackdyn_proof::Setup;

/// Speeds left and right, m/s: arcs, counter-rotations and spins, slow and fast, forward and in reverse.
const SPEEDS: [(f64, f64); 8] = [
    (0.4, 1.0),
    (0.1, 0.25),
    (-0.4, -1.0),
    (1.0, 0.4),
    (-0.4, 1.0),
    (0.7, -0.7),
    (-0.05, 0.05),
    (0.45, 0.5),
];

#[test]
fn one_point_for_each_track() {
    let vehicle = auriga([-0.015, 0.04]);
    for (strips, shoes, bound) in [(4, 20, 3e-4), (10, 50, 1e-4)] {
        let setup = Setup { strips, shoes, ..Setup::default() };
        let triples = SPEEDS.map(|speeds| {
            Turn { vehicle: &vehicle, active: &[], setup: &setup, speeds, target: Pose::default() }
                .icrs()
        });
        let spread = triples.iter().map(|&t| distance(t, triples[0])).fold(0.0, f64::max);
        println!("{strips} strips of {shoes} shoes: spread {spread:.2e} m");
        assert!(spread < bound, "{spread} {triples:?}");
    }
}
