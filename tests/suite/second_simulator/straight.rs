//! Straight driving under a load along the tracks.

use crate::second_simulator::turn::auriga;
use trackdyn_core::{PerSide, Plant, Pose, Trajectory};
use trackdyn_second_simulator::{ActiveMechanism, Robot, Setup};

fn robot(mechanisms: &[&str], yaw: f64) -> Robot {
    let active: Vec<ActiveMechanism> =
        mechanisms.iter().map(|text| text.parse().expect("a mechanism")).collect();
    let setup = Setup { start: Pose::new(0.0, 0.0, yaw), ..Setup::default() };
    Robot::new(&auriga([0.0, 0.0]), &active, &setup).expect("a robot")
}

/// Both tracks stick, so the load alone says how much the belts slip: it takes sin β of the weight
/// up the slope, and at that traction the belt loses λ x √(x/0.3) of its speed.
#[test]
fn belts_that_slip_up_a_slope_run_evenly_at_the_speed_that_the_law_gives() {
    const SLOPE: f64 = 5.0;
    for (slip, resistance) in [(0.1, 0.0), (0.5, 0.0), (0.5, 0.2)] {
        let mechanisms = [
            format!("belt-slip:slip={slip}"),
            format!("slope:angle_deg={SLOPE},uphill_deg=0"),
            format!("motion-resistance:coefficient={resistance}"),
        ];
        let mut robot = robot(&mechanisms.each_ref().map(String::as_str), 0.0);
        let mut way = Trajectory::default();
        // out of an arc, so that the belts come to straight driving from different speeds
        robot.drive(PerSide::new(0.3, 0.6), 1.0, &mut way).expect("a motion");
        robot.drive(PerSide::new(0.5, 0.5), 4.0, &mut way).expect("a motion");
        // what resists presses on the frame: the belts carry it too
        let x = SLOPE.to_radians().tan() * robot.moment().pose.yaw.cos() + resistance;
        let expected = 0.5 * (1.0 - slip * x * (x.abs() / 0.3).sqrt());
        for moment in way.moments().iter().filter(|moment| moment.t > 2.5) {
            for speed in [moment.belt_speed.left, moment.belt_speed.right] {
                assert!((speed / expected - 1.0).abs() < 2e-3, "{slip}: {speed}, not {expected}");
            }
            assert!(moment.twist.w.abs() < 1e-3, "{slip}: {}", moment.twist.w);
        }
    }
}

/// A load that the brakes throw beyond the front end is carried by nothing.
#[test]
fn a_robot_that_pitches_over_stops_the_simulation() {
    let stop = |height: f64| {
        let height = format!("load-transfer:cog_height_m={height}");
        let mut robot = robot(&["yaw-inertia", "centripetal", &height], 0.0);
        let mut way = Trajectory::default();
        for step in 0..13 {
            let speed = 0.1 * f64::from(step);
            robot
                .drive(PerSide::new(speed, speed), 0.2 * f64::from(step + 1), &mut way)
                .expect("a motion");
        }
        robot.drive(PerSide::new(0.0, 0.0), 3.5, &mut way)
    };
    stop(0.3).expect("it stands");
    let stopped = stop(0.8).expect_err("it pitches over").to_string();
    assert!(stopped.contains("pitches over"), "{stopped}");
}
