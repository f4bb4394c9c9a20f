//! Clocks and axes of transforms that are composed along a chain.

use super::sources::{COUNT, JOINTS, Message, Topic, assert_poses, bag, options, truth};
use trackdyn_core::Pose;
use trackdyn_recording::rosbag::{self, Dating, RosbagOptions};
use trackdyn_recording::{Axes, Doubt, DoubtKind, Error, Warning};

const TF: &str = "tf2_msgs/msg/TFMessage";

fn chained() -> RosbagOptions {
    RosbagOptions {
        parent_frame: Some("map".to_owned()),
        child_frame: Some("base_link".to_owned()),
        ..options()
    }
}

/// A correction that stands, and the pose in the frame of odometry; both by a clock of their own.
fn transforms(ahead: f64) -> impl Fn(usize, f64) -> Option<Message> {
    move |step, t| {
        let message = Message::new().count(2).header(t + ahead, "map").text("odom");
        let message = message.pose([0.0; 3]).header(t + ahead, "odom").text("base_link");
        Some(message.pose(truth()[step].1))
    }
}

#[test]
fn a_chain_by_another_clock_is_dated_by_its_logging() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (ahead, is_other) in [(0.0, false), (-0.1, false), (100.0, true), (-37.0, true)] {
        let make = transforms(ahead);
        let tf: Topic = ("/tf", TF, &make);
        let path = bag(folder.path(), &[JOINTS, tf]);
        let recording = rosbag::read(&path, &chained()).expect("a chain");
        let is_told = |warning: &Warning| {
            matches!(warning, Warning::ClocksDiffer { by_log: true, topics, .. }
                if topics[1].contains("odom -> base_link"))
        };
        assert_eq!(recording.warnings().iter().any(is_told), is_other, "{ahead}");
        if ahead == 0.0 || is_other {
            assert_eq!(assert_poses(&recording, 1e-9), COUNT as usize, "{ahead}");
        }
        let by_stamps = RosbagOptions { dated_by: Dating::Header, ..chained() };
        let recording = rosbag::read(&path, &by_stamps).expect("a chain");
        let run = &recording.runs()[0];
        let offset = run.poses()[0].t - run.tracks()[0].t;
        assert!((offset - ahead).abs() < 1e-6, "{offset}");
    }
}

/// A localisation stamps its correction ahead, so that it holds until the next one.
#[test]
fn corrections_that_are_stamped_ahead_are_no_other_clock() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let make = |step: usize, t: f64| {
        let message = Message::new().count(2).header(t + 1.0, "map").text("odom");
        let message = message.pose([0.0; 3]).header(t, "odom").text("base_link");
        Some(message.pose(truth()[step].1))
    };
    let path = bag(folder.path(), &[JOINTS, ("/tf", TF, &make)]);
    let recording = rosbag::read(&path, &chained()).expect("a chain");
    let differ = |warning: &Warning| matches!(warning, Warning::ClocksDiffer { .. });
    assert!(!recording.warnings().iter().any(differ), "{:?}", recording.warnings());
    // the first second has no correction yet
    assert_eq!(assert_poses(&recording, 1e-9), COUNT as usize - 10);
}

/// Odometry that is wrong, and a map that corrects it once in a second and is sent at each step.
#[test]
fn poses_between_the_corrections_of_a_map_are_left_out() {
    let pose = |[x, y, yaw]: [f64; 3]| Pose::new(x, y, yaw);
    let row = |pose: Pose| [pose.x, pose.y, pose.yaw];
    let odometry = |step: usize| {
        let [x, y, yaw] = truth()[step].1;
        pose([0.9 * x, 0.9 * y, 1.5 * yaw])
    };
    for ahead in [0.0, 0.5] {
        let make = |step: usize, t: f64| {
            let corrected = step - step % 10;
            let map = pose(truth()[corrected].1).compose(&odometry(corrected).inverse());
            let message = Message::new().count(2).header(t + ahead, "map").text("odom");
            let message = message.pose(row(map)).header(t, "odom").text("base_link");
            Some(message.pose(row(odometry(step))))
        };
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = bag(folder.path(), &[JOINTS, ("/tf", TF, &make)]);
        let recording = rosbag::read(&path, &chained()).expect("a chain");
        // when the first value was measured is not known
        assert_eq!(assert_poses(&recording, 1e-9), COUNT as usize / 10 - 1);
        let is_told = |warning: &Warning| {
            matches!(warning, Warning::DeadReckoning(of) if of.corrections == 39
                && (of.interval - 1.0).abs() < 1e-6 && of.frame == "odom")
        };
        assert!(recording.warnings().iter().any(is_told), "{:?}", recording.warnings());
    }
}

#[test]
fn an_optical_frame_at_the_end_of_a_chain_is_named() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let make = |step: usize, t: f64| {
        let [x, y, yaw] = truth()[step].1;
        let (sin, cos) = (0.5 * yaw).sin_cos();
        // yaw about z, then the axes of a camera: (w, x, y, z) = (1, -1, 1, -1)/2
        let [w, i, j, k] = [0.5, -0.5, 0.5, -0.5];
        let quaternion =
            [cos * i - sin * j, cos * j + sin * i, cos * k + sin * w, cos * w - sin * k];
        let message = Message::new().count(2).header(t, "map").text("odom").pose([0.0; 3]);
        let message = message.header(t, "odom").text("base_link").numbers(&[x, y, 0.3]);
        Some(message.numbers(&quaternion))
    };
    let path = bag(folder.path(), &[JOINTS, ("/tf", TF, &make)]);
    let error = rosbag::read(&path, &chained()).map(drop).expect_err("refused");
    let text = error.to_string();
    let is_camera = matches!(
        &error,
        Error::Contradiction { doubt: Doubt::OutOfPlane { axes: Axes::Camera, .. }, .. }
    );
    assert!(is_camera && text.contains("optical frame"), "{text}");
    let options = RosbagOptions { accepted: vec![DoubtKind::OutOfPlane], ..chained() };
    match rosbag::read(&path, &options) {
        Ok(recording) => {
            let is_told = |warning: &Warning| matches!(warning, Warning::Accepted(_));
            assert!(recording.warnings().iter().any(is_told));
        }
        Err(error) => assert!(!error.to_string().contains("optical frame"), "{error}"),
    }
}
