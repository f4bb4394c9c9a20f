//! Recordings of all kinds by one function, and what is refused.

use super::driven;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use trackdyn::{
    DiagnoseSettings, Error, HeldOut, IdentifySettings, OdometrySettings, Part, ReadOptions,
    Recording, Vehicle, diagnose, identify, odometry,
};

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/recordings").join(name)
}

/// A table of steady points, by the ICRs of Auriga-alpha.
fn table(folder: &Path) -> Recording {
    let mut text = String::from("v_left,v_right,v_forward,v_lateral,yaw_rate\n");
    for left in -4..=4 {
        for right in -4..=4 {
            let (i, j): (i32, i32) = (left, right);
            let (left, right) = (0.2 * f64::from(i), 0.2 * f64::from(j));
            // a scatter of a milliradian a second, as measurements have
            let scatter = 1e-3 * f64::from((7 * i + 3 * j).rem_euclid(5) - 2);
            let yaw_rate = (right - left) / 0.832 + scatter;
            let forward = f64::midpoint(left, right);
            let lateral = -0.05 * yaw_rate;
            let _ = writeln!(text, "{left},{right},{forward},{lateral},{yaw_rate}");
        }
    }
    let path = folder.join("points.csv");
    std::fs::write(&path, text).expect("written");
    Recording::open(&path, &ReadOptions::default()).expect("a table")
}

#[test]
fn bags_and_tables_are_opened_alike() {
    let mut options = ReadOptions::default();
    options.bag.wheel_radius = Some(0.1);
    let bags = ["drive.mcap", "drive.db3"].map(|name| {
        let recording = Recording::open(fixture(name), &options).expect(name);
        recording.motion().expect("motion").runs().to_vec()
    });
    assert_eq!(bags[0], bags[1]);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let points = table(folder.path());
    assert!(points.motion().is_none() && points.points().expect("points").points().len() == 81);
}

#[test]
fn options_that_do_not_go_with_the_format_are_named() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    table(folder.path());
    let options = ReadOptions { tracks: Some("tracks.csv".into()), ..ReadOptions::default() };
    let of_bag = Recording::open(fixture("drive.mcap"), &options).expect_err("no trajectory");
    assert_eq!(of_bag.setting(), Some("tracks"));
    let of_table = Recording::open(folder.path().join("points.csv"), &options);
    let error = of_table.expect_err("no trajectory").to_string();
    assert!(error.starts_with("tracks: ") && error.contains("holds steady points"), "{error}");
}

#[test]
fn a_recording_counts_once() {
    let recording = driven(1).recording;
    let twice = [recording.clone(), recording];
    let vehicle = Vehicle::auriga_alpha();
    let result = diagnose(&twice, &vehicle, &DiagnoseSettings::default());
    assert!(matches!(result, Err(Error::RecordingTwice { .. })));
    let result = diagnose(&[], &vehicle, &DiagnoseSettings::default());
    assert!(matches!(result, Err(Error::NoRecording)));
}

#[test]
fn a_table_of_points_has_neither_runs_nor_time() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (points, vehicle) = (table(folder.path()), Vehicle::auriga_alpha());
    let fit = identify(&points, &vehicle, &IdentifySettings::default()).expect("enough points");
    let icrs = fit.parameters().expect("determined").kinematics().icrs;
    assert!((icrs.x_right - icrs.x_left - 0.832).abs() < 1e-3 && (icrs.y - 0.05).abs() < 1e-6);
    let settings = IdentifySettings { tau: Some(0.1), ..IdentifySettings::default() };
    let error = identify(&points, &vehicle, &settings).expect_err("no time");
    assert!(matches!(error, Error::MotionOnly { ref settings, .. } if *settings == ["tau"]));
    let part = Part { runs: Some("0".parse().expect("a list")), time: None };
    assert!(matches!(points.part(&part), Err(Error::MotionOnly { .. })));
    let error = odometry(&points, &vehicle, &[], &OdometrySettings::default());
    assert!(matches!(error, Err(Error::NoMotion { .. })));
    let held_out = HeldOut::Runs("0".parse().expect("a list"));
    let settings = DiagnoseSettings { held_out, ..DiagnoseSettings::default() };
    let result = diagnose(std::slice::from_ref(&points), &vehicle, &settings);
    assert!(matches!(result, Err(Error::NoRunsToHoldOut { .. })));
    let several = [points, driven(1).recording];
    let result = diagnose(&several, &vehicle, &DiagnoseSettings::default());
    assert!(matches!(result, Err(Error::PointsNotAlone)));
}
