//! The stationary solver over random vehicles and speeds.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use trackdyn_core::PerSide;
use trackdyn_motion::{Stationary, Status};
use trackdyn_physics::{Circumstance, Effects, Model};
use trackdyn_tests::{random_vehicle, uniform};

/// Residual over weight that a solution may have.
const TOLERANCE: f64 = 1e-10;

/// Solves `count` random vehicles, up to the tipping limit, at random speeds; every eighth pair is a
/// straight drive, a spin, one track stopped or nearly straight.
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
            Status::Lifts | Status::NotConverged => panic!("{}", context()),
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
#[ignore = "a million solves take seconds in release and minutes in debug: cargo test --release -- --ignored"]
fn a_million_random_vehicles_converge() {
    solve_random(1_000_000, 2);
}
