//! The stationary solver over random vehicles and speeds.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use trackdyn_core::{PerSide, STANDARD_GRAVITY, Side};
use trackdyn_model::contact::{Resolution, SlipField, friction_wrench};
use trackdyn_model::{ActiveEffect, Circumstance, Effects, Model, VehicleFile};
use trackdyn_model::{Stationary, Status};
use trackdyn_tests::{random_vehicle, uniform};

/// Residual over weight that a solution may have.
const TOLERANCE: f64 = 1e-10;

/// No track holds a robot that slides down: friction as a whole bears μ cos β of the weight, and
/// the slope pulls with sin β.
#[test]
fn a_slope_steeper_than_friction_holds_nobody() {
    let vehicle = VehicleFile::auriga_alpha().vehicle;
    let steepest = vehicle.friction.along.atan().to_degrees();
    for (above, speeds) in [0.3, 1.0, 2.0, 4.0, 8.0]
        .into_iter()
        .flat_map(|above| [[0.5, 0.6], [0.6, 0.5], [0.5, 0.5]].map(|speeds| (above, speeds)))
    {
        let [left, right] = speeds;
        let angle = steepest + above;
        // a heading of zero is the world's x: straight uphill
        let slope = ActiveEffect::new("slope", &[("angle_deg", angle), ("uphill_deg", 0.0)]);
        let model = Model::new(vehicle.clone(), Effects::from_iter(slope));
        let solver = Stationary::new(&model, &Circumstance::default());
        let status = solver.solve(PerSide::new(left, right)).status;
        let is_held = matches!(status, Status::Holds(_) | Status::Straight);
        assert!(!is_held, "{angle} deg, {speeds:?}: {status:?}");
    }
}

/// Solves `count` random vehicles, up to the tipping limit, at random speeds; every eighth pair is
/// a straight drive, a spin, one track stopped or nearly straight.
fn solve_random(count: u32, seed: u64) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (mut turning, mut held) = (0, 0);
    for case in 0..count {
        let vehicle = random_vehicle(&mut random, 0.999);
        vehicle.check().expect("a vehicle that stands");
        let left = uniform(&mut random, -1.0, 1.0);
        let right = match case % 8 {
            0 => [left, -left, 0.0, left + 1e-12][(case as usize / 8) % 4],
            _ => uniform(&mut random, -1.0, 1.0),
        };
        let model = Model::new(vehicle, Effects::none());
        let speed = PerSide::new(left, right);
        let solution = Stationary::new(&model, &Circumstance::default()).solve(speed);
        let context = || format!("case {case} of seed {seed}: {solution:?}, {:?}", model.vehicle());
        assert!(solution.residual <= TOLERANCE, "{}", context());
        match solution.status {
            Status::Turning => {
                turning += 1;
                let icrs = solution.icrs.expect("a turning robot has ICRs");
                assert!(icrs.x_right > icrs.x_left && left != right, "{}", context());
            }
            Status::Straight => {
                assert_eq!(left, right);
                assert_eq!((solution.twist.v_y, solution.twist.w), (left, 0.0));
            }
            Status::Holds(side) => {
                held += 1;
                // The side with more weight holds, and sets the speed.
                assert!(side.sign() * model.vehicle().cog[0] >= 0.0, "{}", context());
                assert_eq!(solution.twist.v_y, speed[side]);
                assert_eq!(solution.twist.w, 0.0);
            }
            Status::Tips | Status::NotConverged => panic!("{}", context()),
        }
    }
    // Both kinds occur: the test covers the boundary between them.
    assert!(turning > count / 10 && held > count / 10, "{turning} turning, {held} held");
}

#[test]
fn ten_thousand_random_vehicles_converge() {
    solve_random(10_000, 1);
}

#[test]
#[ignore = "a million solves: cargo test --release -p trackdyn-tests -- --ignored"]
fn a_million_random_vehicles_converge() {
    solve_random(1_000_000, 2);
}

/// A track that is said to hold can hold. With μ_x = μ_y friction is associated, and a wrench W is
/// within a track's limit surface if and only if W·ξ ≤ D(ξ) for every slip ξ, D being the power
/// that friction dissipates (the principle of maximum dissipation): no equation of the solver
/// enters.
#[test]
fn tracks_that_hold_stay_within_their_limit_surface() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let mut held = 0;
    while held < 300 {
        let mut vehicle = random_vehicle(&mut random, 0.99);
        vehicle.friction.along = vehicle.friction.across;
        let (friction, gauge) = (vehicle.friction, vehicle.gauge);
        let model = Model::new(vehicle, Effects::none());
        let speed = PerSide::new(-0.2, 0.7);
        let solution = Stationary::new(&model, &Circumstance::default()).solve(speed);
        let Status::Holds(anchor) = solution.status else { continue };
        held += 1;

        let weight = model.vehicle().mass * STANDARD_GRAVITY;
        let share = |side: Side| 0.5 + side.sign() * model.vehicle().cog[0] / gauge;
        let pressure = |side| {
            let load = weight * share(side);
            model.footprint().pressure(load, model.vehicle().cog[1])
        };
        // The other belt slips straight, s = (0, V_anchor − V_other), with all its friction.
        let other = anchor.other();
        let pull = friction.along * weight * share(other);
        let force_y = -pull * (speed[anchor] - speed[other]).signum();
        let demand = [0.0, -force_y, -other.sign() * gauge / 2.0 * force_y];
        for _ in 0..200 {
            let centre = anchor.sign() * gauge / 2.0;
            let x = centre + gauge * uniform(&mut random, -2.0, 2.0).powi(3);
            let y = gauge * uniform(&mut random, -2.0, 2.0).powi(3);
            let sense = if random.random() { 1.0 } else { -1.0 };
            let slip =
                SlipField { lateral: sense * y, forward: -sense * x, rotation: sense, speed: 1.0 };
            let patches = model.patches()[anchor].iter().copied();
            let wrench =
                friction_wrench(patches, friction, &pressure(anchor), &slip, Resolution::Fine);
            let power = |[x, y, moment]: [f64; 3]| {
                x * slip.lateral + y * slip.forward + moment * slip.rotation
            };
            let dissipated = -power([wrench.force_x, wrench.force_y, wrench.moment]);
            assert!(power(demand) <= dissipated * (1.0 + 1e-9), "{:?}", model.vehicle());
        }
    }
}
