//! What robots usually log beside each other: the right source is taken, or the option is named.

use super::sources::{JOINTS, Message, RADIUS, Topic, bag, options, truth};
use trackdyn_core::Pose;
use trackdyn_recording::rosbag::{self, RosbagOptions};
use trackdyn_recording::{Error, Recording};

const TF: &str = "tf2_msgs/msg/TFMessage";
const IMU: &str = "sensor_msgs/msg/Imu";
const JOINT_STATE: &str = "sensor_msgs/msg/JointState";

fn read_by(topics: &[Topic], options: &RosbagOptions) -> Result<Recording, Error> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    rosbag::read(&bag(folder.path(), topics), options)
}

#[track_caller]
fn read(topics: &[Topic]) -> Recording {
    read_by(topics, &options()).expect("readable")
}

#[track_caller]
fn assert_says(recording: &Recording, part: &str) {
    let notes: Vec<String> = recording.warnings().iter().map(ToString::to_string).collect();
    assert!(notes.iter().any(|note| note.contains(part)), "{part:?} is not in {notes:?}");
}

/// Poses are those of the truth within rounding.
#[track_caller]
fn assert_poses(recording: &Recording) {
    let poses = recording.runs()[0].poses();
    assert!(poses.len() > 390, "{} poses", poses.len());
    for pose in poses {
        let step = truth().iter().position(|(t, ..)| (t - pose.t).abs() < 1e-6).expect("a step");
        let [x, y, yaw] = truth()[step].1;
        let off = trackdyn_core::pose::wrap_angle(pose.pose.yaw - yaw);
        let near = (pose.pose.x - x).hypot(pose.pose.y - y) < 1e-9 && off.abs() < 1e-9;
        assert!(near, "{pose:?} instead of {:?}", truth()[step].1);
    }
}

fn pose_of([x, y, yaw]: [f64; 3]) -> Pose {
    Pose::new(x, y, yaw)
}

fn row(pose: &Pose) -> [f64; 3] {
    [pose.x, pose.y, pose.yaw]
}

/// A list of one transform.
fn transform(t: f64, parent: &str, child: &str, pose: [f64; 3]) -> Message {
    Message::new().count(1).header(t, parent).text(child).pose(pose)
}

/// Where odometry stands in the map: it drifts.
fn drift(t: f64) -> Pose {
    Pose::new(0.05 * t, -0.02 * t, 0.01 * t)
}

#[test]
fn a_map_over_odometry_is_composed() {
    let links = |step: usize, t: f64| {
        let odom = drift(t).inverse().compose(&pose_of(truth()[step].1));
        let [map, odom] = [row(&drift(t)), row(&odom)];
        let list = Message::new().count(2).header(t, "map").text("odom").pose(map);
        Some(list.header(t, "odom").text("base_link").pose(odom))
    };
    let recording = read(&[JOINTS, ("/tf", TF, &links)]);
    assert_poses(&recording);
    assert_says(&recording, "base_link in map by map -> odom");
    // the odometry of the driver beside it is no reason to ask
    let odometry = |step: usize, t: f64| {
        let message = Message::stamped(t, "odom").text("base_link");
        let odom = drift(t).inverse().compose(&pose_of(truth()[step].1));
        Some(message.pose(row(&odom)).numbers(&[0.0; 36]).twist([1.0, 0.0]).numbers(&[0.0; 36]))
    };
    let odometry: Topic = ("/odom", "nav_msgs/msg/Odometry", &odometry);
    assert_poses(&read(&[JOINTS, ("/tf", TF, &links), odometry]));
}

#[test]
fn poses_of_a_mounted_sensor_are_moved_to_the_body() {
    let mount = Pose::new(0.3, -0.1, 0.5);
    let lidar = |step: usize, t: f64| {
        let pose = pose_of(truth()[step].1).compose(&mount);
        let message = Message::stamped(t, "map").text("lidar");
        Some(message.pose(row(&pose)).numbers(&[0.0; 36]).twist([1.0, 0.0]).numbers(&[0.0; 36]))
    };
    let fixed =
        |step: usize, _| (step == 0).then(|| transform(0.0, "base_link", "lidar", row(&mount)));
    let lidar: Topic = ("/lidar_pose", "nav_msgs/msg/Odometry", &lidar);
    let recording = read(&[JOINTS, lidar, ("/tf_static", TF, &fixed)]);
    assert_poses(&recording);
    assert_says(
        &recording,
        "those of lidar moved to base_link, on which it is mounted at x = 0.300",
    );
}

/// A gyroscope that reads so many times the yaw rate.
fn gyroscope(step: usize, t: f64, factor: f64) -> Option<Message> {
    let message = Message::stamped(t, "imu").numbers(&[0.0, 0.0, 0.0, 1.0]).numbers(&[-1.0]);
    let rate = [0.0, 0.0, factor * truth()[step].2[1]];
    let message = message.numbers(&[0.0; 8]).numbers(&rate).numbers(&[0.0; 9]);
    Some(message.numbers(&[0.0, 0.0, 9.81]).numbers(&[0.0; 9]))
}

#[test]
fn of_several_gyroscopes_one_is_chosen_by_its_option() {
    let right = |step: usize, t: f64| gyroscope(step, t, 1.0);
    let other = |step: usize, t: f64| gyroscope(step, t, -1.0);
    let topics: [Topic; 3] = [JOINTS, ("/imu/data", IMU, &right), ("/imu/down", IMU, &other)];
    let text = read_by(&topics, &options()).expect_err("refused").to_string();
    for part in ["several could be it: /imu/data, /imu/down", "choose by --imu-topic"] {
        assert!(text.contains(part), "{part} is not in {text}");
    }
    let turned = |recording: &Recording| {
        let poses = recording.runs()[0].poses();
        poses[poses.len() - 1].pose.yaw - poses[0].pose.yaw
    };
    let named = Some("/imu/data".to_owned());
    let imu = RosbagOptions { imu_topic: named.clone(), ..options() };
    let found = read_by(&topics, &imu).expect("readable");
    // 30 of 100 steps at 0.5 rad/s
    assert!((turned(&found) - 6.0).abs() < 0.06, "{}", turned(&found));
    assert!(!found.has_positions());
    // beside odometry, which it replaces
    let odometry = |_: usize, t: f64| {
        let message = Message::stamped(t, "odom").text("base_link").pose([t, 0.0, 0.0]);
        Some(message.numbers(&[0.0; 36]).twist([1.0, 0.0]).numbers(&[0.0; 36]))
    };
    let odometry: Topic = ("/odom", "nav_msgs/msg/Odometry", &odometry);
    let topics = [topics[0], topics[1], topics[2], odometry];
    let poses = RosbagOptions { pose_topic: named, ..options() };
    let found = read_by(&topics, &poses).expect("readable");
    assert!((turned(&found) - 6.0).abs() < 0.06, "{}", turned(&found));
}

/// Poses as a localisation sends them.
fn slam(step: usize, t: f64) -> Option<Message> {
    Some(Message::stamped(t, "map").pose(truth()[step].1))
}

const SLAM: Topic = ("/slam", "geometry_msgs/msg/PoseStamped", &slam);

#[test]
fn joints_of_zeros_give_way_to_dynamic_ones() {
    let zeros = |_: usize, t: f64| Some(Message::joints(t, [0.0, 0.0]));
    let dynamic = |step: usize, t: f64| {
        let [v, w] = truth()[step].2;
        let message = Message::stamped(t, "").count(2).text("left").text("right").count(2);
        let side = |message: Message, speed: f64| {
            message.count(1).text("velocity").count(1).numbers(&[speed / RADIUS])
        };
        Some(side(side(message, v - 0.4 * w), v + 0.4 * w))
    };
    let dynamic: Topic = ("/dynamic", "control_msgs/msg/DynamicJointState", &dynamic);
    let found = read(&[("/joints", JOINT_STATE, &zeros), dynamic, SLAM]);
    let expected = read(&[JOINTS, SLAM]);
    assert_eq!(found.runs()[0].tracks(), expected.runs()[0].tracks());
    assert_says(&found, "its joints never move, as those of DynamicJointState do");
}

#[test]
fn wheels_without_numbers_are_left_out() {
    let wheels = |step: usize, t: f64| {
        let [v, w] = truth()[step].2;
        let names = ["front_left", "front_right", "rear_left", "rear_right"];
        let message = names.iter().fold(Message::stamped(t, "").count(4), |m, name| m.text(name));
        let [left, right] = [(v - 0.4 * w) / RADIUS, (v + 0.4 * w) / RADIUS];
        let message = message.count(0).count(4).numbers(&[left, right, f64::NAN, f64::NAN]);
        Some(message.count(0))
    };
    let found = read(&[("/joints", JOINT_STATE, &wheels), SLAM]);
    assert_eq!(found.runs()[0].tracks(), read(&[JOINTS, SLAM]).runs()[0].tracks());
    assert_says(&found, "all but rear_left, rear_right, which have no number");
}
