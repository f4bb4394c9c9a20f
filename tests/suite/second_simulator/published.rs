//! Steady turns of Auriga-alpha, Martinez et al., IJRR 24(10), 2005, sec. 5: the ICRs that the
//! paper prints to three digits, with the digits that an integration of eqs (14)-(15) gives for
//! μ_x/μ_y = 9/7.

use crate::second_simulator::turn::{Turn, auriga, distance, typical};
use trackdyn_core::Pose;
use trackdyn_second_simulator::{ActiveMechanism, Setup};

const CASES: [([f64; 2], [f64; 3]); 2] =
    [([0.0, 0.0], [-0.42233, 0.42233, 0.0]), ([-0.015, 0.04], [-0.37538, 0.45735, 0.04923])];

/// Root mean square, over draws of the shoes, of the distance to the reference, m.
fn error(cog: [f64; 2], reference: [f64; 3], strips: u32, shoes: u32) -> f64 {
    let draws = 6_u32;
    let squares = (0..draws).map(|seed| {
        let setup = Setup { strips, shoes, seed: seed.into(), ..Setup::default() };
        let vehicle = auriga(cog);
        let turn = Turn {
            vehicle: &vehicle,
            active: &[],
            setup: &setup,
            speeds: (-0.3, 0.5),
            target: Pose::default(),
            at: 0.0,
        };
        distance(turn.icrs(), reference).powi(2)
    });
    (squares.sum::<f64>() / f64::from(draws)).sqrt()
}

#[test]
fn icrs_are_the_published_ones_and_come_closer_with_more_shoes() {
    for (cog, reference) in CASES {
        let grids = [(2, 7), (4, 14), (8, 28), (16, 56)];
        let errors = grids.map(|(strips, shoes)| error(cog, reference, strips, shoes));
        println!("CoG {cog:?}: {errors:.6?} m with {grids:?} strips and shoes");
        // each shoe acts at its middle: the error falls with the square of its size, by 4 each
        // time; the random cuts leave some of it
        for pair in errors.windows(2) {
            assert!(pair[1] < pair[0] / 2.0, "{errors:?}");
        }
        // by then a shoe is 9 mm by 13 mm
        assert!(errors[3] < 1.2e-4, "{errors:?}");
    }
}

#[test]
fn a_torsion_stiff_hull_turns_about_other_points() {
    let vehicle = auriga([-0.015, 0.04]);
    let setup = Setup::default();
    let icrs = |active: &[ActiveMechanism]| {
        let (speeds, target) = ((-0.3, 0.5), Pose::default());
        Turn { vehicle: &vehicle, active, setup: &setup, speeds, target, at: 0.0 }.icrs()
    };
    let (soft, stiff) = (icrs(&[]), icrs(&typical(&["stiff-hull"])));
    println!("soft {soft:.5?}, stiff {stiff:.5?}");
    // more than the shoes' error, less than the shift of the centres of pressure, 3 mm
    assert!((1e-4..3e-3).contains(&distance(soft, stiff)), "{soft:?} {stiff:?}");
}
