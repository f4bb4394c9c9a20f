//! A Parquet recording written by pyarrow (`fixtures/make_parquet.py`).

use std::path::{Path, PathBuf};
use trackdyn_recording::folder;

fn fixture() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/recordings/parquet")
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_is_read_like_csv() {
    use trackdyn_recording::{Run, Warning};
    use trackdyn_recording::{recording::Finding, sample::Cells};

    let recording = folder::read(&fixture()).expect("accepted");
    let ids: Vec<i64> = recording.runs().iter().map(Run::id).collect();
    assert_eq!(ids, [0, 4]);
    let tracks = recording.runs()[0].tracks();
    // the null in row 3 is an empty cell
    assert_eq!(tracks.len(), 9);
    assert_eq!((tracks[3].t, tracks[3].v_right), (0.4, 0.25));
    assert!((tracks[3].v_left - 0.2).abs() < 1e-7, "it is a 32-bit number in the file");
    let dropped = recording.warnings().iter().any(|warning| {
        matches!(warning, Warning::Cleaned(cleaning)
            if cleaning.finding == Finding::NotFinite && cleaning.count == 1)
    });
    assert!(dropped);
    let pose = recording.runs()[1].poses()[9];
    assert!((pose.pose.x - 0.27).abs() < 1e-15 && (pose.pose.yaw + 0.09).abs() < 1e-15);
    let extra = &recording.runs()[0].track_series().extra;
    let steps = [0.0, 1.0, 2.0, 4.0, f64::NAN, 6.0, 7.0, 8.0, 9.0];
    assert_eq!(extra[0].cells, Cells::Numbers(steps.to_vec()));
    let Cells::Texts(remarks) = &extra[1].cells else { panic!("texts") };
    assert_eq!(remarks[4], "row 5");

    let again = tempfile::tempdir().expect("a temporary folder");
    folder::write(&recording, again.path()).expect("written");
    let csv = folder::read(again.path()).expect("accepted");
    assert_eq!(csv.fingerprint(), recording.fingerprint());
}

#[cfg(feature = "parquet")]
#[test]
fn a_truncated_file_and_missing_columns_are_refused() {
    let place = tempfile::tempdir().expect("a temporary folder");
    let copy = |name: &str, bytes: &[u8]| {
        std::fs::write(place.path().join(name), bytes).expect("written");
    };
    let fixture = |name: &str| std::fs::read(fixture().join(name)).expect("a fixture");
    copy("recording.toml", &fixture("recording.toml"));
    copy("poses.parquet", &fixture("poses.parquet"));
    let refusal = || folder::read(place.path()).expect_err("refused").to_string();
    copy("tracks.parquet", &fixture("tracks.parquet")[..500]);
    assert!(refusal().contains("tracks.parquet: not a readable Parquet file"));
    copy("tracks.parquet", &fixture("poses.parquet"));
    assert!(refusal().contains("columns run,t,x,y,yaw: expected t,v_left,v_right"));
}

#[cfg(not(feature = "parquet"))]
#[test]
fn a_build_without_the_feature_says_so() {
    let text = folder::read(&fixture()).expect_err("refused").to_string();
    assert!(text.contains("tracks.parquet: a Parquet file: expected a CSV file, or a program"));
    assert!(text.contains("--features parquet"), "{text}");
}
