//! Robots that stand.

use crate::second_simulator::turn::auriga;
use trackdyn_core::{PerSide, Plant, STANDARD_GRAVITY, Trajectory};
use trackdyn_second_simulator::{ActiveMechanism, Robot, Setup};

fn parked(angle: f64, uphill: f64) -> Result<f64, String> {
    let slope = ActiveMechanism::new("slope", &[("angle_deg", angle), ("uphill_deg", uphill)]);
    let robot = Robot::new(&auriga([0.0, 0.04]), &[slope.expect("a slope")], &Setup::default());
    let mut robot = robot.expect("a robot");
    let mut way = Trajectory::default();
    robot.drive(PerSide::new(0.0, 0.0), 60.0, &mut way).map_err(|stop| stop.to_string())?;
    let pose = robot.moment().pose;
    Ok(pose.x.hypot(pose.y))
}

#[test]
fn a_robot_parked_below_the_friction_angle_stays() {
    // atan 0.7 = 35.0° along the tracks, atan 0.9 = 42.0° across
    for (angle, uphill) in [(2.0, 30.0), (20.0, 90.0), (33.0, 0.0), (33.0, 45.0), (40.0, 90.0)] {
        let moved = parked(angle, uphill).expect("a robot that stands");
        println!("{angle}° towards {uphill}°: {moved:.1e} m");
        // a shoe deflects by its elastic range, 5 µm, before it slides
        assert!(moved < 1e-5, "{angle}° towards {uphill}°: {moved} m in 60 s");
    }
}

#[test]
fn above_the_friction_angle_it_slides_as_a_block_does() {
    let angle = 37.0_f64;
    let slope = ActiveMechanism::new("slope", &[("angle_deg", angle)]).expect("a slope");
    let mass = ActiveMechanism::new("yaw-inertia", &[]).expect("mass");
    let robot = Robot::new(&auriga([0.0, 0.0]), &[slope, mass], &Setup::default());
    let mut robot = robot.expect("a robot");
    let mut way = Trajectory::default();
    robot.drive(PerSide::new(0.0, 0.0), 2.0, &mut way).expect("a motion");
    // a = g (sin β − μ cos β)
    let (sin, cos) = angle.to_radians().sin_cos();
    let expected = -0.5 * STANDARD_GRAVITY * (sin - 0.7 * cos) * 2.0_f64.powi(2);
    let slid = robot.moment().pose.x;
    println!("slides {slid:.4} m in 2 s, expected {expected:.4} m");
    // Steps of up to 10 ms run ahead by half a step of the speed reached, 0.8 m/s. Released from
    // undeflected shoes, the robot has √(g sin β z₀) = 5 mm/s when they slide, and keeps it for
    // 2 s.
    assert!((slid - expected).abs() < 4e-3 + 1.1e-2, "{slid} {expected}");
}

#[test]
fn straight_across_a_slope_the_tracks_hold_their_line() {
    // Each shoe comes to the ground undeflected and takes up its share of the side force within its
    // elastic range z, while it is carried through the contact of length l. So the robot creeps
    // downhill by less than z in l, and because the rear shoes carry more, it steers by up to
    // z/l² = 1e-5 rad/m, as a brush tyre does.
    let turned = 5e-6 / 0.7_f64.powi(2) * 30.0;
    let slope = ActiveMechanism::new("slope", &[("angle_deg", 10.0), ("uphill_deg", 90.0)]);
    let robot = Robot::new(&auriga([0.0, 0.0]), &[slope.expect("a slope")], &Setup::default());
    let mut robot = robot.expect("a robot");
    let mut way = Trajectory::default();
    robot.drive(PerSide::new(0.5, 0.5), 60.0, &mut way).expect("a motion");
    let pose = robot.moment().pose;
    println!("30 m across a slope of 10°: {:.2} mm down", -1e3 * pose.y);
    assert!((pose.x - 30.0).abs() < 1e-3, "{pose:?}");
    assert!(pose.y < 0.0 && pose.y > -15.0 * turned && pose.yaw.abs() < turned, "{pose:?}");
}
