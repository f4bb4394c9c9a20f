//! Two simulators that share no physics agree where their laws are the same: the stationary balance
//! in closed form, and a rigid body on moving shoes in time.

use trackdyn_core::{PerSide, Plant, Trajectory, frames};
use trackdyn_model::{Circumstance, Model, RunningGear, Vehicle};
use trackdyn_model::{Stationary, Status};
use trackdyn_second_simulator::{ActiveMechanism, Robot, Setup};
use trackdyn_tests::{auriga, parse_effects};

/// Difference of an ICR in both, over the distance of the two ICRs. A shoe is a fortieth of the
/// contact, and shoes that act at their middles are off by the square of that.
const MAX_DIFFERENCE: f64 = 1.0 / (40.0 * 40.0);

const SPEEDS: [(f64, f64); 3] = [(0.3, 0.9), (-0.4, 1.0), (0.8, -0.8)];

fn in_time(vehicle: &Vehicle, active: &[ActiveMechanism], (left, right): (f64, f64)) -> [f64; 3] {
    let setup = Setup { strips: 14, shoes: 40, ..Setup::default() };
    let mut robot = Robot::new(vehicle, active, &setup).expect("a robot");
    let mut way = Trajectory::default();
    // the hull has leant after a second, and then a shoe passes
    let [from, until] = [1.0, 1.0 + 0.7 / 40.0 / left.abs()];
    for until in [from, until] {
        robot.drive(PerSide::new(left, right), until, &mut way).expect("a motion");
    }
    let twist = way.pose_at(from).relative(&way.pose_at(until)).log(until - from);
    let twist = frames::paper_twist_from_ros(&twist);
    // x_j = (V_j − v_y)/ω, y = v_x/ω
    [(left - twist.v_y) / twist.w, (right - twist.v_y) / twist.w, twist.v_x / twist.w]
}

fn in_balance(model: &Model, (left, right): (f64, f64)) -> [f64; 3] {
    let solver = Stationary::new(model, &Circumstance::default());
    let solution = solver.solve(PerSide::new(left, right));
    assert_eq!(solution.status, Status::Turning);
    solution.icrs.expect("a turning robot has ICRs").to_array()
}

fn compare(vehicle: &Vehicle, effects: &[&str]) {
    let model = Model::new(vehicle.clone(), parse_effects(effects));
    let active: Vec<ActiveMechanism> = parse_effects(effects)
        .iter()
        .map(|effect| {
            let keys = effect.card().parameters.iter().map(|parameter| parameter.key);
            let settings: Vec<_> = keys.zip(effect.values().iter().copied()).collect();
            ActiveMechanism::new(effect.card().id, &settings).expect("the same names")
        })
        .collect();
    for speeds in SPEEDS {
        let (time, balance) = (in_time(vehicle, &active, speeds), in_balance(&model, speeds));
        let off = time.iter().zip(balance).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        println!("{} {effects:?} {speeds:?}: {:.3} mm", vehicle.name, 1e3 * off);
        assert!(
            off < MAX_DIFFERENCE * (balance[1] - balance[0]),
            "{effects:?} {speeds:?}: {time:?} in time, {balance:?} in balance"
        );
    }
}

#[test]
fn both_simulators_turn_alike_where_their_laws_are_the_same() {
    let vehicle = auriga([-0.015, 0.04], &[]).vehicle().clone();
    let cases: [&[&str]; 7] = [
        &[],
        &["friction-split:split=0.1"],
        &["centripetal"],
        &["load-transfer:cog_height_m=0.2"],
        &["centripetal", "load-transfer:cog_height_m=0.2"],
        &["motion-resistance"],
        &["resistance-split"],
    ];
    for effects in cases {
        compare(&vehicle, effects);
    }
}

#[test]
fn wheels_too() {
    let axles = vec![0.256, -0.256];
    let vehicle = Vehicle {
        running_gear: RunningGear::Wheels { contact_length: 0.1, width: 0.12, axles },
        ..auriga([-0.015, 0.04], &[]).vehicle().clone()
    };
    compare(&vehicle, &[]);
    compare(&vehicle, &["centripetal"]);
}
