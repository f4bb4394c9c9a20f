//! The project's own format: what is accepted, what is cleaned, and what errors say.

use std::path::Path;
use tempfile::TempDir;
use trackdyn_recording::{Error, Recording, Warning, folder};
use trackdyn_recording::{
    recording::Finding,
    sample::{Cells, Stream},
};

const MANIFEST: &str =
    "schema = \"trackdyn.recording/1\"\nname = \"n\"\nrobot = \"r\"\nframe = \"ros\"\n";
const TRACKS: &str = "t,v_left,v_right\n0,0.1,0.2\n0.1,0.1,0.2\n0.2,0.1,0.2\n";
const POSES: &str = "t,x,y,yaw\n0,0,0,0\n0.1,0.1,0,0\n0.2,0.2,0,0\n";

/// A folder with these files; an empty text leaves a file out.
fn folder_of(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in files {
        if !text.is_empty() {
            std::fs::write(folder.path().join(name), text).expect("written");
        }
    }
    folder
}

fn read(manifest: &str, tracks: &str, poses: &str) -> Result<Recording, Error> {
    let files = [("recording.toml", manifest), ("tracks.csv", tracks), ("poses.csv", poses)];
    folder::read(folder_of(&files).path())
}

fn refusal(manifest: &str, tracks: &str, poses: &str) -> String {
    read(manifest, tracks, poses).expect_err("refused").to_string()
}

fn findings(recording: &Recording) -> Vec<(Stream, Finding, usize)> {
    let of = |warning: &Warning| match warning {
        Warning::Cleaned(cleaning) => Some((cleaning.stream, cleaning.finding, cleaning.count)),
        _ => None,
    };
    recording.warnings().iter().filter_map(of).collect()
}

/// Where there are no poses, the gyroscope tells the yaw, as that of a bag does.
#[test]
fn a_folder_with_a_gyroscope_alone_has_a_yaw() {
    let row = |k: u32| {
        let t = 0.1 * f64::from(k);
        (format!("{t},0.1,{}\n", 0.1 + 0.02 * t), format!("{t},{},0,0\n", 0.04 * t))
    };
    let (tracks, imu): (Vec<String>, Vec<String>) = (0..100).map(row).unzip();
    let (tracks, imu) = (tracks.concat(), imu.concat());
    let files = [
        ("recording.toml", MANIFEST),
        ("tracks.csv", &format!("t,v_left,v_right\n{tracks}")),
        ("imu.csv", &format!("t,gyro_z,acc_x,acc_y\n{imu}")),
    ];
    let recording = folder::read(folder_of(&files).path()).expect("accepted");
    assert!(!recording.has_positions());
    let last = recording.runs()[0].poses()[99];
    // ψ = 0.02 t²
    assert!((last.pose.yaw - 0.02 * last.t * last.t).abs() < 1e-9, "{last:?}");
    let chosen = |warning: &Warning| warning.to_string().contains("yaw of the gyroscope");
    assert!(recording.warnings().iter().any(chosen), "{:?}", recording.warnings());
    // neither poses nor a gyroscope
    assert!(refusal(MANIFEST, TRACKS, "").contains("poses.csv"));
}

#[test]
fn a_plain_recording_is_read_without_a_word() {
    let recording = read(MANIFEST, TRACKS, POSES).expect("accepted");
    assert_eq!((recording.name(), recording.robot()), ("n", "r"));
    assert_eq!(recording.runs().len(), 1);
    assert_eq!(recording.runs()[0].tracks()[1].v_right, 0.2);
    assert_eq!(recording.runs()[0].poses()[2].pose.x, 0.2);
    assert!(recording.warnings().is_empty());
}

#[test]
fn dirty_rows_are_cleaned_and_counted() {
    let tracks = "t,v_left,v_right\n0,1,1\n0.2,3,3\n0.1,2,2\n0.1,9,9\n0.3,nan,4\n0.4,,5\n\
                  0.5,inf,5\n0.6,6,6\n0.7,7,7\n5,8,8\n5.1,8,8\n5.2,8,8\n";
    let poses = "t,x,y,yaw\n0,0,0,3\n0.1,0.1,0,-3\n0.2,0.2,0,-2.9\n";
    let recording = read(MANIFEST, tracks, poses).expect("accepted");
    let left: Vec<f64> = recording.runs()[0].tracks().iter().map(|sample| sample.v_left).collect();
    assert_eq!(left, [1.0, 2.0, 3.0, 6.0, 7.0, 8.0, 8.0, 8.0]);
    let longest = 5.0 - 0.7;
    assert_eq!(
        findings(&recording),
        [
            (Stream::Tracks, Finding::NotFinite, 3),
            (Stream::Tracks, Finding::Unsorted, 1),
            (Stream::Tracks, Finding::Repeated, 1),
            (Stream::Tracks, Finding::Gap { longest }, 1),
            (Stream::Poses, Finding::YawUnwrapped, 1),
        ]
    );
    let yaw: Vec<f64> = recording.runs()[0].poses().iter().map(|sample| sample.pose.yaw).collect();
    assert!(yaw.windows(2).all(|pair| (pair[1] - pair[0]).abs() < 0.3), "{yaw:?}");
}

#[test]
fn runs_come_in_the_order_of_their_numbers_and_incomplete_ones_are_left_out() {
    let tracks = "run,t,v_left,v_right\n7,0,7,7\n-1,0,1,1\n7,1,7,7\n3,0,3,3\n";
    let poses = "run,t,x,y,yaw\n7,0,0,0,0\n7,1,0,0,0\n-1,0,0,0,0\n-1,1,0,0,0\n3,0,0,0,0\n";
    let recording = read(MANIFEST, tracks, poses).expect("accepted");
    let ids: Vec<i64> = recording.runs().iter().map(trackdyn_recording::Run::id).collect();
    assert_eq!(ids, [-1, 7]);
    assert_eq!(recording.runs()[1].tracks().len(), 2);
    assert!(recording.warnings().contains(&Warning::RunLeftOut { run: 3, readings: 1, poses: 1 }));
}

#[test]
fn cells_rows_and_headers_are_pointed_at() {
    let tracks = "t,v_left,v_right\n0,0.1,0.2\n0.1,fast,0.2\n";
    let text = refusal(MANIFEST, tracks, POSES);
    assert!(text.ends_with("tracks.csv:3:2: v_left = \"fast\": expected a number"), "{text}");

    let text = refusal(MANIFEST, TRACKS, "t,x,y,yaw\n0,0,0,0\n0.1,0.1,0\n");
    assert!(text.ends_with("poses.csv:3: 3 cells: expected 4"), "{text}");

    let text = refusal(MANIFEST, TRACKS, "t,x,y,theta\n0,0,0,0\n");
    let expected = "poses.csv:1: columns t,x,y,theta: expected t,x,y,yaw, each name once";
    assert!(text.ends_with(expected), "{text}");

    let text = refusal(MANIFEST, "t,v_left,v_right,t\n", POSES);
    assert!(text.contains("tracks.csv:1: columns t,v_left,v_right,t"), "{text}");

    let text = refusal(MANIFEST, "run,t,v_left,v_right\n1.5,0,0,0\n", POSES);
    assert!(text.ends_with("tracks.csv:2:1: run = \"1.5\": expected an integer"), "{text}");

    let text = refusal(MANIFEST, TRACKS, "run,t,x,y,yaw\n0,0,0,0,0\n");
    assert!(text.contains("poses.csv:1: columns with run"), "{text}");
}

#[test]
fn empty_and_missing_files_are_named() {
    let text = refusal(MANIFEST, " ", POSES);
    assert!(text.contains("tracks.csv:1: columns (none): expected t,v_left,v_right"), "{text}");
    let text = refusal(MANIFEST, "t,v_left,v_right\n", POSES);
    assert!(text.ends_with("tracks.csv: no rows below the header"), "{text}");
    let text = refusal(MANIFEST, TRACKS, "");
    assert!(text.contains("poses.csv: cannot be read"), "{text}");
    let text = refusal("", TRACKS, POSES);
    assert!(text.contains("no recording.toml: expected recording.toml (schema, name"), "{text}");
    let text = refusal(MANIFEST, TRACKS, "t,x,y,yaw\nnan,0,0,0\n1,0,0,0\n");
    let why = "no run with track speeds and at least two poses; poses: 1 rows with an empty cell";
    assert!(text.contains(why), "{text}");
}

#[test]
fn the_line_of_a_mistake_is_right_whatever_ends_the_lines() {
    for end in ["\n", "\r\n"] {
        let cell = ["t,v_left,v_right", "0,0,0", "1,0,0", "2,x,0", "3,0,0", ""].join(end);
        let text = refusal(MANIFEST, &cell, POSES);
        assert!(text.contains("tracks.csv:4:2: v_left = \"x\""), "{end:?}: {text}");
        let row = ["t,v_left,v_right", "0,0,0", "1,0", "2,0,0", ""].join(end);
        let text = refusal(MANIFEST, &row, POSES);
        assert!(text.contains("tracks.csv:3"), "{end:?}: {text}");
    }
}

#[test]
fn the_manifest_is_checked_key_by_key() {
    let text = refusal(&MANIFEST.replace("ros", "paper"), TRACKS, POSES);
    assert!(text.contains("recording.toml:4: frame = \"paper\": expected \"ros\""), "{text}");
    let text = refusal(&MANIFEST.replace("/1", "/2"), TRACKS, POSES);
    assert!(text.contains("recording.toml:1: schema = \"trackdyn.recording/2\""), "{text}");
    let text = refusal(&format!("{MANIFEST}speed = 3\n"), TRACKS, POSES);
    assert!(text.contains("recording.toml:5:1: unknown field `speed`"), "{text}");
    let noise = format!("{MANIFEST}[noise]\npose_xy_m = -0.01\npose_yaw_rad = 0.002\n");
    let text = refusal(&noise, TRACKS, POSES);
    assert!(text.contains("expected standard deviations above 0"), "{text}");
    let noise = noise.replace('-', "");
    let stated = read(&noise, TRACKS, POSES).expect("accepted").stated_noise().expect("stated");
    assert_eq!((stated.position, stated.yaw), (0.01, 0.002));
}

#[test]
fn a_byte_order_mark_blanks_and_windows_line_ends_do_no_harm() {
    let tracks = format!("\u{feff}{}", TRACKS.replace('\n', "\r\n").replace(',', " , "));
    let recording = read(MANIFEST, &tracks, POSES).expect("accepted");
    assert_eq!(recording.runs()[0].tracks()[1].v_right, 0.2);
}

#[test]
fn folder_to_memory_to_folder_changes_no_bit() {
    let tracks = "run,t,v_left,v_right,step,remark\n\
                  2,0.1,0.30000000000000004,-1e-7,1,\"a, \"\"b\"\"\"\n\
                  2,0.2,1.7976931348623157e300,5e-324,,c\n\
                  5,1700000000.123456,0.1,0.2,3,\n5,1700000000.223456,0.1,0.2,4.5,007\n";
    let poses = "run,t,x,y,yaw\n2,0.1,1,2,3\n2,0.2,1,2,-3.1\n5,1,0,0,0\n5,2,0,0,0\n";
    let noise = format!("{MANIFEST}[noise]\npose_xy_m = 0.01\npose_yaw_rad = 0.002\n");
    let imu = "run,t,gyro_z,acc_x,acc_y\n2,0.1,1,2,3\n";
    let first = folder_of(&[
        ("recording.toml", noise.as_str()),
        ("tracks.csv", tracks),
        ("poses.csv", poses),
        ("imu.csv", imu),
    ]);
    let recording = folder::read(first.path()).expect("accepted");
    let extra = &recording.runs()[0].track_series().extra;
    assert_eq!(extra[0].cells, Cells::Numbers(vec![1.0, f64::NAN]));
    assert_eq!(extra[1].cells, Cells::Texts(vec!["a, \"b\"".into(), "c".into()]));

    let second = tempfile::tempdir().expect("a temporary folder");
    folder::write(&recording, second.path()).expect("written");
    assert_same(&recording, second.path());
    // a recording without imu must not find the old one
    let bare = Recording::new(
        "n",
        "r",
        read(MANIFEST, TRACKS, POSES)
            .expect("accepted")
            .runs()
            .iter()
            .cloned()
            .map(trackdyn_recording::Run::into_rows)
            .collect(),
        trackdyn_recording::Source::computed(),
        Vec::new(),
    )
    .expect("accepted");
    folder::write(&bare, second.path()).expect("written");
    assert_same(&bare, second.path());
    let header = std::fs::read_to_string(second.path().join("tracks.csv")).expect("readable");
    assert!(header.starts_with("t,v_left,v_right\n"), "one run 0 needs no column");
}

fn assert_same(recording: &Recording, folder: &Path) {
    let again = folder::read(folder).expect("accepted");
    assert_eq!(again.runs(), recording.runs());
    assert_eq!(again.fingerprint(), recording.fingerprint());
    assert_eq!((again.name(), again.robot()), (recording.name(), recording.robot()));
    assert_eq!(again.stated_noise(), recording.stated_noise());
}

#[test]
fn formats_are_told_by_what_is_there() {
    let empty = tempfile::tempdir().expect("a temporary folder");
    let options = trackdyn_recording::rosbag::RosbagOptions::default();
    let read =
        |path: &Path| trackdyn_recording::read(path, &options).expect_err("refused").to_string();
    assert!(read(empty.path()).contains("neither recording.toml nor .mcap, .db3 or .bag files"));
    let table = empty.path().join("operating_points.csv");
    std::fs::write(&table, "v_left\n").expect("written");
    assert!(
        read(&table).contains("expected a recording folder, a .mcap, .db3 or .bag file, or a .tum")
    );
    assert!(read(&empty.path().join("nowhere")).contains("nowhere: cannot be read"));
}

/// Numbers of runs that are there stay: what follows a step back has one after all of them.
#[test]
fn a_clock_that_is_set_back_begins_a_run_with_a_new_number() {
    let rows = |run: i64, count: u32, rest: &str| -> String {
        let row = |k: u32| format!("{run},{},{rest}\n", 0.1 * f64::from(k));
        (0..count).map(row).collect()
    };
    let both = |rest: &str| [rows(3, 50, rest), rows(3, 30, rest), rows(7, 20, rest)].concat();
    let tracks = format!("run,t,v_left,v_right\n{}", both("0.1,0.2"));
    let poses = format!("run,t,x,y,yaw\n{}", both("0,0,0"));
    let recording = read(MANIFEST, &tracks, &poses).expect("accepted");
    let runs = recording.runs().iter().map(|run| (run.id(), run.tracks().len()));
    assert_eq!(runs.collect::<Vec<_>>(), [(3, 50), (7, 20), (8, 30)]);
    assert!(recording.warnings().contains(&Warning::ClockSetBack { run: 3, runs: 2 }));
}
