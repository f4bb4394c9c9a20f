//! Joints with named interfaces, arrays of poses, and transforms of several models.

use super::sources::{COUNT, JOINTS, Message, RADIUS, Topic, assert_poses, bag, options, truth};
use trackdyn::inspect::{Content, InspectSettings, Lack, inspect};
use trackdyn_recording::Warning;
use trackdyn_recording::rosbag::{self, JointSignal, Role, RosbagOptions};

/// Interfaces of a joint with their values.
type Interfaces = Vec<(&'static str, f64)>;

/// `control_msgs/DynamicJointState`: names, then interfaces and values of each joint.
fn dynamic(t: f64, joints: &[(&str, Interfaces)]) -> Message {
    let names = Message::stamped(t, "").count(joints.len());
    let names = joints.iter().fold(names, |message, (name, _)| message.text(name));
    joints.iter().fold(names.count(joints.len()), |message, (_, interfaces)| {
        let message = message.count(interfaces.len());
        let message = interfaces.iter().fold(message, |message, (name, _)| message.text(name));
        let values: Vec<f64> = interfaces.iter().map(|(_, value)| *value).collect();
        message.count(values.len()).numbers(&values)
    })
}

fn wheel_speeds(step: usize) -> [f64; 2] {
    let [v, w] = truth()[step].2;
    [(v - 0.4 * w) / RADIUS, (v + 0.4 * w) / RADIUS]
}

/// Angles of both wheels at a step.
fn wheel_angles(step: usize) -> [f64; 2] {
    let sum = |side: usize| (0..step).map(|step| 0.1 * wheel_speeds(step)[side]).sum();
    [sum(0), sum(1)]
}

fn slam(step: usize, t: f64) -> Option<Message> {
    Some(Message::stamped(t, "map").pose(truth()[step].1))
}

const SLAM: Topic = ("/slam", "geometry_msgs/msg/PoseStamped", &slam);
const DYNAMIC_STATE: &str = "control_msgs/msg/DynamicJointState";

#[track_caller]
fn assert_speeds(recording: &trackdyn_recording::Recording, near: f64) {
    let tracks = recording.runs()[0].tracks();
    assert!(tracks.len() >= COUNT as usize - 1, "{}", tracks.len());
    for (row, step) in tracks.iter().zip(0..) {
        let [left, right] = wheel_speeds(step).map(|speed| RADIUS * speed);
        let off = (row.v_left - left).abs().max((row.v_right - right).abs());
        assert!(off < near, "{off} at {}", row.t);
    }
}

#[test]
fn joints_with_interfaces_are_chosen_by_words_and_signals() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let make = |step: usize, t: f64| {
        let ([l, r], [pl, pr]) = (wheel_speeds(step), wheel_angles(step));
        Some(dynamic(
            t,
            &[
                ("arm_joint", vec![("position", 3.0), ("effort", 1.0)]),
                ("left_wheel_joint", vec![("velocity", l), ("position", pl)]),
                ("right_wheel_joint", vec![("effort", 4.0), ("position", pr), ("velocity", r)]),
            ],
        ))
    };
    let path = bag(folder.path(), &[("/dynamic_joint_states", DYNAMIC_STATE, &make), SLAM]);
    let recording = rosbag::read(&path, &options()).expect("readable");
    assert_speeds(&recording, 1e-9);
    assert_poses(&recording, 1e-9);
    let by_position = RosbagOptions { joint_signal: JointSignal::Position, ..options() };
    assert_speeds(&rosbag::read(&path, &by_position).expect("readable"), 1e-6);

    let seen = rosbag::inspect(&path).expect("readable");
    let topic = seen.topics.iter().find(|topic| topic.role == Some(Role::Tracks)).expect("joints");
    assert_eq!(topic.joints[1..], ["left_wheel_joint", "right_wheel_joint"]);
    assert_eq!(topic.signals, ["position", "velocity"]);
    assert_eq!(seen.suggested.left_joints, ["left_wheel_joint"]);
}

/// The controller manager tells every joint again, sensors too.
#[test]
fn a_joint_state_comes_before_interfaces_unless_they_are_named() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let twice = |step: usize, t: f64| {
        let [l, r] = wheel_speeds(step).map(|speed| 2.0 * speed);
        let joints = [("left", vec![("velocity", l)]), ("right", vec![("velocity", r)])];
        Some(dynamic(t, &joints))
    };
    let path = bag(folder.path(), &[("/dynamic", DYNAMIC_STATE, &twice), JOINTS, SLAM]);
    assert_speeds(&rosbag::read(&path, &options()).expect("readable"), 1e-9);
    let named = RosbagOptions {
        tracks_topic: Some("/dynamic".to_owned()),
        wheel_radius: Some(0.5 * RADIUS),
        ..RosbagOptions::default()
    };
    assert_speeds(&rosbag::read(&path, &named).expect("readable"), 1e-9);
    let seen = rosbag::inspect(&path).expect("readable");
    assert_eq!(seen.suggested.tracks_topic.as_deref(), Some("/joints"));
}

#[test]
fn one_of_several_poses_is_taken_by_its_number() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let models = |step: usize, t: f64| {
        let poses = Message::stamped(t, "world").count(3).pose([0.0; 3]);
        Some(poses.pose(truth()[step].1).pose([5.0, 6.0, 0.7]))
    };
    let array: Topic = ("/model_poses", "geometry_msgs/msg/PoseArray", &models);
    let path = bag(folder.path(), &[JOINTS, array]);
    let refused = |options: &RosbagOptions| {
        rosbag::read(&path, options).map(drop).expect_err("refused").to_string()
    };
    let text = refused(&options());
    assert!(text.contains("it has 3 poses") && text.contains("--pose-index 0 to 2"), "{text}");
    let text = refused(&RosbagOptions { pose_index: Some(3), ..options() });
    assert!(text.contains("none of --pose-index 3: expected 0 to 2"), "{text}");
    let second = RosbagOptions { pose_index: Some(1), ..options() };
    let recording = rosbag::read(&path, &second).expect("readable");
    assert_eq!(assert_poses(&recording, 1e-9), COUNT as usize);
    let path = bag(folder.path(), &[JOINTS, SLAM]);
    let text = rosbag::read(&path, &second).map(drop).expect_err("refused").to_string();
    assert!(text.contains("--pose-index: /slam is no PoseArray"), "{text}");
}

/// A bridge of a simulator names models by their child frames, and may leave the parent empty.
#[test]
fn a_model_among_transforms_is_taken_by_its_name() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let transforms = |step: usize, t: f64| {
        let [x, y, yaw] = truth()[step].1;
        let message = Message::new().count(2).header(t, "").text("ground_plane").pose([0.0; 3]);
        Some(message.header(t, "").text("robot").pose([x, y, yaw]))
    };
    let tf: Topic = ("/model/tf", "tf2_msgs/msg/TFMessage", &transforms);
    let path = bag(folder.path(), &[JOINTS, tf]);
    let text = rosbag::read(&path, &options()).map(drop).expect_err("two").to_string();
    assert!(text.contains("\"robot\"") && text.contains("--child-frame"), "{text}");
    let named = RosbagOptions { child_frame: Some("robot".to_owned()), ..options() };
    let recording = rosbag::read(&path, &named).expect("readable");
    assert_eq!(assert_poses(&recording, 1e-9), COUNT as usize);
}

/// Speeds of a driver by the paths of their fields, beside its own dead reckoning and a reference.
#[test]
fn poses_of_the_driver_whose_speeds_are_taken_come_second() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let odometry = |step: usize, t: f64| {
        let (_, _, twist) = truth()[step];
        let message = Message::stamped(t, "odom").text("base").pose([9.0, 9.0, 1.0]);
        Some(message.numbers(&[0.0; 36]).twist(twist).numbers(&[0.0; 36]))
    };
    let path = bag(folder.path(), &[("/drives", "nav_msgs/msg/Odometry", &odometry), SLAM]);
    let given = RosbagOptions {
        twist_topic: Some("/drives".to_owned()),
        separation: Some(0.8),
        ..RosbagOptions::default()
    };
    let seen = rosbag::inspect_for(&path, &given).expect("readable");
    assert_eq!(seen.suggested.pose_topic.as_deref(), Some("/slam"));
    let signals = RosbagOptions {
        left_signals: vec!["/drives:twist.twist.linear.x".to_owned()],
        right_signals: vec!["/drives:twist.twist.linear.x".to_owned()],
        ..RosbagOptions::default()
    };
    let seen = rosbag::inspect_for(&path, &signals).expect("readable");
    assert_eq!(seen.suggested.pose_topic.as_deref(), Some("/slam"));
    let recording = rosbag::read(&path, &given).expect("readable");
    assert_eq!(assert_poses(&recording, 1e-9), COUNT as usize);
    let is_told = |warning: &Warning| matches!(warning, Warning::FromTwist { .. });
    assert!(recording.warnings().iter().any(is_told));
}

/// A log with nothing but speeds of the body, and one that says so.
#[test]
fn an_inspection_goes_on_with_a_twist_and_without_a_radius() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let twist = |step: usize, t: f64| Some(Message::stamped(t, "base").twist(truth()[step].2));
    let wheels: Topic = ("/wheels", "geometry_msgs/msg/TwistStamped", &twist);
    let path = bag(folder.path(), &[wheels, SLAM]);
    let read = trackdyn::ReadOptions { bag: options(), ..trackdyn::ReadOptions::default() };
    let settings = InspectSettings { read, ..InspectSettings::default() };
    let found = inspect(&path, &settings).expect("a bag");
    let bag = &found.options.bag;
    assert_eq!((bag.twist_topic.as_deref(), bag.wheel_radius), (Some("/wheels"), None));
    assert!(!found.lacks.contains(&Lack::Tracks), "{:?}", found.lacks);
    assert!(matches!(found.content, Content::Unread(_)));

    let mut settings = settings;
    settings.read.bag = RosbagOptions {
        twist_topic: Some("/wheels".to_owned()),
        separation: Some(0.8),
        ..RosbagOptions::default()
    };
    let found = inspect(&path, &settings).expect("a bag");
    assert!(matches!(found.content, Content::Motion(_)), "{:?}", found.findings);
    assert!(!found.lacks.iter().any(|lack| matches!(lack, Lack::WheelRadius { .. })));
}
