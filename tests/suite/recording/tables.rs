//! TUM trajectories and tables of steady operating points.

use std::path::PathBuf;
use tempfile::TempDir;
use trackdyn_recording::{OperatingPoint, OperatingPoints, tum};

fn file(folder: &TempDir, name: &str, text: &str) -> PathBuf {
    let path = folder.path().join(name);
    std::fs::write(&path, text).expect("written");
    path
}

const TRACKS: &str = "t,v_left,v_right\n10,0.1,0.2\n10.5,0.1,0.2\n";

#[test]
fn a_trajectory_goes_with_its_track_speeds() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (sin, cos) = 0.4_f64.sin_cos();
    // some editors mark text as Unicode
    let text =
        format!("\u{feff}# t x y z q\n10 1 2 0.3 0 0 {sin} {cos}\n\n  10.5\t1.5 2 0.3 0 0 0 1\n");
    let trajectory = file(&folder, "walk.txt", &text);
    let tracks = file(&folder, "tracks.csv", TRACKS);
    let recording = tum::read(&trajectory, &tracks, "robot").expect("accepted");
    assert_eq!((recording.name(), recording.robot()), ("walk", "robot"));
    let poses = recording.runs()[0].poses();
    assert_eq!((poses[0].t, poses[0].pose.x, poses[0].pose.y), (10.0, 1.0, 2.0));
    assert!((poses[0].pose.yaw - 0.8).abs() < 1e-15);
    assert_eq!((poses[1].pose.x, poses[1].pose.yaw), (1.5, 0.0));
    assert_eq!(recording.runs()[0].tracks().len(), 2);
}

#[test]
fn trajectories_that_do_not_fit_are_pointed_at() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let tracks = file(&folder, "tracks.csv", TRACKS);
    let refusal = |text: &str| {
        let trajectory = file(&folder, "walk.txt", text);
        tum::read(&trajectory, &tracks, "robot").expect_err("refused").to_string()
    };
    let text = refusal("# t\n0 0 0 0 0 0 zero 1\n");
    assert!(text.ends_with("walk.txt:2:7: qz = \"zero\": expected a number"), "{text}");
    let text = refusal("0 0 0 0 0 0 1\n");
    assert!(text.ends_with("walk.txt:1: 7 cells: expected 8"), "{text}");
    assert!(refusal("# nothing\n").contains("no poses"));
    let runs = file(&folder, "runs.csv", "run,t,v_left,v_right\n0,0,0,0\n");
    let walk = file(&folder, "walk.txt", "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n");
    let text = tum::read(&walk, &runs, "robot").expect_err("refused").to_string();
    assert!(text.contains("one run beside one trajectory"), "{text}");
}

#[test]
fn operating_points_leave_out_what_was_not_measured() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = file(
        &folder,
        "floor.csv",
        "yaw_rate,v_left,v_right,v_forward,v_lateral,note\n0.5,-0.1,0.3,0.1,,slow\n,1,1,1,0,\n",
    );
    let table = OperatingPoints::read(&path).expect("accepted");
    assert_eq!(table.name, "floor");
    assert_eq!(
        table.points[0],
        OperatingPoint {
            v_left: -0.1,
            v_right: 0.3,
            v_forward: Some(0.1),
            v_lateral: None,
            yaw_rate: Some(0.5)
        }
    );
    assert_eq!((table.points[1].yaw_rate, table.points[1].v_lateral), (None, Some(0.0)));
}

#[test]
fn operating_points_that_do_not_fit_are_pointed_at() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let refusal = |rows: &str| {
        let text = format!("v_left,v_right,v_forward,v_lateral,yaw_rate\n{rows}");
        let path = file(&folder, "floor.csv", &text);
        OperatingPoints::read(&path).expect_err("refused").to_string()
    };
    let text = refusal("0,,0,0,0\n");
    assert!(text.ends_with("floor.csv:2:2: v_right = \"\": expected a finite number"), "{text}");
    let text = refusal("0,0,0,0,0\n0,0,0,inf,0\n");
    assert!(
        text.ends_with("floor.csv:3:4: v_lateral = \"inf\": expected a finite number"),
        "{text}"
    );
    assert!(refusal("").ends_with("no rows below the header"));
    // 32 degrees per second in place of 0.56 rad/s
    let text = refusal("-0.29,0.29,,,32.0\n0.29,-0.29,,,-32.1\n0.3,0.3,,,0.1\n");
    assert!(text.contains("degrees per second; expected rad/s, 0.0175 times these"), "{text}");
}
