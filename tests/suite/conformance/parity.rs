//! The parity table: which invariances of the ICRs each effect breaks, measured and compared with
//! its card.

use trackdyn_core::frames::paper_twist_from_ros;
use trackdyn_core::{PerSide, Plant, Pose, Trajectory};
use trackdyn_model::effect::Symmetry;
use trackdyn_model::{ActiveEffect, CATALOGUE, Circumstance, Effects, Model};
use trackdyn_model::{Icrs, Stationary, Status, Transient};
use trackdyn_tests::auriga;

/// Change of an ICR, m, that breaks a symmetry: what a spin test can see.
const MIN_BREAK: f64 = 1e-3;

/// Change that rounding and quadrature may cause.
const MAX_ROUNDING: f64 = 1e-5;

/// Same-sign arc, counter-rotation and spin at full speed. One track is never stopped: that is the
/// border between patterns.
const PATTERNS: [(f64, f64); 3] = [(0.4, 1.0), (-0.4, 1.0), (-1.0, 1.0)];

/// Headings at which a direction of the world shows: none along an axis of the robot.
const HEADINGS: [f64; 3] = [0.6, 1.9, 3.5];

/// A vehicle with its centre of gravity in the middle plane, so that the mirror means something,
/// and forward of the centre, so that nothing cancels by a second symmetry.
fn model(effect: Option<ActiveEffect>) -> Model {
    let vehicle = auriga([0.0, 0.04], &[]).vehicle().clone();
    Model::new(vehicle, effect.into_iter().collect::<Effects>())
}

/// Where and when the robot stands.
const ORIGIN: Circumstance = Circumstance { position: [0.0, 0.0], heading: 0.0, time: 0.0 };

/// The ICRs that encoders and pose sensor show in steady motion.
fn icrs(model: &Model, (left, right): (f64, f64), circumstance: Circumstance) -> Icrs {
    let solution = Stationary::new(model, &circumstance).solve(PerSide::new(left, right));
    assert_eq!(solution.status, Status::Turning, "{left} {right} {:?}", model.effects());
    let reported = model.sensor().reported(&solution.twist);
    Icrs::of_motion(solution.track_speed, &reported).expect("a turning robot has ICRs")
}

/// How far the ICRs that encoders and pose sensor show while the speeds grow, from half to full in
/// a second, are from those of steady motion at the middle of that time.
fn transient_change(model: &Model, (left, right): (f64, f64)) -> f64 {
    const INTERVAL: f64 = 0.01;
    let shown = |step: u32| {
        let share = 0.5 + 0.5 * INTERVAL * f64::from(step);
        PerSide::new(share * left, share * right)
    };
    let mut robot = Transient::at_rest(model, -2.0, Pose::default());
    let mut path = Trajectory::default();
    path.push(robot.moment());
    robot.drive(shown(0), 0.0, &mut path).expect("it turns");
    for step in 1..=100 {
        robot.drive(shown(step), INTERVAL * f64::from(step), &mut path).expect("it turns");
    }
    let (step, t) = (50, 50.0 * INTERVAL);
    let reported = model.sensor().reported_path(&path);
    let twist = paper_twist_from_ros(&reported.twist_at(t));
    let growing = Icrs::of_motion(shown(step), &twist).expect("a turn");
    let pose = path.pose_at(t);
    let there = Circumstance { position: [pose.x, pose.y], heading: pose.yaw, time: t };
    distance(growing, icrs(model, (shown(step).left, shown(step).right), there))
}

fn distance(a: Icrs, b: Icrs) -> f64 {
    let (a, b) = (a.to_array(), b.to_array());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// How far a straight command leads astray, over its distance; a turn counts over 1 m.
fn astray(model: &Model, speed: f64) -> f64 {
    let solution = Stationary::new(model, &ORIGIN).solve(PerSide::new(speed, speed));
    let twist = model.sensor().reported(&solution.twist);
    (twist.v_x / speed).abs().max((twist.v_y / speed - 1.0).abs()).max((twist.w / speed).abs())
}

/// Largest change under the transformation of a symmetry: of an ICR, m, or of a straight run, 1.
fn change(model: &Model, symmetry: Symmetry) -> f64 {
    change_at(ORIGIN, model, symmetry)
}

/// The driving at another place and time.
fn change_at(start: Circumstance, model: &Model, symmetry: Symmetry) -> f64 {
    let mut worst = 0.0_f64;
    for heading in HEADINGS {
        let here = Circumstance { heading, ..start };
        for pattern in PATTERNS {
            let (left, right) = pattern;
            let base = icrs(model, pattern, here);
            let change = match symmetry {
                Symmetry::SpeedScale => {
                    distance(base, icrs(model, (0.25 * left, 0.25 * right), here))
                }
                Symmetry::Reversal => distance(base, icrs(model, (-left, -right), here)),
                Symmetry::Manoeuvre => distance(base, icrs(model, PATTERNS[0], here)),
                Symmetry::Mirror => {
                    let Icrs { x_left, x_right, y } = icrs(model, (right, left), here);
                    distance(base, Icrs { x_left: -x_right, x_right: -x_left, y })
                }
                Symmetry::Heading => distance(
                    base,
                    icrs(model, pattern, Circumstance { heading: HEADINGS[0], ..start }),
                ),
                Symmetry::Place => distance(
                    base,
                    icrs(model, pattern, Circumstance { position: [3.0, 0.5], ..here }),
                ),
                Symmetry::Time => {
                    distance(base, icrs(model, pattern, Circumstance { time: 60.0, ..here }))
                }
                Symmetry::Transient => transient_change(model, pattern),
                Symmetry::Straight => astray(model, 0.5).max(astray(model, -0.5)),
            };
            worst = worst.max(change);
            if matches!(symmetry, Symmetry::Transient | Symmetry::Straight)
                && heading != HEADINGS[0]
            {
                return worst;
            }
        }
    }
    worst
}

#[test]
fn base_model_breaks_nothing() {
    let model = model(None);
    for symmetry in Symmetry::ALL {
        let change = change(&model, symmetry);
        // Stationary balances are exact; a path in time has the tolerance of its steps.
        let allowed = if symmetry == Symmetry::Transient { 1e-6 } else { 1e-9 };
        assert!(change < allowed, "{}: {change} m", symmetry.letter());
    }
}

#[test]
fn every_effect_breaks_what_its_card_says() {
    println!("worst change of an ICR, mm; of a straight run, thousandths");
    print!("{:22}", "");
    for symmetry in Symmetry::ALL {
        print!("{:>8}", symmetry.letter());
    }
    println!();
    let mut wrong = Vec::new();
    for card in CATALOGUE.iter().filter(|card| !card.is_form()) {
        let effect = ActiveEffect::new(card.id, &[]).expect("typical sizes");
        let model = model(Some(effect));
        let changes = Symmetry::ALL.map(|symmetry| change(&model, symmetry));
        print!("{:22}", card.id);
        for change in changes {
            print!("{:8.2}", 1e3 * change);
        }
        println!();
        for (symmetry, change) in Symmetry::ALL.into_iter().zip(changes) {
            let breaks = card.breaks.contains(&symmetry);
            if (breaks && change < MIN_BREAK) || (!breaks && change > MAX_ROUNDING) {
                wrong.push(format!("{} {}: {change:.2e} m", card.id, symmetry.letter()));
            }
        }
    }
    assert!(wrong.is_empty(), "cards and measurement differ: {wrong:#?}");
}

#[test]
fn every_term_of_a_form_breaks_what_it_says() {
    /// Where and when a term that knows place and time is there.
    const ACTING_CIRCUMSTANCE: Circumstance =
        Circumstance { position: [2.0, 1.2], heading: 0.0, time: 30.0 };
    let mut wrong = Vec::new();
    for card in CATALOGUE {
        let mut of_all = Vec::new();
        for term in card.terms() {
            let parameter = |k: usize| &card.parameters[k];
            let coefficients = term.coefficients.iter().map(|&k| parameter(k));
            // Against the motion, as resistance is: what drives it along has no steady motion.
            let settings: Vec<_> = coefficients.map(|one| (one.key, -one.typical)).collect();
            let effect = ActiveEffect::new(card.id, &settings).expect("coefficients");
            let model = model(Some(effect));
            let changes =
                Symmetry::ALL.map(|symmetry| change_at(ACTING_CIRCUMSTANCE, &model, symmetry));
            print!("{:36}", term.key);
            for change in changes {
                print!("{:8.2}", 1e3 * change);
            }
            println!();
            for (symmetry, change) in Symmetry::ALL.into_iter().zip(changes) {
                let breaks = term.breaks.contains(&symmetry);
                if (breaks && change < MIN_BREAK) || (!breaks && change > MAX_ROUNDING) {
                    wrong.push(format!("{} {}: {change:.2e} m", term.key, symmetry.letter()));
                }
            }
            of_all.extend(term.breaks);
        }
        of_all.sort_unstable();
        of_all.dedup();
        if card.is_form() {
            assert_eq!(of_all, card.breaks, "{}: the card lists what its terms break", card.id);
        }
    }
    assert!(wrong.is_empty(), "terms and measurement differ: {wrong:#?}");
}
