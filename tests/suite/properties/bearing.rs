//! Contact that lifts: the pressure that remains, its wrench and derivatives, and the motions of
//! robots that stand on part of their contact.

use crate::properties::tanh_sinh;
use nalgebra::{Matrix2, Vector2, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use trackdyn_core::{Dual, PerSide, Scalar, Side, Twist};
use trackdyn_model::contact::pressure::Footprint;
use trackdyn_model::contact::{Bearing, Patch, Pressure};
use trackdyn_model::{
    Circumstance, Effects, Forces, Model, Motion, Stationary, Status, Support, Vehicle,
};
use trackdyn_tests::{parse_effects, random_vehicle, uniform};

/// A vehicle with its centre of gravity at this share of the way from where an end begins to lift
/// (0) to where the robot tips over it (1).
fn lifting(random: &mut ChaCha8Rng, share: f64) -> Vehicle {
    let mut vehicle = random_vehicle(random, 0.9);
    let footprint = Footprint::of(&vehicle.patches(Side::Left));
    let end = usize::from(uniform(random, 0.0, 1.0) < 0.5);
    let [begins, tips] = [footprint.support()[end], footprint.ends[end]];
    vehicle.cog[1] = begins + share * (tips - begins);
    vehicle
}

/// ∫ p dA and ∫ y p dA over the patches, of max(0, p): the sum over what presses.
fn load_and_moment(patches: &[Patch], pressure: &Pressure) -> [f64; 2] {
    let zero = -pressure.at_origin / pressure.gradient;
    let parts = patches.iter().map(|patch| {
        let v = patch.y.map(|y| y - zero);
        tanh_sinh::integrate(patch.x, v, |_, v| {
            let pressure = (pressure.gradient * v).max(0.0);
            [pressure, (v + zero) * pressure]
        })
    });
    parts.fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]])
}

/// The pressure (at the origin and its gradient) of one newton at y_p by its potential: what is
/// stored in springs less the work of the load, ½ ∫ max(0, p)² dA − (p(0) + y_p p′), is least.
fn by_least_energy(patches: &[Patch], centre_of_pressure: f64) -> Pressure {
    // Its gradient is the balance, its second derivatives are the moments of what presses.
    let moments = |[a, b]: [f64; 2]| {
        let mut sums = [0.0; 3];
        for patch in patches {
            let [low, high] = patch.y;
            let zero = -a / b;
            let (low, high) = if b > 0.0 { (low.max(zero), high) } else { (low, high.min(zero)) };
            if low < high {
                for (power, sum) in (1_i32..).zip(&mut sums) {
                    let part = (high.powi(power) - low.powi(power)) / f64::from(power);
                    *sum += patch.width() * part;
                }
            }
        }
        sums
    };
    let energy = |z: Vector2<f64>| {
        let [m0, m1, m2] = moments(z.into());
        0.5 * (z[0] * z[0] * m0 + 2.0 * z[0] * z[1] * m1 + z[1] * z[1] * m2)
            - (z[0] + centre_of_pressure * z[1])
    };
    let footprint = Footprint::of(patches);
    let start = footprint.pressure(1.0, centre_of_pressure);
    let mut z = Vector2::new(start.at_origin, start.gradient);
    for _ in 0..200 {
        let [m0, m1, m2] = moments(z.into());
        let slope =
            Vector2::new(z[0] * m0 + z[1] * m1 - 1.0, z[0] * m1 + z[1] * m2 - centre_of_pressure);
        let Some(step) = Matrix2::new(m0, m1, m1, m2).lu().solve(&slope) else { break };
        let mut share = 1.0;
        while energy(z - share * step) > energy(z) && share > 1e-6 {
            share *= 0.5;
        }
        z -= share * step;
    }
    Pressure { at_origin: z[0], gradient: z[1] }
}

#[test]
fn what_bears_carries_the_load_at_its_centre() {
    let mut random = ChaCha8Rng::seed_from_u64(21);
    for _ in 0..400 {
        let share = uniform(&mut random, 0.0, 0.98);
        let vehicle = lifting(&mut random, share);
        let patches = vehicle.patches(Side::Left);
        let footprint = Footprint::of(&patches);
        let y = vehicle.cog[1];
        let bearing = Bearing::of(&patches, &footprint, y);
        let Bearing::Part { edge, .. } = bearing else { panic!("it lifts: {vehicle:?}") };
        let pressure = bearing.pressure(&footprint, 1.0);
        let size = footprint.ends[1] - footprint.ends[0];
        let [load, moment] = load_and_moment(&patches, &pressure);
        assert!((load - 1.0).abs() < 1e-9, "{load} N of 1 N: {vehicle:?}");
        assert!((moment - y).abs() < 1e-9 * size, "{moment} at {y}: {vehicle:?}");
        // It vanishes at the edge, and nothing pulls.
        assert!(pressure.at(edge).abs() < 1e-9 * pressure.gradient.abs() * size);
        for part in patches.iter().filter_map(|patch| bearing.pressed(patch)) {
            let least = part.y.map(|y| pressure.at(y)).into_iter().fold(f64::INFINITY, f64::min);
            assert!(least > -1e-9 * pressure.gradient.abs() * size, "{least} Pa: {vehicle:?}");
        }
        let other = by_least_energy(&patches, y);
        let scale = pressure.gradient.abs();
        assert!((pressure.gradient - other.gradient).abs() < 1e-7 * scale, "{vehicle:?}");
        assert!((pressure.at_origin - other.at_origin).abs() < 1e-7 * scale * size);
    }
}

/// A track that is lifted in part is a triangle of pressure over three times the distance from the
/// load to the end.
#[test]
fn a_track_becomes_a_shorter_one() {
    let patch = Patch::centred([0.0, 0.0], 0.2, 1.2);
    let footprint = Footprint::of(&[patch]);
    let bearing = Bearing::of(&[patch], &footprint, 0.4);
    let pressed = bearing.pressed(&patch).expect("its front bears");
    assert!((pressed.y[0] - 0.0).abs() < 1e-15 && pressed.y[1] == 0.6, "{pressed:?}");
    // 2 N/(b c) at the loaded end
    let highest = bearing.pressure(&footprint, 30.0).at(0.6);
    assert!((highest - 2.0 * 30.0 / (0.2 * 0.6)).abs() < 1e-10, "{highest}");
    assert_eq!(Bearing::of(&[patch], &footprint, 0.2), Bearing::Whole(0.2));
}

/// Where an end lifts, the edge of the contact comes in from its end, and pressure and edge go on
/// with one slope.
#[test]
fn lift_off_is_smooth() {
    const STEP: f64 = 1e-8;
    let mut random = ChaCha8Rng::seed_from_u64(22);
    for _ in 0..200 {
        let vehicle = lifting(&mut random, 0.0);
        let patches = vehicle.patches(Side::Left);
        let footprint = Footprint::of(&patches);
        let size = footprint.ends[1] - footprint.ends[0];
        let at = |steps: f64| {
            let [y] = Dual::<1>::variables([vehicle.cog[1] + steps * STEP * size]);
            Bearing::of(&patches, &footprint, y).pressure(&footprint, Dual::from(1.0))
        };
        let (before, after) = (at(-1.0), at(1.0));
        let steepest = before.gradient.gradient[0].abs();
        for (a, b, unit) in [
            (before.at_origin, after.at_origin, steepest * size),
            (before.gradient, after.gradient, steepest),
        ] {
            let slope = a.gradient[0];
            let expected = a.value() + 2.0 * STEP * size * slope;
            assert!((b.value() - expected).abs() < 1e-3 * unit * STEP * size, "{vehicle:?}");
            assert!((b.gradient[0] - slope).abs() < 1e-3 * unit, "{vehicle:?}");
        }
    }
}

/// Laws that see pressure, place in the patch or point of entry, beside the base law.
const LAWS: [&[&str]; 4] = [
    &["load-transfer:cog_height_m=0.4", "yaw-inertia:strength=1,gyration_m=0.3", "centripetal"],
    &["load-transfer:cog_height_m=0.4", "yaw-inertia", "shear-displacement:modulus_m=0.05"],
    &["load-transfer:cog_height_m=0.4", "yaw-inertia", "pressure-concentration"],
    &["load-transfer:cog_height_m=0.4", "yaw-inertia", "cohesion"],
];

/// Acceleration moves the edge. With laws that are not zero where the pressure is, the moving edge
/// counts by itself.
#[test]
fn forces_of_a_lifted_contact_have_exact_derivatives() {
    let mut random = ChaCha8Rng::seed_from_u64(23);
    let mut lifted = 0;
    for case in 0..400 {
        let vehicle = lifting(&mut random, 0.3);
        let size = vehicle.gauge;
        let model = Model::new(vehicle, parse_effects(LAWS[case % LAWS.len()]));
        let ground = model.ground(&Circumstance::default());
        let forces = Forces { model: &model, ground: &ground, creep: 1e-6 };
        let mut any = |scale: f64| uniform(&mut random, -scale, scale);
        let belts = PerSide::new(any(1.0), any(1.0));
        let twist = Twist { v_x: any(0.3), v_y: any(1.0), w: any(1.0) / size };
        let rate = Twist { v_x: any(0.2) * size, v_y: any(0.2) * size, w: any(0.2) };
        let departure = Twist { v_y: twist.v_y - belts.left, ..twist };
        let motion = Motion::departing(belts, departure, rate, model.extent());
        if model.support(&ground, &motion) != Support::Part {
            continue;
        }
        lifted += 1;
        let exact = forces.by_rate(belts, &twist, &rate);
        for column in 0..3 {
            let unit = if column == 2 { 1.0 } else { size };
            let at = |steps: f64| {
                let mut moved = rate.to_array();
                moved[column] += steps * 1e-4 * unit;
                let [v_x, v_y, w] = moved;
                forces.sum(belts, &twist, &Twist { v_x, v_y, w })
            };
            let quotient =
                (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * 1e-4 * unit);
            let scale = Vector3::new(1.0, 1.0, size) * model.vehicle().weight() / unit;
            let error = (exact.column(column) - quotient).component_div(&scale).amax();
            assert!(error < 1e-5, "case {case}, column {column}: {error}\n{:?}", model.vehicle());
        }
    }
    assert!(lifted > 200, "{lifted} of 400 lift");
}

/// Stationary motions of robots that stand on part of their contact, up to tipping, with loads that
/// shift as they turn.
fn solve_lifted(count: usize, seed: u64) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (mut lifted, mut tipped) = (0, 0);
    let mut unsolved = Vec::new();
    for case in 0..count {
        let share = uniform(&mut random, -0.5, 1.0);
        let vehicle = lifting(&mut random, share);
        let speeds = PerSide::from_fn(|_| uniform(&mut random, -1.0, 1.0) * vehicle.gauge.sqrt());
        let height = uniform(&mut random, 0.0, 1.0) * vehicle.gauge;
        let transfer = format!("load-transfer:cog_height_m={}", height.min(5.0));
        let effects = if case % 2 == 0 {
            Effects::none()
        } else {
            parse_effects(&["centripetal", &transfer])
        };
        let friction = vehicle.friction;
        let model = Model::new(vehicle, effects);
        let solution = Stationary::new(&model, &Circumstance::default()).solve(speeds);
        match solution.status {
            Status::NotConverged => unsolved.push((case, share, speeds)),
            Status::Tips => tipped += 1,
            Status::Turning => {
                lifted += usize::from(solution.is_lifted);
                // Friction takes energy, and no more than its coefficient allows.
                let icrs = solution.icrs.expect("it turns");
                let turn = 1.0 / (icrs.x_right - icrs.x_left);
                let anchor = [icrs.x_left, icrs.y];
                let motion = Motion::anchored(speeds, Side::Left, anchor, turn);
                let balance = model.balance(&model.ground(&Circumstance::default()), &motion);
                for side in Side::BOTH {
                    let (wrench, slip) = (balance.friction[side], motion.slip[side]);
                    let power = wrench.force_x * slip.lateral
                        + wrench.force_y * slip.forward
                        + wrench.moment * slip.rotation;
                    assert!(power <= 0.0, "case {case}: {power}");
                    let grip = friction.across.max(friction.along) * balance.normal_load[side];
                    let force = wrench.force_x.hypot(wrench.force_y);
                    assert!(force <= grip * (1.0 + 1e-9), "case {case}: {force} N of {grip} N");
                }
            }
            Status::Straight | Status::Holds(_) => {}
        }
    }
    println!("of {count}: {lifted} lifted, {tipped} tipped");
    assert!(lifted > count / 10, "{lifted} of {count}");
    assert!(unsolved.is_empty(), "{} unsolved: {unsolved:?}", unsolved.len());
}

#[test]
fn robots_on_part_of_their_contact_move() {
    solve_lifted(4000, 24);
}

#[test]
#[ignore = "a hundred thousand robots: cargo test --release -p trackdyn-tests -- --ignored"]
fn a_hundred_thousand_robots_on_part_of_their_contact_move() {
    solve_lifted(100_000, 25);
}
