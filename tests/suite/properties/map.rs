//! The constancy theorem, symmetries of the map, and its independence of threads.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use trackdyn_core::{PerSide, Side, Wrench};
use trackdyn_model::{Circumstance, Effects, Model, Motion};
use trackdyn_model::{Grid, IcrMap, Solution, Stationary, Status};
use trackdyn_tests::{auriga, parse_effects, random_vehicle};

fn map(model: &Model, points: usize) -> IcrMap {
    let grid = Grid::new(points, Grid::PAPER_SPEED).expect("a grid");
    IcrMap::solve(model, grid, &Circumstance::default(), &|_| ())
}

/// In the base model the balance knows neither V_l, V_r nor |w|: the map is one point.
#[test]
fn base_map_is_one_point() {
    let mut random = ChaCha8Rng::seed_from_u64(21);
    let mut seen = 0;
    for _ in 0..60 {
        let model = Model::new(random_vehicle(&mut random, 0.8), Effects::none());
        let map = map(&model, 11);
        let Some(statistics) = map.statistics() else { continue };
        seen += 1;
        // All pairs but V_l = V_r turn, or none does.
        assert_eq!(statistics.count, 110);
        let size = model.vehicle().gauge + model.footprint().ends[1];
        for spread in statistics.spread.to_array() {
            assert!(spread < 1e-9 * size.max(1.0), "{spread} {:?}", model.vehicle());
        }
    }
    assert!(seen > 20, "{seen} vehicles turned");
}

/// It depends on friction through μ_x/μ_y alone, and neither on mass.
#[test]
fn base_map_knows_only_the_ratio_of_frictions() {
    let reference = auriga([-0.015, 0.04], &[]);
    let mut vehicle = reference.vehicle().clone();
    vehicle.mass *= 7.0;
    vehicle.friction.across *= 0.31;
    vehicle.friction.along *= 0.31;
    let other = Model::new(vehicle, Effects::none());
    let icrs = |model| map(model, 3).statistics().expect("it turns").mean.to_array();
    for (a, b) in icrs(&reference).iter().zip(icrs(&other)) {
        assert!((a - b).abs() < 1e-12);
    }
}

/// A mirrored vehicle with mirrored speeds has mirrored ICRs.
#[test]
fn mirrored_vehicles_move_mirrored() {
    let effects = ["centripetal", "load-transfer:cog_height_m=0.1", "motion-resistance"];
    let model = auriga([-0.05, 0.04], &effects);
    let mirrored = auriga([0.05, 0.04], &effects);
    let solve = |model, left, right| -> Solution {
        Stationary::new(model, &Circumstance::default()).solve(PerSide::new(left, right))
    };
    for (left, right) in [(0.3, 0.9), (-0.5, 0.5), (0.0, 0.7), (-0.9, -0.2), (0.4, 0.4)] {
        let (a, b) = (solve(&model, left, right), solve(&mirrored, right, left));
        let (p, q) = (a.icrs.expect("turns"), b.icrs.expect("turns"));
        for error in [p.x_left + q.x_right, p.x_right + q.x_left, p.y - q.y] {
            // Straight drives are limits of a left turn, which the mirror makes a right turn.
            assert!(
                error.abs() < 1e-10 || a.status == Status::Straight,
                "{error} at {left} {right}"
            );
        }
        assert!((a.twist.w + b.twist.w).abs() < 1e-12);
    }
}

/// Without effects, what the tracks put in is what friction dissipates: F_l V_l + F_r V_r > 0.
#[test]
fn tracks_drive_and_friction_dissipates() {
    let model = auriga([-0.015, 0.04], &[]);
    let ground = model.ground(&Circumstance::default());
    for solution in map(&model, 9).turning() {
        let icrs = solution.icrs.expect("turns");
        let turn = 1.0 / (icrs.x_right - icrs.x_left);
        let motion = trackdyn_model::Motion::anchored(
            solution.belt_speed,
            trackdyn_core::Side::Left,
            [icrs.x_left, icrs.y],
            turn,
        );
        let friction = model.balance(&ground, &motion).friction;
        let power = friction.left.force_y * solution.belt_speed.left
            + friction.right.force_y * solution.belt_speed.right;
        assert!(power > 0.0, "{power} W at {:?}", solution.belt_speed);
    }
}

/// Equal speeds: no slip, the robot moves straight at that speed.
#[test]
fn equal_speeds_drive_straight() {
    let model = auriga([-0.015, 0.04], &["centripetal"]);
    let solver = Stationary::new(&model, &Circumstance::default());
    for speed in [-1.0, 0.0, 0.3] {
        let solution = solver.solve(PerSide::new(speed, speed));
        assert_eq!(solution.status, Status::Straight);
        assert_eq!((solution.twist.v_x, solution.twist.v_y, solution.twist.w), (0.0, speed, 0.0));
        // The limit of slow turning is the base model's point.
        let icrs = solution.icrs.expect("a limit");
        assert!((icrs.x_left + 0.37538).abs() < 1e-5 && (icrs.y - 0.04923).abs() < 1e-5);
    }
}

/// A faster turn lifts part of the contact, a still faster one tips the robot over: a gap in the
/// map, not an abort.
#[test]
fn fast_turns_lift_and_then_tip() {
    let model = auriga([0.0, 0.112], &["centripetal", "load-transfer:cog_height_m=1"]);
    let grid = Grid::new(21, 3.0).expect("a grid");
    let map = IcrMap::solve(&model, grid, &Circumstance::default(), &|_| ());
    let counts = map.counts();
    assert!(counts[Status::Tips.index()] > 20, "{counts:?}");
    assert!(counts[Status::Turning.index()] > 200, "{counts:?}");
    // Forward of l/6 = 0.117 m part of the contact has lifted, however slow the robot is.
    let lifted = self::map(&auriga([0.0, 0.2], &[]), 11);
    assert_eq!(lifted.lifted().count(), 121);
    assert_eq!(lifted.counts()[Status::Turning.index()], 110);
    assert_eq!(map.statistics().expect("slow turns").count, counts[Status::Turning.index()]);
    // At a third of the speed all is well.
    let slow = self::map(&model, 21);
    assert_eq!(slow.counts()[Status::Turning.index()], 420);
}

#[test]
fn maps_do_not_depend_on_the_number_of_threads() {
    let model = auriga([-0.015, 0.04], &["centripetal", "load-transfer:cog_height_m=0.05"]);
    let with_threads = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| map(&model, 15)).solutions
    };
    assert_eq!(with_threads(1), with_threads(3));
}

#[test]
fn order_of_effects_does_not_matter() {
    let names = ["slope:uphill_deg=40", "centripetal", "viscous-friction"];
    let mut reversed = names;
    reversed.reverse();
    assert_eq!(parse_effects(&names), parse_effects(&reversed));
}

/// A pressure that is not linear and a stress that needs none add up: neither is a factor on the
/// other.
#[test]
fn stresses_of_pressure_and_cohesion_add_up() {
    let effects = ["pressure-concentration:concentration=0.6", "cohesion:stress_pa=3000"];
    let friction = |effects: &[&str]| {
        let model = auriga([0.01, 0.1], effects);
        let motion = Motion::anchored(PerSide::new(0.2, 0.5), Side::Left, [-0.4, 0.1], 1.2);
        let balance = model.balance(&model.ground(&Circumstance::default()), &motion);
        Side::BOTH.map(|side| {
            let Wrench { force_x, force_y, moment } = balance.friction[side];
            [force_x, force_y, moment]
        })
    };
    let [base, first, second] = [&[][..], &effects[..1], &effects[1..]].map(friction);
    let both = friction(&effects);
    for side in 0..2 {
        for k in 0..3 {
            let sum = first[side][k] + second[side][k] - base[side][k];
            assert!((both[side][k] - sum).abs() < 1e-9 * base[side][0].hypot(base[side][1]));
        }
    }
}
