//! The parity table: which invariances of the ICRs each effect breaks, measured and compared with its
//! card.

use trackdyn_core::PerSide;
use trackdyn_motion::{Icrs, Stationary, Status};
use trackdyn_physics::effect::Symmetry;
use trackdyn_physics::{ActiveEffect, CATALOGUE, Circumstance, Effects, Model};
use trackdyn_tests::auriga;

/// Change of an ICR, m, that breaks a symmetry: what a spin test can see.
const BROKEN: f64 = 1e-3;

/// Change that rounding and quadrature may cause.
const INTACT: f64 = 1e-5;

/// Same-sign arc, counter-rotation and spin at full speed. One track is never stopped: that is the
/// border between patterns.
const PATTERNS: [(f64, f64); 3] = [(0.4, 1.0), (-0.4, 1.0), (-1.0, 1.0)];

/// Headings at which a direction of the world shows: none along an axis of the robot.
const HEADINGS: [f64; 3] = [0.6, 1.9, 3.5];

/// A vehicle with its centre of gravity in the middle plane, so that the mirror means something, and
/// forward of the centre, so that nothing cancels by a second symmetry.
fn model(effect: Option<ActiveEffect>) -> Model {
    let vehicle = auriga([0.0, 0.04], &[]).vehicle().clone();
    Model::new(vehicle, effect.into_iter().collect::<Effects>())
}

fn icrs(model: &Model, (left, right): (f64, f64), heading: f64) -> Icrs {
    let solver = Stationary::new(model, &Circumstance { heading });
    let solution = solver.solve(PerSide::new(left, right));
    assert_eq!(solution.status, Status::Turning, "{left} {right} {:?}", model.effects());
    solution.icrs.expect("a turning robot has ICRs")
}

fn distance(a: Icrs, b: Icrs) -> f64 {
    let (a, b) = (a.to_array(), b.to_array());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Largest change of an ICR under the transformation of a symmetry, m.
fn change(model: &Model, symmetry: Symmetry) -> f64 {
    let mut worst = 0.0_f64;
    for heading in HEADINGS {
        for pattern in PATTERNS {
            let (left, right) = pattern;
            let base = icrs(model, pattern, heading);
            let other = match symmetry {
                Symmetry::SpeedScale => icrs(model, (0.25 * left, 0.25 * right), heading),
                Symmetry::Reversal => icrs(model, (-left, -right), heading),
                Symmetry::Manoeuvre => icrs(model, PATTERNS[0], heading),
                Symmetry::Mirror => {
                    let Icrs { x_left, x_right, y } = icrs(model, (right, left), heading);
                    Icrs { x_left: -x_right, x_right: -x_left, y }
                }
                Symmetry::Heading => icrs(model, pattern, HEADINGS[0]),
            };
            worst = worst.max(distance(base, other));
        }
    }
    worst
}

#[test]
fn base_model_breaks_nothing() {
    let model = model(None);
    for symmetry in Symmetry::ALL {
        let change = change(&model, symmetry);
        assert!(change < 1e-9, "{}: {change} m", symmetry.letter());
    }
}

#[test]
fn every_effect_breaks_what_its_card_says() {
    println!("worst change of an ICR, mm");
    println!("{:20}{:>8}{:>8}{:>8}{:>8}{:>8}", "", "S", "R", "P", "M", "H");
    let mut wrong = Vec::new();
    for card in CATALOGUE {
        let effect = ActiveEffect::new(card.id, &[]).expect("typical sizes");
        let model = model(Some(effect));
        let changes = Symmetry::ALL.map(|symmetry| change(&model, symmetry));
        print!("{:20}", card.id);
        for change in changes {
            print!("{:8.2}", 1e3 * change);
        }
        println!();
        for (symmetry, change) in Symmetry::ALL.into_iter().zip(changes) {
            let breaks = card.breaks.contains(&symmetry);
            if (breaks && change < BROKEN) || (!breaks && change > INTACT) {
                wrong.push(format!("{} {}: {change:.2e} m", card.id, symmetry.letter()));
            }
        }
    }
    assert!(wrong.is_empty(), "cards and measurement differ: {wrong:#?}");
}
