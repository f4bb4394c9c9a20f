//! Mass in transients, and what is left of it where it is switched off.

use crate::second_simulator::turn::{auriga, typical};
use trackdyn_core::{PerSide, Plant, Trajectory};
use trackdyn_second_simulator::{Robot, Setup};

/// Way of the belt that a spin from rest to a speed lacks against one that is steady at once, m.
fn way_lost(ids: &[&str], speed: f64) -> f64 {
    let setup = Setup { shortest_step: 5e-5, speed_change: 1e-3, ..Setup::default() };
    let robot = Robot::new(&auriga([0.0, 0.0]), &typical(ids), &setup);
    let mut robot = robot.expect("a robot");
    let mut way = Trajectory::default();
    let [from, until] = [2.0, 3.0];
    way.push(robot.moment());
    robot.drive(PerSide::new(-speed, speed), from, &mut way).expect("a motion");
    robot.drive(PerSide::new(-speed, speed), until, &mut way).expect("a motion");
    let yaw = |t| way.pose_at(t).yaw;
    speed * (from - yaw(from) / (yaw(until) - yaw(from)) * (until - from))
}

#[test]
fn mass_costs_way_with_the_square_of_the_speed() {
    let [slow, fast] = [0.2, 0.4].map(|speed| way_lost(&["yaw-inertia"], speed));
    println!("lost at a start: {:.3} mm at 0.2 m/s, {:.3} mm at 0.4 m/s", 1e3 * slow, 1e3 * fast);
    // ½ v²/a with an acceleration that friction gives and speed does not change
    assert!((fast / slow - 4.0).abs() < 0.1, "{slow} {fast}");
}

#[test]
fn without_mass_a_thousandth_of_that_is_left() {
    let [none, full] = [&[][..], &["yaw-inertia"]].map(|ids| way_lost(ids, 0.4));
    println!(
        "lost at a start to 0.4 m/s: {:.4} mm without mass, {:.3} mm with it",
        1e3 * none,
        1e3 * full
    );
    assert!(none.abs() < 2e-3 * full, "{none} {full}");
}
