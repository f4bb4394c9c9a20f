//! Joints that wrap and poses along chains of transforms, in bags written by the Python package
//! `rosbags` (`fixtures/make_rosbags.py`).

use std::path::{Path, PathBuf};
use trackdyn_core::Pose;
use trackdyn_recording::rosbag::{self, RosbagOptions};
use trackdyn_recording::{Recording, Warning};

const COUNT: usize = 20;
const RADIUS: f64 = 0.125;

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/recordings").join(name)
}

fn time(step: usize) -> f64 {
    0.05 * f64::from(u32::try_from(step).expect("small"))
}

/// Quotients of decimals and products of rotations: 1e-12 is their rounding.
#[track_caller]
fn assert_near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-12, "{found} instead of {expected}");
}

fn turns(topic: &str) -> Recording {
    let options = RosbagOptions {
        wheel_radius: Some(RADIUS),
        tracks_topic: Some(topic.to_owned()),
        ..RosbagOptions::default()
    };
    rosbag::read(&fixture("turns.mcap"), &options).expect("readable")
}

#[test]
fn positions_modulo_a_turn_give_the_speeds_of_the_wheels() {
    let recording = turns("/wrapped");
    let tracks = recording.runs()[0].tracks();
    assert_eq!(tracks.len(), COUNT - 1);
    for (step, sample) in tracks.iter().enumerate() {
        assert_near(sample.v_left, RADIUS * (2.25 + 2.0 * time(step)));
        assert_near(sample.v_right, RADIUS * (4.0 - time(step)));
    }
    let mut wraps: Vec<String> = Vec::new();
    for warning in recording.warnings() {
        match warning {
            Warning::TurnsAdded { joint, count, .. } => wraps.push(format!("{joint} {count}")),
            Warning::JointJumps { .. } => panic!("{warning}"),
            _ => {}
        }
    }
    assert_eq!(wraps, ["front_left 1", "front_right 1"]);
}

#[test]
fn a_jump_that_is_no_wrap_stays_and_is_told() {
    let recording = turns("/anew");
    let tracks = recording.runs()[0].tracks();
    let lost = 45.0 / 2.0 / 0.05;
    for (step, sample) in tracks.iter().enumerate() {
        let jump = if step == 11 { lost } else { 0.0 };
        assert!((sample.v_left - RADIUS * (2.25 + 2.0 * time(step) - jump)).abs() < 1e-9);
    }
    let said = recording.warnings().iter().any(|warning| {
        matches!(warning, Warning::JointJumps { joint, count: 1, t }
            if joint == "front_left" && (t - 0.6).abs() < 1e-9)
    });
    assert!(said, "{:?}", recording.warnings());
}

fn chain(parent: &str, child: &str) -> Result<Recording, trackdyn_recording::Error> {
    let options = RosbagOptions {
        wheel_radius: Some(RADIUS),
        parent_frame: Some(parent.to_owned()),
        child_frame: Some(child.to_owned()),
        ..RosbagOptions::default()
    };
    rosbag::read(&fixture("chain.db3"), &options)
}

fn truth(step: usize) -> Pose {
    let t = time(step);
    Pose::new(0.3 * t, -0.1 * t, 3.0 + 0.4 * t)
}

#[track_caller]
fn assert_poses(recording: &Recording, expected: impl Fn(usize) -> Pose) {
    // map -> odom ends at step 16: what comes later is not extrapolated
    let poses = recording.runs()[0].poses();
    assert_eq!(poses.len(), 17);
    for (step, sample) in poses.iter().enumerate() {
        let pose = expected(step);
        assert_near(sample.t, time(step));
        assert_near(sample.pose.x, pose.x);
        assert_near(sample.pose.y, pose.y);
        // yaw is continuous, and starts within half a turn
        let first = expected(0).yaw;
        let shift = trackdyn_core::pose::wrap_angle(first) - first;
        assert_near(sample.pose.yaw, pose.yaw + shift);
    }
}

#[test]
fn poses_are_composed_along_moving_and_static_transforms() {
    let recording = chain("/map", "base_link").expect("a chain");
    assert_poses(&recording, truth);
    let text = recording.warnings().iter().map(Warning::to_string).collect::<String>();
    for part in [
        "base_link in /map by map -> odom (5 stamps, at most 0.200 s apart), odom -> \
         base_footprint (20 stamps",
        "base_footprint -> base_link (static)",
        "at the stamps of odom -> base_footprint",
        "3 stamps that a link does not reach are left out",
    ] {
        assert!(text.contains(part), "{part:?} is not in {text}");
    }
    // a sensor that is mounted askew: the chain is composed in space
    let laser = Pose::new(0.3, 0.05, -1.0);
    let recording = chain("map", "laser").expect("a chain");
    assert_poses(&recording, |step| truth(step).compose(&laser));
}

#[test]
fn chains_are_followed_upwards_too() {
    let recording = chain("base_link", "map").expect("a chain");
    assert_poses(&recording, |step| truth(step).inverse());
}

#[test]
fn frames_that_nothing_links_are_refused_with_those_that_there_are() {
    for (parent, child, parts) in [
        ("map", "tool", ["no transforms lead from \"map\" to \"tool\"", "odom -> base_footprint"]),
        ("dock", "base_link", ["lead from \"dock\" to \"base_link\"", "dock -> sign"]),
        ("base_link", "laser", ["nothing moves", "base_link -> laser"]),
    ] {
        let text = chain(parent, child).expect_err("refused").to_string();
        assert!(parts.iter().all(|part| text.contains(part)), "{text}");
    }
}

#[test]
fn inspection_suggests_the_chain_from_the_root_to_the_body() {
    let inspection = rosbag::inspect(&fixture("chain.db3")).expect("readable");
    let suggested = inspection.suggested;
    assert_eq!(suggested.pose_topic.as_deref(), Some("/tf"));
    assert_eq!(suggested.parent_frame.as_deref(), Some("map"));
    assert_eq!(suggested.child_frame.as_deref(), Some("base_link"));
    let options = RosbagOptions { wheel_radius: Some(RADIUS), ..suggested };
    let recording = rosbag::read(&fixture("chain.db3"), &options).expect("readable");
    assert_poses(&recording, truth);
}

#[test]
fn a_byte_flipped_anywhere_in_the_transforms_never_panics() {
    let whole = std::fs::read(fixture("chain.db3")).expect("a fixture");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("chain.db3");
    let options = RosbagOptions {
        wheel_radius: Some(RADIUS),
        parent_frame: Some("map".to_owned()),
        child_frame: Some("laser".to_owned()),
        ..RosbagOptions::default()
    };
    let mut read = 0;
    for at in (0..whole.len()).step_by(61) {
        let mut bytes = whole.clone();
        bytes[at] ^= 0x41;
        std::fs::write(&path, &bytes).expect("written");
        if let Ok(recording) = rosbag::read(&path, &options) {
            let finite = |pose: &Pose| [pose.x, pose.y, pose.yaw].iter().all(|v| v.is_finite());
            assert!(recording.runs()[0].poses().iter().all(|sample| finite(&sample.pose)));
            read += 1;
        }
    }
    assert!(read > 0, "most bytes are text or padding");
}
