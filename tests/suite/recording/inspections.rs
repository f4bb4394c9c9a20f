//! Judgements of bags: what is mended, what is told, and what is left to the user.

use super::drives::{Bag, RADIUS, SEPARATION, at, poses, quaternion, speeds, times};
use trackdyn::inspect::{Content, Finding, Lack, Readiness, Use, Verdict};
use trackdyn::recording::SpeedUnit;
use trackdyn::{InspectSettings, Inspection, Recording, inspect};
use trackdyn_core::{PerSide, Pose, Twist};
use trackdyn_estimate::Contradiction;
use trackdyn_tests::cdr::Message;

/// Wheels whose joints count so many radians for one, 50 a second.
fn wheels(signs: PerSide<f64>) -> Bag {
    let mut bag = Bag::default();
    for t in times(50) {
        let PerSide { left, right } = speeds(t);
        let values = [signs.left * left, signs.right * right];
        bag.joints("/joint_states", at(t), &["left_wheel", "right_wheel"], [&[], &values]);
    }
    bag
}

fn inspected(bag: Bag) -> Inspection {
    let (_folder, path) = bag.write();
    inspect(&path, &InspectSettings::default()).expect("a bag")
}

fn radius(found: &Inspection) -> Option<f64> {
    found.lacks.iter().find_map(|lack| match lack {
        Lack::WheelRadius { about } => *about,
        _ => None,
    })
}

/// The radius is not known: poses tell it, and the units do not look mixed up.
#[test]
fn a_wheel_radius_is_told_by_the_way_of_the_poses() {
    for turns in [1.0, 0.1, 8.0] {
        let found = inspected(wheels(PerSide::new(turns, turns)).with_poses());
        let about = radius(&found).expect("a way");
        // track speeds change within the segments
        let truth = RADIUS / turns;
        assert!((about / truth - 1.0).abs() < 0.02, "{about} for {truth}");
        let over_time = found.over_time.as_ref().expect("motion");
        // eq. (9) holds in joint speeds as well
        let deviation = over_time.rates.deviation().expect("segments");
        assert!(deviation < 0.02, "{deviation} rad/s");
    }
}

/// What is computed from the tracks is no reference, and is said to be none.
#[test]
fn a_side_that_counts_backwards_is_reversed_and_wheel_odometry_is_told() {
    let found = inspected(wheels(PerSide::new(1.0, -1.0)).with_poses());
    let mended = |of: &Finding| matches!(of, Finding::Mended(text) if text.contains("backwards"));
    assert!(found.findings.iter().any(mended), "{:?}", found.findings);
    assert_eq!(found.options.bag.right_joints, ["-right_wheel"]);
    assert_eq!(found.options.bag.left_joints, ["left_wheel"]);
    let is_odometry =
        |of: &Finding| matches!(of, Finding::Fit(Contradiction::WheelOdometry { .. }));
    assert!(found.findings.iter().any(is_odometry), "{:?}", found.findings);
    let identify = found.readiness.iter().find(|of| of.what == Use::Identify).expect("tried");
    assert!(matches!(&identify.verdict, Verdict::No(reason) if reason.contains("wheel odometry")));
}

#[test]
fn a_bag_without_poses_is_judged_by_its_topics() {
    let found = inspected(wheels(PerSide::new(1.0, 1.0)));
    assert!(matches!(&found.content, Content::Unread(reason) if reason.contains("poses")));
    assert!(found.lacks.contains(&Lack::Poses), "{:?}", found.lacks);
    assert!(found.readiness.iter().all(|of| !of.is_ready()) && found.over_time.is_none());
    assert_eq!(found.topics.len(), 1);
}

/// What a driver computes of its encoders: speeds of the body and poses, which are no reference.
fn odometry() -> Bag {
    let mut bag = Bag::default();
    for t in times(50) {
        let PerSide { left, right } = speeds(t).map(|speed| RADIUS * speed);
        let mut cdr = Message::new(at(t).1, "odom");
        cdr.text("base_link");
        cdr.numbers(&[0.0; 3 + 3]);
        cdr.numbers(&[1.0]);
        cdr.numbers(&[0.0; 36]);
        let yaw_rate = (right - left) / SEPARATION;
        cdr.numbers(&[f64::midpoint(left, right), 0.0, 0.0, 0.0, 0.0, yaw_rate]);
        cdr.numbers(&[0.0; 36]);
        bag.message(at(t).0, "/odom", "nav_msgs/msg/Odometry", cdr);
    }
    bag
}

/// Adds a gyroscope that counts so many radians for one, of a robot that slips.
fn turn(bag: &mut Bag, sign: f64) {
    for t in times(50) {
        let PerSide { left, right } = speeds(t).map(|speed| RADIUS * speed);
        let mut cdr = Message::new(at(t).1, "imu");
        cdr.numbers(&[0.0, 0.0, 0.0, 1.0, -1.0]);
        cdr.numbers(&[0.0; 8]);
        cdr.numbers(&[0.0, 0.0, sign * (right - left) / (1.5 * SEPARATION)]);
        cdr.numbers(&[0.0; 9]);
        cdr.numbers(&[0.0, 0.0, 9.8]);
        cdr.numbers(&[0.0; 9]);
        bag.message(at(t).0, "/imu", "sensor_msgs/msg/Imu", cdr);
    }
}

/// Sides that have names are right more often than a gyroscope is.
#[test]
fn a_gyroscope_that_counts_backwards_is_told_to_be_upside_down() {
    let mut bag = wheels(PerSide::new(1.0, 1.0));
    turn(&mut bag, -1.0);
    let found = inspected(bag);
    let told = |of: &Finding| matches!(of, Finding::Mended(text) if text.contains("upside down"));
    assert!(found.findings.iter().any(told), "{:?}", found.findings);
    assert_eq!(found.options.bag.left_joints, ["right_wheel"]);
}

/// Poses of the driver whose speeds are taken are none: what is suggested is the gyroscope.
#[test]
fn beside_speeds_of_a_driver_the_gyroscope_is_suggested_and_not_its_poses() {
    let mut bag = odometry();
    turn(&mut bag, 1.0);
    let (_folder, path) = bag.write();
    let found = inspect(&path, &InspectSettings::default()).expect("a bag");
    let mut options = found.options;
    let named = [&options.bag.twist_topic, &options.bag.pose_topic, &options.bag.parent_frame];
    assert_eq!(named.map(Option::as_deref), [Some("/odom"), Some("/imu"), None]);
    assert!(found.lacks.contains(&Lack::Positions), "{:?}", found.lacks);
    options.bag.separation = Some(SEPARATION);
    let recording = Recording::open(&path, &options).expect("the suggestion reads it");
    assert!(recording.motion().is_some_and(|motion| !motion.has_positions()));

    let found = inspected(odometry());
    assert!(found.lacks.contains(&Lack::Poses), "{:?}", found.lacks);
}

/// Numbers on topics of their own, in m/s, whose type is not defined in the bag.
#[test]
fn numbers_of_both_sides_are_found_by_their_names_and_their_unit_by_the_poses() {
    let mut bag = Bag::default();
    let mut number = |t: f64, topic: &'static str, value: f64| {
        let mut cdr = Message::bare();
        cdr.numbers(&[value]);
        bag.message(at(t).0, topic, "std_msgs/msg/Float64", cdr);
    };
    for t in times(50) {
        let PerSide { left, right } = speeds(t).map(|speed| RADIUS * speed);
        number(t, "/vl", left);
        number(t, "/vr", right);
        number(t, "/cmd_left", left);
        number(t, "/cmd_right", right);
        number(t, "/voltage", 24.0);
    }
    let found = inspected(bag.with_poses());
    let bag = &found.options.bag;
    assert_eq!(
        (&bag.left_signals[..], &bag.right_signals[..]),
        (&["/vl:data".to_owned()][..], &["/vr:data".to_owned()][..])
    );
    assert_eq!(bag.speed_unit, Some(SpeedUnit::MetresPerSecond), "{:?}", found.findings);
    assert_eq!(radius(&found), None);
    let Content::Motion(driving) = &found.content else { panic!("{:?}", found.content) };
    let ratio = driving.travel_ratio.expect("a way");
    assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
}

/// Poses of a robot that slips, and whose ICRs are in front of its middle.
fn slipping() -> Vec<(f64, Pose)> {
    let mut pose = Pose::default();
    let step = 0.005;
    let way = (0..12_000_u32).map(|k| {
        let t = f64::from(k) * step;
        let found = (t, pose);
        let PerSide { left, right } = speeds(t + 0.5 * step).map(|speed| RADIUS * speed);
        let w = (right - left) / (1.5 * SEPARATION);
        let twist = Twist { v_x: f64::midpoint(left, right), v_y: -0.1 * w, w };
        pose = pose.compose(&Pose::exp(&twist, step));
        found
    });
    way.step_by(10).collect()
}

/// Of poses that are computed from the tracks and others, the others are taken; among several
/// others, the user chooses.
#[test]
fn among_several_poses_wheel_odometry_is_not_taken() {
    let bag = |others: &[&'static str]| {
        let mut bag = wheels(PerSide::new(1.0, 1.0));
        for (t, pose) in poses() {
            let mut cdr = Message::new(at(t).1, "odom");
            cdr.text("base_link");
            cdr.numbers(&[pose.x, pose.y, 0.0]);
            cdr.numbers(&quaternion(pose.yaw));
            cdr.numbers(&[0.0; 36 + 6 + 36]);
            bag.message(at(t).0, "/odom", "nav_msgs/msg/Odometry", cdr);
        }
        for topic in others {
            for (t, pose) in slipping() {
                let mut cdr = Message::new(at(t).1, "map");
                cdr.numbers(&[pose.x, pose.y, 0.0]);
                cdr.numbers(&quaternion(pose.yaw));
                bag.message(at(t).0, topic, "geometry_msgs/msg/PoseStamped", cdr);
            }
        }
        inspected(bag)
    };
    let found = bag(&["/slam/pose"]);
    assert_eq!(found.options.bag.pose_topic.as_deref(), Some("/slam/pose"), "{:?}", found.findings);
    let told = |of: &Finding| matches!(of, Finding::Mended(text) if text.contains("tracks: /odom"));
    assert!(found.findings.iter().any(told) && found.choices.is_empty(), "{:?}", found.findings);
    assert!(found.readiness.iter().all(Readiness::is_ready), "{:?}", found.readiness);

    let found = bag(&["/slam/pose", "/mocap/pose"]);
    assert!(matches!(found.content, Content::Unread(_)));
    let topics = found.choices.iter().map(|of| of.bag.pose_topic.as_deref());
    assert_eq!(topics.collect::<Vec<_>>(), [Some("/mocap/pose"), Some("/slam/pose")]);
}

/// Names that tell no side are told by how the poses turn.
#[test]
fn joints_without_a_side_are_told_by_the_poses() {
    let mut bag = Bag::default();
    for t in times(50) {
        let PerSide { left, right } = speeds(t);
        bag.joints("/joint_states", at(t), &["wheel_1", "wheel_2"], [&[], &[right, left]]);
    }
    for (t, pose) in slipping() {
        bag.pose(at(t), [pose.x, pose.y], quaternion(pose.yaw));
    }
    let found = inspected(bag);
    let bag = &found.options.bag;
    assert_eq!(
        (&bag.left_joints[..], &bag.right_joints[..]),
        (&["wheel_2".to_owned()][..], &["wheel_1".to_owned()][..])
    );
    assert!(found.readiness.iter().all(Readiness::is_ready), "{:?}", found.readiness);
}

/// Poses that no parameters explain are none for the other uses either.
#[test]
fn mirrored_poses_are_good_for_nothing() {
    let mut bag = wheels(PerSide::new(1.0, 1.0));
    for (t, pose) in slipping() {
        bag.pose(at(t), [pose.x, -pose.y], quaternion(pose.yaw));
    }
    let found = inspected(bag);
    assert!(!found.readiness.iter().any(Readiness::is_ready), "{:?}", found.readiness);
}
