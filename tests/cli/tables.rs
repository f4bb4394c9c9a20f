//! Tables whose columns and units the user names, and doubts that the user accepts.

use crate::{Workplace, auriga_alpha, vehicle};
use std::fmt::Write;
use trackdyn_estimate::synthetic::random_steps;
use trackdyn_recording::{Recording, Run, Source, folder};

/// The drive as a folder `rec`, with its speeds times a factor, and as the table `log.csv` in
/// km/h, ms and degrees.
fn record(place: &Workplace, factor: f64) {
    let synthetic = auriga_alpha(vec![random_steps(30, 2.0, 0.8, 1)]);
    let recording = synthetic.recording().expect("long enough");
    let run = &recording.runs()[0];
    let mut text = String::from("Time;left;right;px;py;head\n");
    for reading in run.tracks() {
        let _ =
            write!(text, "{};{};{};", 1e3 * reading.t, 3.6 * reading.v_left, 3.6 * reading.v_right);
        let pose = run.poses().iter().find(|pose| (pose.t - reading.t).abs() < 1e-9);
        let _ = match pose {
            Some(sample) => {
                let pose = sample.pose;
                writeln!(text, "{};{};{}", pose.x, pose.y, pose.yaw.to_degrees())
            }
            None => writeln!(text, ";;"),
        };
    }
    place.write("log.csv", &text);
    let mut rows: Vec<_> = recording.runs().iter().cloned().map(Run::into_rows).collect();
    for reading in rows.iter_mut().flat_map(|run| &mut run.tracks.samples) {
        (reading.v_left, reading.v_right) = (factor * reading.v_left, factor * reading.v_right);
    }
    let changed = Recording::new("rec", "robot", rows, Source::computed(), Vec::new());
    folder::write(&changed.expect("usable"), &place.path().join("rec")).expect("written");
}

const COLUMNS: &str = "--columns t=Time:ms,v_l=left:km/h,v_r=right:km/h,x=px,y=py,yaw=head:deg";

/// x_r − x_l that a command leaves in a folder, m.
fn identified(place: &Workplace, arguments: &str, out: &str) -> f64 {
    let vehicle = vehicle();
    let run =
        place.run(&format!("identify {arguments} --vehicle {vehicle} --out {out} --generations 5"));
    assert_eq!(run.status, 0, "{arguments}: {}{}", run.stdout, run.stderr);
    let text = String::from_utf8(place.read(&format!("{out}/kinematics.toml"))).expect("text");
    let file: toml::Table = text.parse().expect("TOML");
    let of = |key: &str| file[key].as_float().expect("a number");
    of("x_icr_right_m") - of("x_icr_left_m")
}

#[test]
fn a_table_with_named_columns_is_as_good_as_a_folder() {
    let place = Workplace::new();
    record(&place, 1.0);
    let folder = identified(&place, "rec", "a");
    let table = identified(&place, &format!("log.csv {COLUMNS}"), "b");
    // sums of decimals
    assert!((folder - table).abs() < 1e-6, "{folder} {table}");
    let inspected = place.run(&format!("inspect log.csv {COLUMNS}"));
    assert_eq!(inspected.status, 0, "{}", inspected.stderr);
    let printed = inspected.stdout.replace("\\\n", " ");
    assert!(printed.contains(COLUMNS), "{printed}");
    let alone = place.run("inspect log.csv");
    assert!(alone.status == 1 && alone.stderr.contains("--columns t=COLUMN"), "{}", alone.stderr);
    for (columns, part) in [
        ("t=Time", "v_l is missing: expected v_l=COLUMN"),
        ("a=b", "expected KEY=COLUMN"),
        ("t=T,v_l=left,v_r=right,x=px,y=py,yaw=head", "log.csv:1: columns Time,left"),
    ] {
        let run = place.run(&format!("inspect log.csv --columns {columns}"));
        assert!(run.status != 0 && run.stderr.contains(part), "{columns}: {}", run.stderr);
    }
    let bag = place.run(&format!("inspect log.csv {COLUMNS} --pose-topic /slam"));
    assert!(bag.status == 1 && bag.stderr.contains("--pose-topic"), "{}", bag.stderr);
}

#[test]
fn a_doubt_stops_a_command_unless_it_is_accepted_or_mended() {
    let place = Workplace::new();
    record(&place, 3.6);
    let vehicle = vehicle();
    let run = place.run(&format!("identify rec --vehicle {vehicle}"));
    assert_eq!(run.status, 1, "{}", run.stdout);
    for part in ["km/h in place of m/s", "--speed-unit km/h", "--accept travel"] {
        assert!(run.stderr.contains(part), "{part} is not in:\n{}", run.stderr);
    }
    let gap = identified(&place, "rec --speed-unit km/h", "a");
    assert!((gap - 0.832).abs() < 0.02, "{gap}");
    // The fit contradicts itself, and nothing is written.
    let run =
        place.run(&format!("identify rec --accept travel --vehicle {vehicle} --generations 5"));
    assert!(run.stderr.contains("read all the same (--accept travel)"), "{}", run.stderr);
    assert!(run.stdout.contains("--speed-unit km/h"), "{}", run.stdout);
    assert_eq!(run.status, 2, "{}", run.stdout);
    let run = place.run(&format!("identify rec --accept nonsense --vehicle {vehicle}"));
    assert!(run.status != 0 && run.stderr.contains("expected one of travel"), "{}", run.stderr);
    let run = place.run(&format!("identify rec --wheel-radius 0.1 --vehicle {vehicle}"));
    assert!(run.status == 1 && run.stderr.contains("--speed-unit rad/s"), "{}", run.stderr);
}
