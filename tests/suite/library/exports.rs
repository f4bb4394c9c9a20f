//! What a log calls the parts of a robot goes into its kinematics file, and from there into
//! exports.

use crate::recording::drives::{Bag, RADIUS, at, quaternion};
use std::path::Path;
use trackdyn::export::{FrameSettings, Ros2Settings, WheelChoices};
use trackdyn::{
    Error, Export, Gauge, IcrMap, IdentifySettings, MapSettings, Parameters, Provenance,
    ReadOptions, Recording, Vehicle, icr_map, identify,
};
use trackdyn_estimate::synthetic::{Synthetic, random_steps};
use trackdyn_recording::PoseSample;

/// The kinematics files of a log with one wheel on each side, whose poses are those of a frame.
fn identified(folder: &Path) {
    let drive = Synthetic {
        schedules: vec![random_steps(30, 2.0, 0.8, 1)],
        encoder_noise: 0.01,
        position_noise: 0.002,
        yaw_noise: 0.002,
        ..Synthetic::default()
    };
    let drive = drive.recording().expect("long enough");
    let mut bag = Bag::default();
    for row in drive.runs()[0].tracks() {
        let speeds = [row.v_left / RADIUS, row.v_right / RADIUS];
        bag.joints("/joint_states", at(row.t), &["left_wheel", "right_wheel"], [&[], &speeds]);
    }
    for PoseSample { t, pose } in drive.runs()[0].poses() {
        let frames = ["map", "/base_footprint"];
        bag.transform(at(*t), frames, [pose.x, pose.y], quaternion(pose.yaw));
    }
    let (_log, path) = bag.write();
    let mut options = ReadOptions::default();
    options.bag.wheel_radius = Some(RADIUS);
    let recording = Recording::open(&path, &options).expect("readable");
    let gauge = Gauge::new(0.42).expect("a gauge");
    let found = identify(&recording, &gauge, &IdentifySettings::default()).expect("enough");
    found.write(folder, &Provenance::default()).expect("written");
}

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).expect("text")
}

#[test]
fn exports_take_joints_radius_and_frame_from_the_log() {
    let folder = tempfile::tempdir().expect("a folder");
    identified(folder.path());
    let file = folder.path().join("kinematics.toml");
    for name in ["kinematics.toml", "identification.toml"] {
        let table: toml::Table = text(&folder.path().join(name)).parse().expect("TOML");
        let bag = &table["source"]["bag"];
        assert_eq!(bag["left_joints"][0].as_str(), Some("left_wheel"), "{name}: {bag}");
        assert_eq!(bag["wheel_radius_m"].as_float(), Some(RADIUS), "{name}: {bag}");
        assert_eq!(bag["track_topics"][0].as_str(), Some("/joint_states"), "{name}: {bag}");
        assert_eq!(bag["pose_topic"].as_str(), Some("/slam/frame"), "{name}: {bag}");
        assert_eq!(bag["parent_frame"].as_str(), Some("map"), "{name}: {bag}");
    }
    let export = Export::open(&file, &Provenance::default()).expect("a file");
    let wheels = export.wheels(&WheelChoices::default()).expect("all is known");
    assert_eq!(wheels.joints.left[0].to_string(), "left_wheel");
    assert_eq!(wheels.joints.right[0].to_string(), "right_wheel");
    assert_eq!(wheels.wheel_radius, RADIUS);
    assert_eq!(wheels.from_log.len(), 3, "{:?}", wheels.from_log);
    assert!(wheels.usual.is_empty(), "{:?}", wheels.usual);
    let base = export.base_frame(None).expect("a name");
    assert_eq!(base.name.to_string(), "base_footprint");
    // what is chosen counts
    let chosen = WheelChoices { wheel_radius: Some(0.2), ..WheelChoices::default() };
    let wheels = export.wheels(&chosen).expect("all is known");
    assert_eq!((wheels.wheel_radius, wheels.from_log.len()), (0.2, 2));
    let name = "base_link".parse().expect("a name");
    assert_eq!(export.base_frame(Some(&name)).expect("a name").name, name);

    let frames = FrameSettings { base: base.name, ..FrameSettings::default() };
    let settings = Ros2Settings { frames, ..Ros2Settings::new(RADIUS) };
    let files = export.ros2(&settings).expect("sound");
    assert!(files.iter().all(|file| file.text.contains("# vehicle: vehicle not given")));
}

#[test]
fn names_that_no_controller_can_have_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    identified(folder.path());
    let file = folder.path().join("kinematics.toml");
    let good = text(&file);
    let open = || Export::open(&file, &Provenance::default()).expect("a file");
    for (name, part) in [("-left_wheel", "backwards"), ("2nd wheel", "begins with a letter")] {
        std::fs::write(&file, good.replace("\"left_wheel\"", &format!("\"{name}\"")))
            .expect("written");
        let error = open().wheels(&WheelChoices::default()).expect_err(name);
        assert_eq!(error.setting(), Some("left_joints"));
        let message = error.to_string();
        assert!(message.starts_with("left_joints") && message.contains(part), "{message}");
        // frames do not depend on wheels
        assert!(open().base_frame(None).is_ok());
    }
}

/// A map knows no joints: names are the usual ones, and the radius has to be given.
#[test]
fn parameters_of_no_log_need_a_radius() {
    let map: IcrMap = icr_map(&Vehicle::auriga_alpha(), &MapSettings::default());
    let parameters: Parameters = map.parameters(&Provenance::default()).expect("it turns");
    let export = Export::new(&parameters, &Provenance::default()).expect("sound");
    let error = export.wheels(&WheelChoices::default()).expect_err("no radius");
    assert!(matches!(error, Error::NoWheelRadius { .. }));
    assert_eq!(error.setting(), Some("wheel_radius"));
    let chosen = WheelChoices { wheel_radius: Some(0.1), ..WheelChoices::default() };
    let wheels = export.wheels(&chosen).expect("the usual names");
    assert_eq!(wheels.joints.left[0].to_string(), "left_wheel_joint");
    assert!(wheels.from_log.is_empty() && wheels.usual.is_empty());
}
