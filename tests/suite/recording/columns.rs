//! Tables whose columns the user names.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use trackdyn_estimate::synthetic::{Synthetic, random_steps};
use trackdyn_recording::{
    Columns, Doubt, Error, Recording, TableOptions, Warning, columns, folder,
};

const RADIUS: f64 = 0.15;

/// Readings every 0.05 s, poses every 0.1 s: one minute.
fn truth() -> Recording {
    let synthetic =
        Synthetic { schedules: vec![random_steps(30, 2.0, 0.8, 7)], ..Default::default() };
    synthetic.recording().expect("long enough")
}

/// The drive as a row of each reading, with the last pose before it, written by `row` from the
/// time, the speeds of the tracks, and x, y and yaw.
fn table(header: &str, row: impl Fn([f64; 6], bool) -> String) -> (TempDir, PathBuf) {
    let truth = truth();
    let run = &truth.runs()[0];
    let mut text = format!("{header}\n");
    for reading in run.tracks() {
        let last = run.poses().partition_point(|pose| pose.t <= reading.t + 1e-9) - 1;
        let pose = &run.poses()[last];
        let is_new = (pose.t - reading.t).abs() < 1e-9;
        let values =
            [reading.t, reading.v_left, reading.v_right, pose.pose.x, pose.pose.y, pose.pose.yaw];
        let _ = writeln!(text, "{}", row(values, is_new));
    }
    let place = tempfile::tempdir().expect("a temporary folder");
    let path = place.path().join("drive.csv");
    std::fs::write(&path, text).expect("written");
    (place, path)
}

fn read(path: &Path, text: &str, options: &TableOptions) -> Result<Recording, Error> {
    columns::read(path, &text.parse::<Columns>().expect("columns"), options)
}

#[track_caller]
fn assert_is_truth(found: &Recording) {
    assert_is_truth_to(1e-9, found);
}

/// Times, speeds and poses are the true ones to `most`, s, m/s, m and rad.
#[track_caller]
fn assert_is_truth_to(most: f64, found: &Recording) {
    let truth = truth();
    let (found, truth) = (&found.runs()[0], &truth.runs()[0]);
    assert_eq!(
        (found.tracks().len(), found.poses().len()),
        (truth.tracks().len(), truth.poses().len())
    );
    for (found, truth) in found.tracks().iter().zip(truth.tracks()) {
        let off = [found.t - truth.t, found.v_left - truth.v_left, found.v_right - truth.v_right];
        assert!(off.iter().all(|off| off.abs() < most), "{found:?} {truth:?}");
    }
    for (found, truth) in found.poses().iter().zip(truth.poses()) {
        let yaw = trackdyn_core::pose::wrap_angle(found.pose.yaw - truth.pose.yaw);
        let off =
            [found.t - truth.t, found.pose.x - truth.pose.x, found.pose.y - truth.pose.y, yaw];
        assert!(off.iter().all(|off| off.abs() < most), "{found:?} {truth:?}");
    }
}

#[test]
fn names_units_signs_and_empty_cells_are_those_of_the_user() {
    let rpm = 60.0 / (std::f64::consts::TAU * RADIUS);
    let (_place, path) = table("Time,left rpm,right rpm,px,py,heading,note", |row, is_new| {
        let [t, l, r, x, y, yaw] = row;
        let pose = if is_new {
            format!("{},{},{}", 1000.0 * x, 1000.0 * y, yaw.to_degrees())
        } else {
            ",,".to_owned()
        };
        format!("{},{},{},{pose},go", 1000.0 * t, rpm * l, -rpm * r)
    });
    let text = "t=Time:ms,v_l=left rpm:rpm,v_r=-right rpm:rpm,x=px:mm,y=py:mm,yaw=heading:deg";
    let options = TableOptions { wheel_radius: Some(RADIUS), ..TableOptions::default() };
    assert_is_truth(&read(&path, text, &options).expect("readable"));
    let without = read(&path, text, &TableOptions::default()).expect_err("no radius").to_string();
    assert!(without.contains("expected --wheel-radius METRES"), "{without}");
    let text = text.replace("px:mm", "gps_x");
    let missing = read(&path, &text, &options).expect_err("no such column").to_string();
    assert!(
        missing.contains("drive.csv:1: columns Time,left rpm") && missing.contains("gps_x"),
        "{missing}"
    );
}

/// As a spreadsheet of Europe writes it, with a compass and poses that are held between updates.
#[test]
fn semicolons_decimal_commas_compasses_and_held_poses_are_read() {
    let (_place, path) = table("t;l;r;east;north;compass;;", |[t, l, r, x, y, yaw], _| {
        let compass = 90.0 - yaw.to_degrees();
        format!("{t};{l};{r};{x};{y};{compass};;").replace('.', ",")
    });
    let text = "t=t,v_l=l,v_r=r,x=east,y=north,yaw=compass:compass";
    let found = read(&path, text, &TableOptions::default()).expect("readable");
    assert_is_truth(&found);
    let told = found.warnings().iter().map(ToString::to_string).collect::<String>();
    assert!(told.contains("rows: the others repeat the one before"), "{told}");
}

/// As ROS 2 stamps are written: seconds and nanoseconds apart. A degree at the equator is
/// π/180 a of longitude and π/180 a (1 - e²) of latitude.
#[test]
fn nanoseconds_stand_apart_and_positions_may_be_degrees() {
    const METRES_PER_LONGITUDE: f64 = 111_319.490_793;
    const METRES_PER_LATITUDE: f64 = 110_574.275_822;
    let of = |longitude: f64| {
        table("sec,nanosec,l,r,lat,lon,yaw", move |[t, l, r, x, y, yaw], is_new| {
            let pose = if is_new {
                format!(
                    "{},{},{yaw}",
                    y / METRES_PER_LATITUDE,
                    longitude + x / METRES_PER_LONGITUDE
                )
            } else {
                "0,0,".to_owned()
            };
            let nanoseconds = (1e9 * t.fract()).round();
            format!("{},{nanoseconds},{l},{r},{pose}", t.floor())
        })
    };
    let text = "t=sec,t_ns=nanosec,v_l=l,v_r=r,lat=lat,lon=lon,yaw=yaw";
    let read = |longitude: f64| {
        let (_place, path) = of(longitude);
        read(&path, text, &TableOptions::default())
    };
    assert_is_truth_to(1e-7, &read(10.0).expect("readable"));
    // a sign is reversed, and a row of units counts
    let (_place, path) =
        table("sec,nanosec,l,r,lat,lon,yaw\ns,ns,m/s,m/s,deg,deg,rad", |row, _| {
            let [t, l, r, x, y, yaw] = row;
            let [south, east] = [-y / METRES_PER_LATITUDE, 10.0 + x / METRES_PER_LONGITUDE];
            format!("{t},0,{l},{r},{south},{east},{yaw}")
        });
    let text = text.replace("lat=", "lat=-");
    let found = super::columns::read(&path, &text, &TableOptions::default());
    assert_is_truth_to(1e-7, &found.expect("readable"));
    let far = read(181.0).expect_err("no such longitude").to_string();
    assert!(far.contains("expected a longitude between -180 and 180 degrees"), "{far}");
}

#[test]
fn quaternions_stand_for_yaw() {
    let (_place, path) = table("t\tl\tr\tx\ty\tqz\tqw", |[t, l, r, x, y, yaw], is_new| {
        let (sin, cos) = (0.5 * yaw).sin_cos();
        if is_new {
            format!("{t}\t{l}\t{r}\t{x}\t{y}\t{sin}\t{cos}")
        } else {
            format!("{t}\t{l}\t{r}\t\t\t\t")
        }
    });
    let text = "t=t,v_l=l,v_r=r,x=x,y=y,qz=qz,qw=qw";
    assert_is_truth(&read(&path, text, &TableOptions::default()).expect("readable"));
}

/// Beside poses it is read with them, and is kept by a folder; without them it tells the yaw.
#[test]
fn a_gyroscope_may_stand_beside_poses_or_in_their_place() {
    let truth = truth();
    let poses = truth.runs()[0].poses();
    let yaw_rate = |t: f64| {
        let next = poses.partition_point(|pose| pose.t <= t + 1e-9).min(poses.len() - 1);
        let (from, to) = (&poses[next - 1], &poses[next]);
        (to.pose.yaw - from.pose.yaw) / (to.t - from.t)
    };
    let (place, path) = table("t,l,r,x,y,yaw,gyro", |[t, l, r, x, y, yaw], is_new| {
        let pose = if is_new { format!("{x},{y},{yaw}") } else { ",,".to_owned() };
        format!("{t},{l},{r},{pose},{}", -yaw_rate(t).to_degrees())
    });
    let text = "t=t,v_l=l,v_r=r,x=x,y=y,yaw=yaw,gyro_z=-gyro:deg/s";
    let found = read(&path, text, &TableOptions::default()).expect("readable");
    assert_is_truth(&found);
    let copy = place.path().join("copy");
    folder::write(&found, &copy).expect("written");
    for found in [found, folder::read(&copy).expect("a recording")] {
        let imu = found.runs()[0].imu();
        assert_eq!(imu.len(), truth.runs()[0].tracks().len());
        assert!(imu.iter().all(|one| (one.gyro_z - yaw_rate(one.t)).abs() < 1e-9));
        assert!(imu.iter().all(|one| one.acc_x.is_nan() && one.acc_y.is_nan()));
    }
    let text = "t=t,v_l=l,v_r=r,gyro_z=-gyro";
    let degrees = TableOptions { gyro_in_degrees: true, ..TableOptions::default() };
    let found = read(&path, text, &degrees).expect("readable");
    let run = &found.runs()[0];
    let turned = run.poses().last().expect("some").pose.yaw;
    let expected = poses.last().expect("some").pose.yaw - poses[0].pose.yaw;
    assert!(!run.has_positions() && (turned - expected).abs() < 0.05, "{turned} {expected}");
    let told = found.warnings().iter().map(ToString::to_string).collect::<String>();
    assert!(told.contains("the yaw of the gyroscope gyro, without positions"), "{told}");
}

/// A compass without positions, held between its updates, tells the yaw as that of a folder does,
/// and a gyroscope beside it does not replace it.
#[test]
fn yaw_may_stand_alone() {
    let (place, path) = table("t,l,r,head,gyro", |[t, l, r, _, _, yaw], _| {
        format!("{t},{l},{r},{},0", yaw.to_degrees())
    });
    for text in ["t=t,v_l=l,v_r=r,yaw=head:deg", "t=t,v_l=l,v_r=r,yaw=head:deg,gyro_z=gyro"] {
        let found = read(&path, text, &TableOptions::default()).expect("readable");
        let copy = place.path().join("copy");
        folder::write(&found, &copy).expect("written");
        for found in [found, folder::read(&copy).expect("a recording")] {
            let (run, truth) = (&found.runs()[0], truth());
            assert!(!run.has_positions());
            let truth = truth.runs()[0].poses();
            assert_eq!(run.poses().len(), truth.len(), "{text}");
            let off = run.poses().iter().zip(truth).map(|(a, b)| a.pose.yaw - b.pose.yaw);
            assert!(off.map(f64::sin).all(|off| off.abs() < 1e-9), "{text}");
        }
    }
}

#[test]
fn times_in_another_unit_are_doubted_with_the_option_that_helps() {
    let (_place, path) = table("t,l,r,x,y,yaw", |[t, l, r, x, y, yaw], _| {
        format!("{},{l},{r},{x},{y},{yaw}", 1000.0 * t)
    });
    let text = "t=t,v_l=l,v_r=r,x=x,y=y,yaw=yaw";
    let error = read(&path, text, &TableOptions::default()).expect_err("refused");
    let text = error.to_string();
    let is_stamps = matches!(&error, Error::Contradiction { doubt: Doubt::Stamps { .. }, .. });
    assert!(is_stamps && text.contains("milliseconds"), "{text}");
    assert!(text.contains("--columns t=COLUMN:ms"), "{text}");
}

/// Rows after the clock was set back are not sorted among those before it.
#[test]
fn a_clock_that_is_set_back_begins_another_run() {
    let row =
        |[t, left, right, x, y, yaw]: [f64; 6], _| format!("{t},{left},{right},{x},{y},{yaw}");
    let (_place, path) = table("t,l,r,x,y,yaw", row);
    let text = std::fs::read_to_string(&path).expect("text");
    let (_, rows) = text.split_once('\n').expect("a header");
    std::fs::write(&path, format!("{text}{rows}")).expect("written");
    let recording = read(&path, "t=t,v_l=l,v_r=r,x=x,y=y,yaw=yaw", &TableOptions::default());
    let recording = recording.expect("accepted");
    let set_back = Warning::ClockSetBack { run: 0, runs: 2 };
    assert!(recording.warnings().contains(&set_back), "{:?}", recording.warnings());
    let ids: Vec<i64> = recording.runs().iter().map(trackdyn_recording::Run::id).collect();
    assert_eq!(ids, [0, 1]);
    for run in recording.runs() {
        assert_is_truth(&recording.with_runs(vec![run.clone()]));
    }
}
