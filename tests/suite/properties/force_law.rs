//! The empirical force: sizes by hand, twins in a limit, and that its coefficients are pure
//! numbers.

use trackdyn_core::{PerSide, Plant, Pose, STANDARD_GRAVITY, Trajectory};
use trackdyn_model::{ActiveEffect, CATALOGUE, Circumstance, Effects, Model, RunningGear, Vehicle};
use trackdyn_model::{Stationary, Transient};
use trackdyn_tests::auriga;

const SPEEDS: [(f64, f64); 4] = [(0.2, 0.6), (-0.3, 0.5), (-0.4, 0.4), (0.7, 0.1)];

const CIRCUMSTANCE: Circumstance = Circumstance { position: [2.0, -1.0], heading: 0.7, time: 40.0 };

fn icrs(model: &Model, (left, right): (f64, f64), here: &Circumstance) -> [f64; 3] {
    let solution = Stationary::new(model, here).solve(PerSide::new(left, right));
    solution.icrs.expect("a turn").to_array()
}

/// All terms at once, each at this part of its typical size.
fn all_terms(share: f64) -> Effects {
    let forms = CATALOGUE.iter().filter(|card| card.is_form());
    forms
        .map(|card| {
            let coefficients = card.terms().into_iter().flat_map(|term| term.coefficients);
            let mut coefficients: Vec<usize> = coefficients.collect();
            coefficients.sort_unstable();
            coefficients.dedup();
            let settings: Vec<_> = coefficients
                .into_iter()
                .map(|k| (card.parameters[k].key, share * card.parameters[k].typical))
                .collect();
            ActiveEffect::new(card.id, &settings).expect("coefficients")
        })
        .collect()
}

#[test]
fn a_robot_with_locked_belts_is_pushed_aside_by_what_friction_does_not_hold() {
    const SHARE: f64 = 1.2;
    let effects =
        ["centripetal", "yaw-inertia", &format!("force-law:side={SHARE}")].map(str::to_owned);
    let model = auriga([0.0, 0.0], &effects.each_ref().map(String::as_str));
    let mut robot = Transient::at_rest(&model, 0.0, Pose::default());
    let mut path = Trajectory::default();
    robot.drive(PerSide::new(0.0, 0.0), 1.0, &mut path).expect("it slides");
    let end = path.moments()[path.moments().len() - 1].pose;
    // To the right, −y in the world: ½ (c − μ_x) g t²
    let expected = -0.5 * (SHARE - model.vehicle().friction.across) * STANDARD_GRAVITY;
    assert!((end.y - expected).abs() < 0.005 * expected.abs(), "{} {expected}", end.y);
    assert!(end.x.abs() < 1e-3 && end.yaw.abs() < 1e-3, "{end:?}");
    // Friction holds what is below it.
    let model = auriga([0.0, 0.0], &["centripetal", "yaw-inertia", "force-law:side=0.8"]);
    let mut robot = Transient::at_rest(&model, 0.0, Pose::default());
    let mut path = Trajectory::default();
    robot.drive(PerSide::new(0.0, 0.0), 1.0, &mut path).expect("it stays");
    let end = path.moments()[path.moments().len() - 1].pose;
    assert!(end.y.abs() < 1e-3, "{end:?}");
}

#[test]
fn a_force_that_is_constant_in_the_world_is_a_slope() {
    // Weight along the slope over friction: m g sin β against μ m g cos β
    let (angle, uphill) = (3.0_f64, 50.0_f64);
    let slope = auriga([0.0, 0.0], &[&format!("slope:angle_deg={angle},uphill_deg={uphill}")]);
    let (sin, cos) = uphill.to_radians().sin_cos();
    let size = -angle.to_radians().tan();
    let force = format!("force-law:world_x={},world_y={}", size * cos, size * sin);
    let force = auriga([0.0, 0.0], &[&force]);
    for speeds in SPEEDS {
        for heading in [0.0, 1.3, 4.0] {
            let here = Circumstance { heading, ..CIRCUMSTANCE };
            let (one, other) = (icrs(&slope, speeds, &here), icrs(&force, speeds, &here));
            for (one, other) in one.into_iter().zip(other) {
                assert!((one - other).abs() < 1e-9, "{speeds:?} {heading}: {one} {other}");
            }
        }
    }
}

#[test]
fn mass_changes_no_motion() {
    let light = auriga([0.01, 0.04], &[]).vehicle().clone();
    let heavy = Vehicle { mass: 2.0 * light.mass, ..light.clone() };
    let [light, heavy] = [light, heavy].map(|vehicle| Model::new(vehicle, all_terms(0.2)));
    for speeds in SPEEDS {
        let (one, other) =
            (icrs(&light, speeds, &CIRCUMSTANCE), icrs(&heavy, speeds, &CIRCUMSTANCE));
        for (one, other) in one.into_iter().zip(other) {
            assert!((one - other).abs() < 1e-9, "{speeds:?}: {one} {other}");
        }
    }
}

#[test]
fn a_larger_robot_at_the_same_froude_number_moves_alike() {
    const SIZE_FACTOR: f64 = 4.0;
    let small = auriga([0.01, 0.04], &[]).vehicle().clone();
    let RunningGear::Track { contact_length, belt_width } = small.running_gear else {
        unreachable!("Auriga-alpha has tracks")
    };
    let large = Vehicle {
        gauge: SIZE_FACTOR * small.gauge,
        cog: small.cog.map(|x| SIZE_FACTOR * x),
        running_gear: RunningGear::Track {
            contact_length: SIZE_FACTOR * contact_length,
            belt_width: SIZE_FACTOR * belt_width,
        },
        ..small.clone()
    };
    let [small, large] = [small, large].map(|vehicle| Model::new(vehicle, all_terms(0.2)));
    let there =
        Circumstance { position: CIRCUMSTANCE.position.map(|x| SIZE_FACTOR * x), ..CIRCUMSTANCE };
    for (left, right) in SPEEDS {
        // v²/(g ℓ) is the same
        let faster = SIZE_FACTOR.sqrt();
        let one = icrs(&small, (left, right), &CIRCUMSTANCE);
        let other = icrs(&large, (faster * left, faster * right), &there);
        for (one, other) in one.into_iter().zip(other) {
            assert!((SIZE_FACTOR * one - other).abs() < 1e-8, "{left} {right}: {one} {other}");
        }
    }
}
