//! The examples of the library run, and write what they say.

use super::driven;
use std::path::Path;
use tempfile::TempDir;
use trackdyn::{Diagnosis, IdentifySettings, Provenance, Recording, Vehicle, identify};

#[path = "../../../crates/trackdyn/examples/custom_command.rs"]
#[expect(dead_code, reason = "its main is that of the example")]
mod custom_command;
#[path = "../../../crates/trackdyn/examples/diagnose.rs"]
#[expect(dead_code, reason = "its main is that of the example")]
mod diagnose;
#[path = "../../../crates/trackdyn/examples/log_to_odometry.rs"]
#[expect(dead_code, reason = "its main is that of the example")]
mod log_to_odometry;
#[path = "../../../crates/trackdyn/examples/map.rs"]
#[expect(dead_code, reason = "its main is that of the example")]
mod map;

fn folder() -> TempDir {
    TempDir::new().expect("a temporary folder")
}

fn are_there(folder: &Path, files: &[&str]) {
    for file in files {
        assert!(folder.join(file).is_file(), "{file} is missing");
    }
}

#[test]
fn a_map_is_solved_and_written() {
    let out = folder();
    map::run(out.path()).expect("it runs");
    are_there(out.path(), &["icr_map.png", "kinematics.toml"]);
}

#[test]
fn a_log_becomes_odometry() {
    let out = folder();
    log_to_odometry::run(out.path()).expect("it runs");
    let files = ["drive/recording.toml", "diff_drive_controller.yaml"];
    are_there(out.path(), &files);
}

#[test]
fn a_log_is_diagnosed() {
    let out = folder();
    diagnose::run(out.path()).expect("it runs");
    are_there(out.path(), &["diagnosis.toml", "vehicle.corrected.toml", "report.html"]);
    let corrected = Vehicle::open(out.path().join("vehicle.corrected.toml")).expect("a vehicle");
    assert!(corrected.effects().get("directional-lugs").is_some(), "{:?}", corrected.effects());
}

#[test]
fn a_new_command_takes_logs() {
    let out = folder();
    let log = out.path().join("drive");
    driven(2).write(&log, &Provenance::default()).expect("written");
    let arguments = [log.join("vehicle.toml"), log].map(|path| path.display().to_string());
    let table = custom_command::run(&arguments).expect("it runs");
    let row = table.lines().nth(1).expect("a row of the log");
    let chi: f64 = row.split_whitespace().next().expect("a cell").parse().expect("a number");
    // the printed steering efficiency of Auriga-alpha is 0.50
    assert!((0.4..0.6).contains(&chi), "{table}");
    assert!(custom_command::run(&[]).is_err());
}

/// What the front page promises to a program that keeps results: they are plain values.
#[test]
fn results_are_values() {
    fn is_value<T: Send + Sync + 'static>() {}
    is_value::<Recording>();
    is_value::<Diagnosis>();
    is_value::<trackdyn::Error>();
    let recording = driven(2).recording;
    let vehicle = Vehicle::auriga_alpha();
    let found = identify(&recording, &vehicle, &IdentifySettings::default());
    let kept = found.expect("enough driving").clone();
    drop((recording, vehicle));
    assert!(kept.parameters().is_some());
}
