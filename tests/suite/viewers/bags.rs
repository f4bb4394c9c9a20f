//! The files as bags.

use super::{bytes, layers, messages, replay, synthetic, synthetic_layers};
use crate::recording::drives::{Bag, RADIUS, at, poses, quaternion};
use std::collections::BTreeMap;
use trackdyn::crates::export::viewer::{PathLayer, bag};
use trackdyn::viewer::Layers;
use trackdyn::{Provenance, ReadOptions, Recording};
use trackdyn_core::{Pose, real};
use trackdyn_recording::SpeedUnit;

/// Definitions of ROS 2 Humble, by name: their members in order.
const DEFINITIONS: [(&str, &str); 8] = [
    ("geometry_msgs/msg/PoseStamped", "header pose | stamp frame_id | position orientation"),
    ("nav_msgs/msg/Path", "header poses | stamp frame_id | header pose"),
    ("tf2_msgs/msg/TFMessage", "transforms | header child_frame_id transform"),
    ("sensor_msgs/msg/JointState", "header name position velocity effort"),
    ("std_msgs/msg/Float64", "data"),
    ("std_msgs/msg/String", "data"),
    ("geometry_msgs/msg/TransformStamped", "header child_frame_id transform"),
    (
        "visualization_msgs/msg/MarkerArray",
        "markers | header ns id type action pose scale color lifetime frame_locked points colors \
         texture_resource texture uv_coordinates text mesh_resource mesh_file \
         mesh_use_embedded_materials",
    ),
];

/// Other programs know these definitions by name and may not ask the file.
#[test]
fn definitions_are_those_of_ros_2() {
    let file = bytes(&synthetic_layers());
    let summary = mcap::Summary::read(&file).expect("a bag").expect("a summary");
    let mut kinds = 0;
    for schema in summary.schemas.values() {
        let text = std::str::from_utf8(&schema.data).expect("a text");
        let parts = text.split("MSG: ").map(|part| {
            let members = part.lines().filter(|line| !line.contains('='));
            let names = members.filter_map(|line| Some(line.split_once(' ')?.1));
            names.collect::<Vec<_>>().join(" ")
        });
        let members = parts.collect::<Vec<_>>().join(" | ");
        let expected = DEFINITIONS.iter().find(|(kind, _)| *kind == schema.name);
        let (_, expected) = expected.unwrap_or_else(|| panic!("{}", schema.name));
        assert!(members.starts_with(expected), "{}: {members}", schema.name);
        kinds += 1;
    }
    assert_eq!(kinds, 6);
}

#[test]
fn a_file_has_the_same_bytes_each_time() {
    let [one, other] = [(); 2].map(|()| bytes(&synthetic_layers()));
    assert!(one == other);
}

/// The project's own reader takes track speeds and poses back as they were, at their time.
#[test]
fn the_reader_gets_back_what_was_read() {
    let mut options = ReadOptions::default();
    options.bag.wheel_radius = Some(RADIUS);
    // of a sensor ahead of the middle: poses of the middle itself would be wheel odometry
    let mut log = Bag::default().with_wheels();
    for (t, pose) in poses() {
        let (sin, cos) = pose.yaw.sin_cos();
        log.pose(at(t), [pose.x + 0.1 * cos, pose.y + 0.1 * sin], quaternion(pose.yaw));
    }
    let (_log, path) = log.write();
    let recording = Recording::open(&path, &options).expect("a bag");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let written = replay(&recording, "fit").write_layers(folder.path(), &Provenance::default());
    assert_eq!(written.expect("written").len(), 3);
    let mut options = ReadOptions::default();
    options.bag.pose_topic = Some("/trackdyn/observed/pose".to_owned());
    options.bag.speed_unit = Some(SpeedUnit::MetresPerSecond);
    let back = Recording::open(folder.path().join("odometry.mcap"), &options).expect("a bag");
    let epoch = |of: &Recording| of.motion().and_then(|motion| motion.source().epoch_ns);
    assert_eq!(epoch(&back), epoch(&recording));
    let ([before], [after]) = (recording.runs(), back.runs()) else { panic!("one run") };
    assert_eq!(after.tracks(), before.tracks());
    // those poses are replayed that lie within the time of the track speeds
    let end = before.tracks()[before.tracks().len() - 1].t;
    let poses = before.poses().iter().filter(|pose| pose.t <= end);
    assert_eq!(after.poses().len(), poses.clone().count());
    for (after, before) in after.poses().iter().zip(poses) {
        assert_eq!([after.t, after.pose.x, after.pose.y], [before.t, before.pose.x, before.pose.y]);
        assert!((after.pose.yaw - before.pose.yaw).abs() < 1e-12);
    }
}

/// Robots drive for hours: a path is thinned, its poses are not.
#[test]
fn long_paths_are_thinned() {
    let count = 5 * bag::MAX_PATH_POSES + 1;
    let drive = Layers {
        fixed_frame: "map".to_owned(),
        paths: vec![PathLayer {
            topic: "/observed".to_owned(),
            frame: "base_link".to_owned(),
            stamps: (0..).take(count).collect(),
            poses: (0..count).map(|k| Pose::new(real(k), 0.0, 0.0)).collect(),
            starts: vec![0],
            ..PathLayer::default()
        }],
        ..Layers::default()
    };
    let found = messages(&bytes(&drive));
    assert_eq!(found["/observed/pose"].len(), count);
    let path = &found["/observed/path"][0];
    assert_eq!(path.number("poses[]"), real(bag::MAX_PATH_POSES));
    let x = |k: usize| path.number(&format!("poses[{k}].pose.position.x"));
    assert_eq!([x(0), x(bag::MAX_PATH_POSES - 1)], [0.0, real(count - 1)]);
    let steps = (1..bag::MAX_PATH_POSES).map(|k| x(k) - x(k - 1));
    assert!(steps.into_iter().all(|step| (5.0..=6.0).contains(&step)));
}

#[test]
fn what_no_viewer_shows_is_refused() {
    let refused = |layers: &Layers| {
        bag::write(layers, std::io::Cursor::new(Vec::new())).expect_err("refused").to_string()
    };
    assert!(refused(&Layers::default()).starts_with("no poses: expected"));
    let mut late = synthetic_layers();
    *late.paths[0].stamps.last_mut().expect("poses") = 1 << 62;
    let error = refused(&late);
    assert!(error.contains("4611686018427387904 ns: expected Unix time before"), "{error}");
}

/// Names of files become names of topics, and stay apart.
#[test]
fn every_set_has_its_topics() {
    let recording = synthetic().recording().expect("runs").into();
    for (name, topic) in [("observed", "observed_2"), ("a--b c", "a_b_c"), ("2nd", "set_2nd")] {
        let layers = layers(&recording, name);
        let topics: Vec<&str> = layers.paths.iter().map(|path| path.topic.as_str()).collect();
        assert_eq!(topics, ["observed", "ideal", topic].map(|of| format!("/trackdyn/{of}")));
        let mut once: BTreeMap<&str, usize> = BTreeMap::new();
        for curve in layers.curves() {
            *once.entry(&curve.topic).or_default() += 1;
        }
        assert!(once.values().all(|count| *count == 1), "{once:?}");
    }
}
