//! A robot that is thrown over the ground with its tracks locked.

use crate::second_simulator::turn::{auriga, typical};
use trackdyn_core::{PerSide, Plant, STANDARD_GRAVITY, Trajectory, Twist};
use trackdyn_second_simulator::{Robot, Setup};

#[test]
fn friction_takes_energy_and_gives_none() {
    let active = typical(&["yaw-inertia", "centripetal"]);
    let vehicle = auriga([-0.015, 0.04]);
    for twist in [
        Twist { v_x: 2.0, v_y: 0.0, w: 0.0 },
        Twist { v_x: 1.0, v_y: -1.5, w: 3.0 },
        Twist { v_x: 0.0, v_y: 0.0, w: -5.0 },
    ] {
        let mut robot = Robot::new(&vehicle, &active, &Setup::default()).expect("a robot");
        robot.throw(&twist);
        let mut before = robot.kinetic_energy();
        let whole = before;
        let mut way = Trajectory::default();
        // At the end shoes spring back from their elastic deflection, ½ μ m g z₀ = 6 mJ.
        let elastic = 0.9 * vehicle.mass * STANDARD_GRAVITY * 5e-6 / 2.0;
        for k in 1..=2000 {
            let until = 1e-3 * f64::from(k);
            robot.drive(PerSide::new(0.0, 0.0), until, &mut way).expect("a motion");
            let energy = robot.kinetic_energy();
            assert!(
                energy <= before || energy < elastic,
                "{energy} J after {before} J at {until} s"
            );
            before = energy;
        }
        assert!(before < 1e-6 * whole, "{before} J of {whole} J are left");
    }
}

#[test]
fn a_robot_that_slides_straight_stops_after_v_squared_over_two_mu_g() {
    let active = typical(&["yaw-inertia", "centripetal"]);
    let mut robot = Robot::new(&auriga([0.0, 0.0]), &active, &Setup::default()).expect("a robot");
    robot.throw(&Twist { v_x: 2.0, v_y: 0.0, w: 0.0 });
    let mut way = Trajectory::default();
    robot.drive(PerSide::new(0.0, 0.0), 1.0, &mut way).expect("a motion");
    let expected = 2.0_f64.powi(2) / (2.0 * 0.7 * STANDARD_GRAVITY);
    let slid = robot.moment().pose.x;
    println!("slides {slid:.5} m, expected {expected:.5} m");
    // implicit Euler steps of 0.7 ms lag behind by half a step of 2 m/s
    assert!((slid - expected).abs() < 1e-3, "{slid} {expected}");
}
