//! Laws of a user: copies of laws of the catalogue do what these do.

mod diagnosed;
mod failing;

use trackdyn::ActiveEffect;
use trackdyn::crates::core::frames::paper_twist_from_ros;
use trackdyn::crates::core::{PerSide, Plant, Pose, STANDARD_GRAVITY, Trajectory, Twist};
use trackdyn::crates::model::contact::Resolution;
use trackdyn::crates::model::effect::Role;
use trackdyn::crates::model::{EffectId, Forces, Model, Stationary, Transient, VehicleFile};
use trackdyn::law::{Argument, Batch, CustomLaw, Declared, Outcome, Results, register};
use trackdyn::{Circumstance, Effects, Symmetry};

/// Largest difference between a law and its copy: forces over the weight, speeds in m/s. What
/// differences leave in a Jacobian does not move the root that is found by it.
const MAX_DIFFERENCE: f64 = 1e-9;

/// F = −k m ω × v, as the catalogue's `centripetal`.
fn turning(at: &Batch, values: &[f64], adds: &mut Results) -> Outcome {
    let column = |argument| at.column(argument);
    for k in 0..at.len() {
        let load = column(Argument::LeftLoad)[k] + column(Argument::RightLoad)[k];
        let factor = -values[0] * load / STANDARD_GRAVITY * column(Argument::YawRate)[k];
        adds.column(0)[k] = -factor * column(Argument::LateralSpeed)[k];
        adds.column(1)[k] = factor * column(Argument::ForwardSpeed)[k];
    }
    Ok(())
}

/// R = −c N sign(V) on both sides of Auriga-alpha, as the catalogue's `motion-resistance`.
fn rolling(at: &Batch, values: &[f64], adds: &mut Results) -> Outcome {
    let vehicle = VehicleFile::auriga_alpha().vehicle;
    // from the centre of gravity to the middle of a track
    let [left, right] = [-0.5, 0.5].map(|side| side * vehicle.gauge - vehicle.cog[0]);
    let sides = [
        (Argument::LeftBelt, Argument::LeftLoad, left),
        (Argument::RightBelt, Argument::RightLoad, right),
    ];
    for (belt, load, lever) in sides {
        for (k, (belt, load)) in at.column(belt).iter().zip(at.column(load)).enumerate() {
            let sense = if *belt == 0.0 { 0.0 } else { belt.signum() };
            let force = -values[0] * load * sense;
            adds.column(0)[k] += force;
            adds.column(2)[k] += force * lever;
        }
    }
    Ok(())
}

/// 1 + c |s|, as the catalogue's `viscous-friction`.
fn viscous(at: &Batch, values: &[f64], adds: &mut Results) -> Outcome {
    for place in [0, 1] {
        for (factor, slip) in adds.column(place).iter_mut().zip(at.column(Argument::SlipSpeed)) {
            *factor = 1.0 + values[0] * slip;
        }
    }
    Ok(())
}

/// Laws of the catalogue, and copies of them.
fn twins() -> Vec<[ActiveEffect; 2]> {
    let size = |key: &str, typical| [Declared::size(key, "1", typical).within([0.0, 10.0])];
    let made = [
        (CustomLaw::force("my-turn", "", &size("strength", 1.0), turning), "centripetal"),
        (CustomLaw::force("my-roll", "", &size("coefficient", 0.05), rolling), "motion-resistance"),
        (CustomLaw::friction("my-oil", "", &size("growth", 0.5), viscous), "viscous-friction"),
    ];
    let made = made.into_iter().map(|(law, twin)| {
        let law = law.expect("it can be defined");
        // said to read less, a law is faster and no other
        let law = match twin {
            "viscous-friction" => law.reading(&[Argument::SlipSpeed]),
            _ => law,
        };
        let copy = register(law).expect("it can be registered");
        let twin: ActiveEffect = twin.parse().expect("an effect");
        let values = copy.card().parameters.iter().map(|one| one.key).zip(twin.values().to_vec());
        [ActiveEffect::of(copy, &values.collect::<Vec<_>>()).expect("in range"), twin]
    });
    made.collect()
}

fn models(twins: [ActiveEffect; 2]) -> [Model; 2] {
    let inertia: Effects = Effects::none().with_inertia();
    twins.map(|effect| {
        // centripetal is one of Newton's own
        let mut effects = inertia.clone();
        effects.insert("centripetal:strength=0".parse().expect("an effect"));
        effects.insert(effect);
        Model::new(VehicleFile::auriga_alpha().vehicle, effects)
    })
}

#[test]
fn a_copy_of_a_law_has_its_forces_and_derivatives() {
    let twist = Twist { v_x: 0.41, v_y: 0.03, w: 0.72 };
    let (twist, rate) = (paper_twist_from_ros(&twist), Twist { v_x: 0.1, v_y: 0.2, w: -0.3 });
    for twins in twins() {
        let name = twins[0].to_string();
        let models = models(twins);
        let weight = models[0].vehicle().weight();
        for belts in [PerSide::new(0.2, 0.7), PerSide::new(-0.3, 0.6), PerSide::new(0.4, 0.4)] {
            let [copy, own] = models.each_ref().map(|model| {
                let ground = model.ground(&Circumstance::default());
                let forces = Forces { model, ground: &ground, creep: 1e-6 };
                (forces.sum(belts, &twist, &rate), forces.by_twist(belts, &twist, &rate))
            });
            let off = [(copy.0 - own.0).norm(), (copy.1 - own.1).norm()].map(|off| off / weight);
            assert!(off[0] < 1e-14 && off[1] < 1e-8, "{name} at {belts:?}: {off:?}");
        }
    }
}

#[test]
fn a_copy_of_a_law_has_its_stationary_motion() {
    for twins in twins() {
        let name = twins[0].to_string();
        for resolution in [Resolution::Fine, Resolution::Coarse] {
            let models = models(twins.clone()).map(|model| model.with_resolution(resolution));
            let mut largest = 0.0_f64;
            for k in 0..40_u32 {
                let (a, b) = (f64::from(k) * 0.618_034, f64::from(k) * 0.414_214);
                let speeds = PerSide::new(2.0 * a.fract() - 1.0, 2.0 * b.fract() - 1.0);
                let [copy, own] = models
                    .each_ref()
                    .map(|model| Stationary::new(model, &Circumstance::default()).solve(speeds));
                assert_eq!(copy.status, own.status, "{name} at {speeds:?}");
                let off = copy.twist - own.twist;
                largest = largest.max(off.v_x.hypot(off.v_y).hypot(off.w));
            }
            let bound = if resolution == Resolution::Fine { MAX_DIFFERENCE } else { 1e-6 };
            assert!(largest < bound, "{name}: {largest:.1e} m/s");
        }
    }
}

#[test]
fn a_copy_of_a_law_has_its_motion_in_time() {
    let drive = [(0.2, 0.8), (0.3, 0.5), (0.5, -0.5), (0.0, 0.0), (-0.4, -0.1), (0.4, 0.4)];
    for twins in twins() {
        let name = twins[0].to_string();
        let ends = models(twins).map(|model| {
            let mut path = Trajectory::default();
            let mut robot = Transient::at_rest(&model, 0.0, Pose::default()).with_step(0.02);
            for (k, (left, right)) in (1_u32..).zip(drive) {
                let until = 0.4 * f64::from(k);
                robot.drive(PerSide::new(left, right), until, &mut path).expect("it moves");
            }
            robot.moment().pose
        });
        let [copy, own] = ends;
        let off = (copy.x - own.x).hypot(copy.y - own.y).hypot(copy.yaw - own.yaw);
        assert!(own.x.hypot(own.y) > 0.1 && off < 1e-8, "{name}: {off:.1e} of {own:?}");
    }
}

/// Its card has the symmetries of its twin: they tell what driving shows it.
#[test]
fn a_copy_of_a_law_breaks_the_symmetries_of_its_twin() {
    for [copy, twin] in twins() {
        let mut breaks = twin.card().breaks.to_vec();
        if copy.card().id == "my-roll" {
            // Its levers are those of a robot whose centre of gravity is off the middle.
            breaks.push(Symmetry::Mirror);
            breaks.sort_unstable();
        }
        assert_eq!(copy.card().breaks, breaks, "{copy}");
    }
    let places = [Declared::size("rise", "1/m", 0.1), Declared::size("fade", "1/s", 0.1)];
    let patch = CustomLaw::friction("my-patch", "", &places, |at, values, adds| {
        let (x, time) = (at.column(Argument::PointX), at.column(Argument::Time));
        let heading = at.column(Argument::Heading);
        for place in [0, 1] {
            for (k, factor) in adds.column(place).iter_mut().enumerate() {
                *factor = 1.0 + values[0] * x[k].sin() + values[1] * (time[k] + heading[k].cos());
            }
        }
        Ok(())
    });
    let patch = register(patch.expect("it can be defined")).expect("registered");
    let expected = [Symmetry::Heading, Symmetry::Place, Symmetry::Time];
    let breaks = patch.card().breaks;
    assert!(expected.iter().all(|one| breaks.contains(one)), "{breaks:?}");
    assert!(!breaks.contains(&Symmetry::SpeedScale), "{breaks:?}");
}

#[test]
fn a_law_is_written_and_read_like_one_of_the_catalogue() {
    let [copy, _] = twins().remove(0);
    assert_eq!(copy.to_string().parse(), Ok(copy.clone()));
    let mut file = VehicleFile::auriga_alpha();
    file.effects.insert(copy.clone());
    let document = trackdyn::crates::core::document::Document::new("robot.toml", file.to_toml());
    assert_eq!(VehicleFile::from_document(&document).expect("it is known"), file);
    // registered again, the vehicle keeps its law and texts mean the new one
    let size = Declared::size("strength", "1", 3.0).within([0.0, 10.0]);
    let again = CustomLaw::force("my-turn", "", &[size], turning).expect("defined");
    let again = EffectId::register(again).expect("registered");
    assert_ne!(again, copy.effect());
    file.effects.insert(ActiveEffect::of(again, &[]).expect("typical"));
    assert_eq!(file.effects.iter().filter(|one| one.card().id == "my-turn").count(), 1);
    assert_eq!(EffectId::of("my-turn"), Some(again));

    let unknown = file.to_toml().replace("my-turn", "your-turn");
    let document = trackdyn::crates::core::document::Document::new("robot.toml", unknown);
    let error = VehicleFile::from_document(&document).expect_err("nobody defined it").to_string();
    assert!(error.contains("your-turn") && error.contains("or a law defined here"), "{error}");
}

#[test]
fn what_no_law_can_be_is_refused_by_name() {
    let refused = |id: &str, parameter: Declared| {
        let law = CustomLaw::force(id, "", &[parameter], turning);
        let law = law.and_then(|law| EffectId::register(law).map(|_| ()));
        law.expect_err("it cannot be").to_string()
    };
    let size = || Declared::size("strength", "1", 1.0);
    for (id, parameter, said) in [
        ("My Law", size(), "small letters and digits"),
        ("slope", size(), "another name"),
        ("my-law", Declared::size("a b", "1", 1.0), "parameter \"a b\""),
        ("my-law", size().within([2.0, 3.0]), "typical value 1"),
        ("my-law", Declared::size("strength", "1", 0.0), "does nothing"),
        ("my-law", Declared { role: Role::Shape, ..size() }, "no parameter is a size"),
    ] {
        let error = refused(id, parameter);
        assert!(error.contains(said) && error.contains(id), "{error}");
    }
}
