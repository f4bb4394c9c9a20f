//! Other sources of poses and track speeds: paths, fixes, poses without a stamp, twists.

use super::drives::{ns, quaternion};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use trackdyn_recording::rosbag::{self, RosbagOptions};
use trackdyn_recording::{Recording, Warning};
use trackdyn_tests::cdr;

pub(super) const COUNT: u32 = 400;
pub(super) const RADIUS: f64 = 0.1;
/// Metres of a degree of latitude and of longitude at 45 degrees north (NGA).
const DEGREE: [f64; 2] = [111_131.75, 78_846.81];

/// Time in s, pose (x, y, yaw), speed and yaw rate at a step of 0.1 s: straights and arcs.
pub(super) fn truth() -> Vec<(f64, [f64; 3], [f64; 2])> {
    let (mut x, mut y, mut yaw) = (0.0, 0.0, 0.4_f64);
    let step = |k: u32| {
        let yaw_rate = if k % 100 < 70 { 0.0 } else { 0.5 };
        let row = (0.1 * f64::from(k), [x, y, yaw], [1.0, yaw_rate]);
        yaw += 0.1 * yaw_rate;
        (x, y) = (x + 0.1 * yaw.cos(), y + 0.1 * yaw.sin());
        row
    };
    (0..COUNT).map(step).collect()
}

/// A message that is built in a chain.
pub(super) struct Message(cdr::Message);

impl Message {
    pub(super) fn new() -> Self {
        Self(cdr::Message::bare())
    }

    pub(super) fn stamped(t: f64, frame: &str) -> Self {
        Self::new().header(t, frame)
    }

    pub(super) fn header(mut self, t: f64, frame: &str) -> Self {
        self.0.header(1_000_000_000_000 + ns(t), frame);
        self
    }

    pub(super) fn count(mut self, count: usize) -> Self {
        self.0.count(count);
        self
    }

    pub(super) fn text(mut self, text: &str) -> Self {
        self.0.text(text);
        self
    }

    pub(super) fn numbers(mut self, values: &[f64]) -> Self {
        self.0.numbers(values);
        self
    }

    pub(super) fn pose(self, [x, y, yaw]: [f64; 3]) -> Self {
        self.numbers(&[x, y, 0.3]).numbers(&quaternion(yaw))
    }

    pub(super) fn twist(self, [forward, yaw_rate]: [f64; 2]) -> Self {
        self.numbers(&[forward, 0.0, 0.0, 0.0, 0.0, yaw_rate])
    }

    pub(super) fn fix(mut self, status: i8, [x, y]: [f64; 2]) -> Self {
        self.0.bytes(1, &status.to_le_bytes());
        self.0.bytes(2, &[1, 0]);
        let place = [45.0 + y / DEGREE[0], 8.0 + x / DEGREE[1], 200.0];
        self.numbers(&place).numbers(&[0.0; 9])
    }

    pub(super) fn imu(self, yaw: f64, covariance: f64) -> Self {
        self.numbers(&quaternion(yaw)).numbers(&[covariance]).numbers(&[0.0; 8 + 3 + 9 + 3 + 9])
    }

    /// A yaw rate without an orientation.
    fn imu_rate(self, rate: f64) -> Self {
        let none = self.numbers(&quaternion(0.0)).numbers(&[-1.0]).numbers(&[0.0; 8]);
        none.numbers(&[0.0, 0.0, rate])
            .numbers(&[0.0; 9])
            .numbers(&[0.0, 0.0, 9.81])
            .numbers(&[0.0; 9])
    }

    pub(super) fn joints(t: f64, speeds: [f64; 2]) -> Self {
        let names = Self::stamped(t, "").count(2).text("left").text("right");
        names.count(0).count(2).numbers(&speeds).count(0)
    }
}

/// Topic, type, and the message of each step, where it has one.
pub(super) type Topic<'a> = (&'a str, &'a str, &'a dyn Fn(usize, f64) -> Option<Message>);

/// Writes a bag; each message is logged at the time of its step.
pub(super) fn bag(folder: &Path, topics: &[Topic]) -> PathBuf {
    let path = folder.join("drive.mcap");
    let file = std::io::BufWriter::new(std::fs::File::create(&path).expect("a file"));
    let mut writer = mcap::Writer::new(file).expect("a writer");
    let channel = |(topic, kind, _): &Topic| {
        let schema = writer.add_schema(kind, "ros2msg", b"").expect("a schema");
        writer.add_channel(schema, topic, "cdr", &BTreeMap::new()).expect("a channel")
    };
    let channels: Vec<u16> = topics.iter().map(channel).collect();
    for step in 0..COUNT {
        let log_time = 1_000_000_000_000 + u64::from(step) * 100_000_000;
        for ((_, _, make), &channel_id) in topics.iter().zip(&channels) {
            let Some(message) = make(step as usize, 0.1 * f64::from(step)) else { continue };
            let header = mcap::records::MessageHeader {
                channel_id,
                sequence: step,
                log_time,
                publish_time: log_time,
            };
            writer.write_to_known_channel(&header, &message.0.0).expect("written");
        }
    }
    writer.finish().expect("finished");
    path
}

pub(super) fn options() -> RosbagOptions {
    RosbagOptions { wheel_radius: Some(RADIUS), ..RosbagOptions::default() }
}

/// Speeds of a drive with tracks 0.8 m apart, in rad/s.
pub(super) fn joints(step: usize, t: f64) -> Option<Message> {
    let [v, w] = truth()[step].2;
    Some(Message::joints(t, [(v - 0.4 * w) / RADIUS, (v + 0.4 * w) / RADIUS]))
}

pub(super) const JOINTS: Topic = ("/joints", "sensor_msgs/msg/JointState", &joints);

/// Poses are those of the truth within `near` metres and radians; how many there are.
#[track_caller]
pub(super) fn assert_poses(recording: &Recording, near: f64) -> usize {
    let truth = truth();
    let poses = recording.runs()[0].poses();
    for row in poses {
        let (_, [x, y, yaw], _) =
            truth.iter().find(|(t, ..)| (t - row.t).abs() < 1e-6).expect("a step");
        let off = [row.pose.x - x, row.pose.y - y, row.pose.yaw - yaw];
        assert!(off.iter().all(|off| off.abs() < near), "{off:?} at {}", row.t);
    }
    poses.len()
}

#[test]
fn growing_paths_give_their_poses_and_plans_do_not() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let all = truth();
    let path_of = |steps: std::ops::RangeInclusive<usize>, sent: f64| {
        let count = steps.clone().count();
        steps.fold(Message::stamped(sent, "map").count(count), |message, step| {
            message.header(all[step].0, "map").pose(all[step].1)
        })
    };
    let driven = |step: usize, t: f64| (step % 10 == 9).then(|| path_of(0..=step, t));
    let plan = |step: usize, t: f64| Some(path_of(step..=(step + 5).min(399), t));
    let kind = "nav_msgs/msg/Path";
    let bag_path =
        bag(folder.path(), &[JOINTS, ("/driven", kind, &driven), ("/plan", kind, &plan)]);
    let recording = rosbag::read(&bag_path, &options()).expect("readable");
    assert_eq!(assert_poses(&recording, 1e-9), COUNT as usize);
    let skipped = recording.warnings().iter().find_map(|warning| match warning {
        Warning::MessagesSkipped { topic, reason, .. } if topic == "/plan" => Some(reason.clone()),
        _ => None,
    });
    assert!(skipped.expect("a warning").contains("plan"));
}

#[test]
fn poses_without_a_stamp_and_arrays_of_one_are_read_where_nothing_better_is() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let bare = |step: usize, _| Some(Message::new().pose(truth()[step].1));
    let one = |step: usize, t| Some(Message::stamped(t, "map").count(1).pose(truth()[step].1));
    let many =
        |_: usize, t| Some(Message::stamped(t, "map").count(2).pose([7.0; 3]).pose([8.0; 3]));
    for (kind, make) in [
        ("geometry_msgs/msg/Pose", &bare as &dyn Fn(usize, f64) -> Option<Message>),
        ("geometry_msgs/msg/PoseArray", &one),
    ] {
        let path = bag(folder.path(), &[JOINTS, ("/p", kind, make)]);
        let recording = rosbag::read(&path, &options()).expect(kind);
        assert_eq!(assert_poses(&recording, 1e-9), COUNT as usize);
    }
    // poses of several people beside a pose of the robot change nothing
    let stamped = |step: usize, t| Some(Message::stamped(t, "map").pose(truth()[step].1));
    let path = bag(
        folder.path(),
        &[
            JOINTS,
            ("/goal", "geometry_msgs/msg/Pose", &bare),
            ("/people", "geometry_msgs/msg/PoseArray", &many),
            ("/slam", "geometry_msgs/msg/PoseStamped", &stamped),
        ],
    );
    let recording = rosbag::read(&path, &options()).expect("readable");
    assert_eq!(assert_poses(&recording, 1e-9), COUNT as usize);
}

#[test]
fn fixes_are_poses_with_the_yaw_of_an_imu_and_are_refused_without() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let fix = |step: usize, t: f64| {
        let [x, y, _] = truth()[step].1;
        let status = if step % 50 == 49 { -1 } else { 0 };
        (step % 2 == 1).then(|| Message::stamped(t, "gps").fix(status, [x, y]))
    };
    let with_yaw = |offset: f64, covariance: f64| {
        move |step: usize, t: f64| {
            Some(Message::stamped(t, "imu").imu(truth()[step].1[2] + offset, covariance))
        }
    };
    let (yaw, off, none) = (with_yaw(0.0, 0.01), with_yaw(1.3, 0.01), with_yaw(0.0, -1.0));
    let fixes: Topic = ("/fix", "sensor_msgs/msg/NavSatFix", &fix);
    let kind = "sensor_msgs/msg/Imu";
    let path = bag(folder.path(), &[JOINTS, fixes, ("/imu", kind, &yaw)]);
    let recording = rosbag::read(&path, &options()).expect("readable");
    let poses = recording.runs()[0].poses();
    // the first fix is that of step 1
    let (all, first) = (truth(), truth()[1].1);
    assert_eq!(poses.len(), 200 - 8);
    for row in poses {
        let row_truth = all.iter().find(|(t, ..)| (t - row.t).abs() < 1e-6).expect("a step").1;
        let off = [row.pose.x - (row_truth[0] - first[0]), row.pose.y - (row_truth[1] - first[1])];
        assert!(off.iter().all(|off| off.abs() < 1e-2), "{off:?} at {}", row.t);
        assert!((row.pose.yaw - row_truth[2]).abs() < 1e-9);
    }
    let skipped = |warning: &&Warning| match warning {
        Warning::MessagesSkipped { topic, count: 8, reason } => {
            topic == "/fix" && reason.contains("no fix")
        }
        _ => false,
    };
    assert_eq!(recording.warnings().iter().filter(skipped).count(), 1);
    assert!(recording.warnings().iter().any(|one| matches!(one, Warning::FromFixes { .. })));

    // A gyroscope that counts from nowhere is turned to the course.
    let rate = |step: usize, t: f64| {
        let [_, turn] = truth()[step].2;
        Some(Message::stamped(t, "imu").imu_rate(turn))
    };
    let path = bag(folder.path(), &[JOINTS, fixes, ("/imu", kind, &rate)]);
    let recording = rosbag::read(&path, &options()).expect("readable");
    let poses = recording.runs()[0].poses();
    assert!(poses.len() > 180, "{}", poses.len());
    for row in poses {
        let row_truth = all.iter().find(|(t, ..)| (t - row.t).abs() < 1e-6).expect("a step").1;
        // A rate holds for 0.1 s, in which the robot turns by 0.05 rad.
        assert!((row.pose.yaw - row_truth[2]).abs() < 0.05, "{} {}", row.pose.yaw, row_truth[2]);
    }
    assert!(recording.warnings().iter().any(|one| matches!(one, Warning::FromCourse { .. })));

    let named = RosbagOptions { pose_topic: Some("/fix".into()), ..options() };
    let refused = |topics: &[Topic]| {
        let path = bag(folder.path(), topics);
        rosbag::read(&path, &named).map(drop).expect_err("refused").to_string()
    };
    let text = refused(&[JOINTS, fixes]);
    assert!(text.contains("there is no sensor_msgs/Imu whose orientation changes"), "{text}");
    assert!(text.contains("(--pose-topic)") && text.contains("(--columns)"), "{text}");
    let (rear, kind_of_fix, rows) = ("/rear/fix", fixes.1, fixes.2);
    let path = bag(folder.path(), &[JOINTS, fixes, (rear, kind_of_fix, rows)]);
    let text = rosbag::read(&path, &options()).map(drop).expect_err("refused").to_string();
    assert!(text.contains("several receivers, /fix, /rear/fix"), "{text}");
    let text = refused(&[JOINTS, fixes, ("/imu", kind, &none)]);
    assert!(text.contains("positions without yaw"), "{text}");
    assert!(text.contains("--pose-topic /imu takes its yaw alone"), "{text}");
    let text = refused(&[JOINTS, fixes, ("/imu", kind, &off)]);
    assert!(text.contains("off the course of the fixes by 7"), "{text}");
}

#[test]
fn speeds_of_the_body_are_tracks_with_an_option_and_an_offer_without() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let slam = |step: usize, t| Some(Message::stamped(t, "map").pose(truth()[step].1));
    let slam: Topic = ("/slam", "geometry_msgs/msg/PoseStamped", &slam);
    let odometry = |step: usize, t| {
        let (_, pose, twist) = truth()[step];
        let message = Message::stamped(t, "odom").text("base").pose(pose).numbers(&[0.0; 36]);
        Some(message.twist(twist).numbers(&[0.0; 36]))
    };
    let stamped = |step: usize, t| Some(Message::stamped(t, "base").twist(truth()[step].2));
    let bare = |step: usize, _| Some(Message::new().twist(truth()[step].2));
    for (kind, make) in [
        ("nav_msgs/msg/Odometry", &odometry as &dyn Fn(usize, f64) -> Option<Message>),
        ("geometry_msgs/msg/TwistStamped", &stamped),
        ("geometry_msgs/msg/Twist", &bare),
    ] {
        let path = bag(folder.path(), &[("/wheels", kind, make), slam]);
        let mut wanted = RosbagOptions { pose_topic: Some("/slam".into()), ..options() };
        let text = rosbag::read(&path, &wanted).map(drop).expect_err("no joints").to_string();
        assert!(text.contains("--twist-topic /wheels --separation METRES"), "{text}");
        wanted.twist_topic = Some("/wheels".into());
        let text = rosbag::read(&path, &wanted).map(drop).expect_err("no radius").to_string();
        assert!(text.contains("needs the separation"), "{text}");
        wanted.separation = Some(0.8);
        let text = rosbag::read(&path, &wanted).map(drop).expect_err("a radius").to_string();
        assert!(text.contains("--wheel-radius") && text.contains("expected no radius"), "{text}");
        wanted.wheel_radius = None;
        wanted.pose_topic = None;
        let recording = rosbag::read(&path, &wanted).expect("readable");
        let tracks = recording.runs()[0].tracks();
        assert_eq!(tracks.len(), COUNT as usize);
        for (row, (_, _, [v, w])) in tracks.iter().zip(truth()) {
            assert!((row.v_left - (v - 0.4 * w)).abs() < 1e-12);
            assert!((row.v_right - (v + 0.4 * w)).abs() < 1e-12);
        }
        assert_eq!(assert_poses(&recording, 1e-9), COUNT as usize);
        let told = Warning::FromTwist { topic: "/wheels".into(), separation: 0.8 };
        assert!(recording.warnings().contains(&told), "{:?}", recording.warnings());
    }
}

#[test]
fn a_twist_needs_its_separation_and_takes_the_place_of_joints() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let twist = |step: usize, t| Some(Message::stamped(t, "base").twist(truth()[step].2));
    let slam = |step: usize, t| Some(Message::stamped(t, "map").pose(truth()[step].1));
    let path = bag(
        folder.path(),
        &[
            ("/wheels", "geometry_msgs/msg/TwistStamped", &twist),
            ("/slam", "geometry_msgs/msg/PoseStamped", &slam),
        ],
    );
    let read = |options: &RosbagOptions| rosbag::read(&path, options).map(drop);
    let refused = |options: &RosbagOptions| read(options).expect_err("refused").to_string();
    let named = RosbagOptions { twist_topic: Some("/wheels".into()), ..RosbagOptions::default() };
    let text = refused(&named);
    assert!(text.contains("expected --separation METRES, a number above zero"), "{text}");
    let text = refused(&RosbagOptions { separation: Some(0.8), ..RosbagOptions::default() });
    assert!(text.contains("expected with --twist-topic TOPIC"), "{text}");
    let both = RosbagOptions { separation: Some(0.8), ..named.clone() };
    read(&both).expect("readable");
    let text = refused(&RosbagOptions { tracks_topic: Some("/joints".into()), ..both.clone() });
    assert!(text.contains("--tracks-topic chooses joints"), "{text}");
    let text = refused(&RosbagOptions { twist_topic: Some("/whels".into()), ..both.clone() });
    assert!(text.contains("/whels is not there; choose by --twist-topic"), "{text}");
    let text = refused(&RosbagOptions { twist_topic: Some("/slam".into()), ..both });
    assert!(text.contains("/slam: 400 messages skipped, because its type has no speeds"), "{text}");

    let suggested = rosbag::inspect(&path).expect("readable").suggested;
    assert_eq!(suggested.twist_topic.as_deref(), Some("/wheels"));
    assert_eq!(suggested.pose_topic.as_deref(), Some("/slam"));
}

#[test]
fn goals_leave_the_poses_to_the_gyroscope() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let goal = |step: usize, t| {
        let place = if step < 200 { 1.0 } else { 2.0 };
        Some(Message::stamped(t, "map").count(1).pose([place, 0.0, 0.0]))
    };
    let imu = |step: usize, t| {
        let gyro = [0.0, 0.0, truth()[step].2[1]];
        let orientation = Message::stamped(t, "imu").numbers(&[0.0; 4]).numbers(&[-1.0]);
        Some(orientation.numbers(&[0.0; 8]).numbers(&gyro).numbers(&[0.0; 9 + 3 + 9]))
    };
    let path = bag(
        folder.path(),
        &[
            JOINTS,
            ("/goals", "geometry_msgs/msg/PoseArray", &goal),
            ("/imu", "sensor_msgs/msg/Imu", &imu),
        ],
    );
    let recording = rosbag::read(&path, &options()).expect("readable");
    let notes: Vec<String> = recording.warnings().iter().map(ToString::to_string).collect();
    assert!(notes.iter().any(|note| note.contains("changes 1 times in all")), "{notes:?}");
    assert!(notes.iter().any(|note| note.contains("the yaw of the gyroscope /imu")), "{notes:?}");
    let last = recording.runs()[0].poses().last().expect("poses").pose.yaw;
    // 0.5 rad/s for 3 s in each of four periods, less half a step at the end of the log
    assert!((last - (6.0 - 0.5 * 0.1)).abs() < 0.05, "{last}");
}
