//! The motion in time: stick, slip, energy, convergence, and the steady state it settles to.

use trackdyn_core::frames::paper_twist_from_ros;
use trackdyn_core::{Command, PerSide, Plant, Pose, Schedule, Side, Trajectory, Twist};
use trackdyn_model::{ActiveEffect, CATALOGUE, Circumstance, Effects, Model};
use trackdyn_model::{Icrs, Stationary, Status, Transient};
use trackdyn_tests::auriga;

const NEWTON: [&str; 2] = ["centripetal", "yaw-inertia:gyration_m=0.3"];

fn schedule(commands: &[(f64, f64, f64)]) -> Schedule {
    let command =
        |&(t, left, right): &(f64, f64, f64)| Command { t, speeds: PerSide::new(left, right) };
    Schedule::new(commands.iter().map(command).collect()).expect("a schedule")
}

fn drive(model: &Model, schedule: &Schedule, step: f64) -> Trajectory {
    let mut robot = Transient::at_rest(model, 0.0, Pose::default()).with_step(step);
    robot.follow(schedule).unwrap_or_else(|stop| panic!("{stop} {:?}", model.effects()))
}

/// A drive with spins, arcs, straights and stops.
fn mixed() -> Schedule {
    schedule(&[
        (0.0, 0.5, 0.5),
        (1.0, 0.3, 0.8),
        (2.5, -0.6, 0.6),
        (3.5, 0.0, 0.0),
        (4.5, -0.5, -0.5),
        (5.5, -0.2, -0.9),
        (7.0, 0.0, 0.7),
        (8.0, 0.0, 0.0),
        (9.0, 0.0, 0.0),
    ])
}

#[test]
fn steady_turns_are_the_stationary_ones() {
    let speeds = [(0.4, 1.0), (-0.4, 1.0), (-0.7, 0.7), (-0.3, -0.9)];
    let mut checked = 0;
    let mechanisms = || CATALOGUE.iter().filter(|card| !card.is_form());
    for card in mechanisms() {
        // Both models stand at one place and time: effects of place and time are met there.
        let effect = ActiveEffect::new(card.id, &[]).expect("typical sizes");
        let vehicle = auriga([-0.015, 0.04], &[]).vehicle().clone();
        let model = Model::new(vehicle, Effects::from_iter([effect]));
        for (left, right) in speeds {
            let shown = PerSide::new(left, right);
            let path = drive(&model, &schedule(&[(0.0, left, right), (4.0, left, right)]), 0.01);
            let last = path.moments()[path.moments().len() - 1];
            let here = Circumstance {
                position: [last.pose.x, last.pose.y],
                heading: last.pose.yaw,
                time: last.t,
            };
            let stationary = Stationary::new(&model, &here).solve(shown);
            assert_eq!(stationary.status, Status::Turning, "{}", card.id);
            let expected = stationary.icrs.expect("a turn has ICRs").to_array();
            let driven = model.drive().driven(shown, last.t);
            let found = Icrs::of_motion(driven, &paper_twist_from_ros(&last.twist));
            let found = found.expect("a turn").to_array();
            for (found, expected) in found.into_iter().zip(expected) {
                let error = (found - expected).abs();
                assert!(error < 5e-4, "{} at {left} {right}: {error} m", card.id);
            }
            checked += 1;
        }
    }
    assert_eq!(checked, speeds.len() * mechanisms().count());
}

#[test]
fn a_parked_robot_stays_on_a_slope_below_the_friction_angle() {
    // tan β = 0.8 μ, downhill along and across the tracks
    for (mu, uphill) in [(0.7_f64, 0.0), (0.9, 90.0)] {
        let angle = (0.8 * mu).atan().to_degrees();
        let slope = format!("slope:angle_deg={angle},uphill_deg={uphill}");
        let mut effects = NEWTON.to_vec();
        effects.push(&slope);
        let model = auriga([0.0, 0.0], &effects);
        let path = drive(&model, &schedule(&[(0.0, 0.0, 0.0), (60.0, 0.0, 0.0)]), 0.05);
        let end = path.moments()[path.moments().len() - 1].pose;
        let crept = end.x.hypot(end.y);
        assert!(crept > 0.0 && crept < 1e-4, "{crept} m");
        // Above the friction angle it slides, faster and faster.
        let angle = (1.1 * mu).atan().to_degrees();
        let slope = format!("slope:angle_deg={angle},uphill_deg={uphill}");
        effects[2] = &slope;
        let model = auriga([0.0, 0.0], &effects);
        let path = drive(&model, &schedule(&[(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)]), 0.01);
        let end = path.moments()[path.moments().len() - 1].pose;
        let (sin, cos) = angle.to_radians().sin_cos();
        let expected = 0.5 * 9.806_65 * (sin - mu * cos);
        assert!((end.x.hypot(end.y) - expected).abs() < 0.01 * expected, "{end:?} {expected}");
    }
}

/// Kinetic energy of a body with a radius of gyration of 0.3 m about its centre of gravity, J.
fn kinetic_energy(model: &Model, robot: &Transient) -> f64 {
    let vehicle = model.vehicle();
    let twist = paper_twist_from_ros(&robot.moment().twist);
    let [v_x, v_y] = twist.velocity_at(vehicle.cog);
    let w = 0.3 * twist.w;
    // E = ½ m (v² + r² ω²)
    0.5 * vehicle.mass * (v_x * v_x + v_y * v_y + w * w)
}

#[test]
fn a_free_slide_loses_energy_and_comes_to_rest() {
    let model = auriga([-0.015, 0.04], &NEWTON);
    let twist = Twist { v_x: 0.8, v_y: -0.6, w: 2.5 };
    let mut robot = Transient::at_rest(&model, 0.0, Pose::default()).with_twist(twist);
    let mut path = Trajectory::default();
    let mut before = kinetic_energy(&model, &robot);
    for step in 1..=100 {
        robot.drive(PerSide::new(0.0, 0.0), 0.01 * f64::from(step), &mut path).expect("it slides");
        let energy = kinetic_energy(&model, &robot);
        assert!(energy <= before, "{before} J to {energy} J at step {step}");
        before = energy;
    }
    assert!(before < 1e-9, "{before} J remain");
}

#[test]
fn steps_converge_with_their_square_and_at_corners_of_stick_and_slip_with_themselves() {
    let model = auriga([-0.015, 0.04], &[NEWTON[0], NEWTON[1], "load-transfer:cog_height_m=0.05"]);
    let exact = drive(&model, &mixed(), 0.000_25);
    let errors = |t: f64| {
        [0.02, 0.01, 0.005, 0.0025].map(|step| {
            let (pose, exact) = (drive(&model, &mixed(), step).pose_at(t), exact.pose_at(t));
            (pose.x - exact.x).hypot(pose.y - exact.y)
        })
    };
    // In the last turn the left belt stands still, and its track sticks and slips in turns.
    let (smooth, whole) = (errors(7.0), errors(9.0));
    println!("steps of 20, 10, 5, 2.5 ms: after 7 s {smooth:?} m, after 9 s {whole:?} m");
    assert!(whole[1] < 1e-3 && smooth[1] < 2e-4, "{smooth:?} {whole:?}");
    assert!(smooth[3] < smooth[1] / 8.0, "{smooth:?}");
    assert!(whole[3] < whole[0] / 8.0, "{whole:?}");
}

#[test]
fn steps_are_short_where_the_motion_changes() {
    const STEP: f64 = 0.03;
    let model = auriga([-0.015, 0.04], &[NEWTON[0], NEWTON[1], "load-transfer:cog_height_m=0.05"]);
    let exact = drive(&model, &mixed(), 0.000_25);
    let error = |tolerance: f64| {
        let robot = Transient::at_rest(&model, 0.0, Pose::default()).with_step(STEP);
        let path = robot.with_tolerance(tolerance, STEP / 8.0).follow(&mixed()).expect("it drives");
        let off = |t: f64| {
            let (pose, exact) = (path.pose_at(t), exact.pose_at(t));
            (pose.x - exact.x).hypot(pose.y - exact.y)
        };
        // Each command begins at a step, and its transient is over long before the next.
        [0.9, 2.4, 3.4, 4.4, 5.4, 6.9].map(off).iter().sum::<f64>() / 6.0
    };
    let (whole, short) = (error(f64::INFINITY), error(5e-3));
    println!("steps of 30 ms: {whole:.1e} m, shorter ones: {short:.1e} m");
    assert!(short < 0.3 * whole, "{short:.1e} of {whole:.1e} m");
}

#[test]
fn straight_driving_is_straight_and_stops_where_it_should() {
    let model = auriga([-0.015, 0.04], &NEWTON);
    let path = drive(&model, &schedule(&[(0.0, 0.5, 0.5), (2.0, 0.0, 0.0), (3.0, 0.0, 0.0)]), 0.01);
    let end = path.moments()[path.moments().len() - 1];
    assert!(end.pose.y.abs() < 1e-3 && end.pose.yaw.abs() < 1e-3, "{end:?}");
    // Slip while it gains speed is lost again while it brakes: 1 m of belt is 1 m of ground.
    assert!((end.pose.x - 1.0).abs() < 2e-3, "{end:?}");
    assert!(end.twist.v_x.abs() < 1e-5 && end.twist.w.abs() < 1e-5, "{end:?}");
}

/// A full brake shifts the load by μ_y h: beyond l/6 part of the contact lifts and the rest bears,
/// beyond l/2 the robot tips over, if it brakes for long enough.
#[test]
fn a_high_robot_lifts_and_then_tips_over_its_brakes() {
    let end = |height: f64, speed: f64| {
        let brake = schedule(&[(0.0, speed, speed), (1.0, 0.0, 0.0), (2.0, 0.0, 0.0)]);
        let transfer = format!("load-transfer:cog_height_m={height}");
        let model = auriga([0.0, 0.0], &[NEWTON[0], NEWTON[1], &transfer]);
        let mut robot = Transient::at_rest(&model, 0.0, Pose::default());
        let path = robot.follow(&brake).map_err(|stopped| stopped.reason)?;
        Ok::<f64, String>(path.moments()[path.moments().len() - 1].pose.x)
    };
    let low = end(0.1, 0.8).expect("0.07 m is inside l/6 = 0.117 m");
    // Straight ahead friction asks for the sum of the load, not where it is.
    let high = end(0.3, 0.8).expect("0.21 m is inside l/2 = 0.35 m");
    assert!((low - high).abs() < 1e-3, "{low} m and {high} m");
    // 0.42 m is not: 0.12 s of braking lift the robot, 0.44 s throw it over.
    let jolted = end(0.6, 0.8).expect("it falls back");
    assert!((low - jolted).abs() < 1e-3, "{low} m and {jolted} m");
    assert!(end(0.6, 3.0).expect_err("it does not").contains("tips over"));
    end(0.3, 3.0).expect("0.21 m is inside l/2, however long");
}

#[test]
fn a_track_that_holds_lets_the_other_one_slip() {
    // Nearly all weight on the right: it holds the robot at its own speed.
    let model = auriga([0.2, 0.0], &NEWTON);
    let stationary = Stationary::new(&model, &Circumstance::default());
    assert_eq!(stationary.solve(PerSide::new(0.1, 0.5)).status, Status::Holds(Side::Right));
    let path = drive(&model, &schedule(&[(0.0, 0.1, 0.5), (3.0, 0.1, 0.5)]), 0.01);
    let end = path.moments()[path.moments().len() - 1];
    assert!((end.twist.v_x - 0.5).abs() < 1e-4 && end.twist.w.abs() < 1e-4, "{end:?}");
}

#[test]
fn without_inertia_the_robot_is_where_the_stationary_model_says_at_once() {
    let model = auriga([-0.015, 0.04], &[]);
    let path = drive(&model, &mixed(), 0.01);
    let stationary = Stationary::new(&model, &Circumstance::default());
    let schedule = mixed();
    for moment in &path.moments()[1..] {
        let shown = schedule.at(moment.t - 0.005);
        let expected = stationary.solve(shown).twist;
        let found = paper_twist_from_ros(&moment.twist);
        for (found, expected) in
            [(found.v_x, expected.v_x), (found.v_y, expected.v_y), (found.w, expected.w)]
        {
            assert!((found - expected).abs() < 1e-5, "{moment:?} {expected}");
        }
    }
}

/// Friction turns over within a slip of micrometres per second, and a belt's speed with it: what
/// the traction was a moment before says nothing of what it is.
#[test]
fn belts_that_slip_drive_straight_after_a_turn() {
    for inertia in [&[][..], &NEWTON] {
        let effects = [inertia, &["belt-slip:slip=0.05"]].concat();
        let model = auriga([-0.015, 0.04], &effects);
        let path =
            drive(&model, &schedule(&[(0.0, 0.2, 0.8), (2.0, 0.5, 0.5), (4.0, 0.5, 0.5)]), 0.01);
        let late: Vec<_> = path.moments().iter().filter(|moment| moment.t > 2.2).collect();
        let fastest = late.iter().map(|moment| moment.twist.w.abs()).fold(0.0, f64::max);
        assert!(late.len() > 150 && fastest < 1e-9, "{fastest} rad/s {effects:?}");
        let off = late.iter().map(|moment| (moment.twist.v_x - 0.5).abs()).fold(0.0, f64::max);
        assert!(off < 1e-6, "{off} m/s {effects:?}");
    }
}

/// Belts that slip take up a small difference of the sprockets: the robot does not turn. A larger
/// one turns it, and the motion in time settles to the stationary one on both sides of the edge.
#[test]
fn belts_that_slip_do_not_turn_at_a_small_difference() {
    const SLIP: f64 = 0.05;
    let slip = format!("belt-slip:slip={SLIP}");
    let beside = [
        "motion-resistance:coefficient=0.1",
        "hitch-drag",
        "viscous-friction",
        "stribeck-friction",
        "shear-displacement",
    ];
    for beside in [&[][..]].into_iter().chain(beside.chunks(1)) {
        let effects = [&[slip.as_str()], beside].concat();
        let model = auriga([-0.015, 0.04], &effects);
        let solver = Stationary::new(&model, &Circumstance::default());
        let mut kinds = Vec::new();
        for difference in [-0.06, -0.02, -0.005, 0.0, 0.002, 0.01, 0.02, 0.03, 0.05, 0.1] {
            let shown = PerSide::new(0.5 - difference / 2.0, 0.5 + difference / 2.0);
            let stationary = solver.solve(shown);
            let path =
                drive(&model, &schedule(&[(0.0, shown.left, shown.right), (0.2, 0.5, 0.5)]), 0.01);
            let moments = path.moments();
            let twist = paper_twist_from_ros(&moments[moments.len() - 1].twist);
            let found = stationary.twist;
            let off = (found.v_x - twist.v_x).hypot(found.v_y - twist.v_y).hypot(found.w - twist.w);
            assert!(off < 1e-5, "{off} at {difference}: {stationary:?} {twist:?} {effects:?}");
            kinds.push(stationary.status);
            if stationary.status == Status::Straight {
                // κ V (T_r − T_l)/N takes up the difference, and T is µ N at most
                assert!(difference.abs() < SLIP * 0.5 * 2.0 * model.vehicle().friction.along);
            }
        }
        // Sheared soil bears nothing before it is sheared: without it tracks stick.
        let straight = kinds.iter().filter(|kind| **kind == Status::Straight).count();
        let sticks = !beside.contains(&"shear-displacement");
        let expected = if sticks { 2..kinds.len() - 1 } else { 1..2 };
        assert!(expected.contains(&straight), "{kinds:?} {effects:?}");
    }
}
