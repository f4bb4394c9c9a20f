//! The formats of recordings, as the commands take them.

use crate::{Workplace, auriga_alpha, project_file, vehicle};
use std::fmt::Write;
use trackdyn_estimate::synthetic::{Synthetic, random_steps};
use trackdyn_recording::folder;

/// A recording folder `rec`, and the same as the trajectory `walk.tum` and the table `tracks.csv`.
fn record(place: &Workplace) {
    let on_time = Synthetic::default().tau;
    let synthetic = Synthetic { tau: on_time, ..auriga_alpha(vec![random_steps(20, 2.0, 0.8, 1)]) };
    let recording = synthetic.recording().expect("long enough");
    let run = &recording.runs()[0];
    let mut walk = String::from("# t x y z qx qy qz qw\n");
    for sample in run.poses() {
        let (t, pose) = (sample.t, sample.pose);
        let (sin, cos) = (0.5 * pose.yaw).sin_cos();
        let _ = writeln!(walk, "{t} {} {} 0.1 0 0 {sin} {cos}", pose.x, pose.y);
    }
    place.write("walk.tum", &walk);
    let mut tracks = String::from("t,v_left,v_right\n");
    for sample in run.tracks() {
        let _ = writeln!(tracks, "{},{},{}", sample.t, sample.v_left, sample.v_right);
    }
    place.write("tracks.csv", &tracks);
    folder::write(&recording, &place.path().join("rec")).expect("written");
}

fn fixture(name: &str) -> String {
    let fixtures = project_file("tests/fixtures/recordings");
    fixtures.join(name).display().to_string()
}

#[test]
fn recordings_are_inspected() {
    let place = Workplace::new();
    record(&place);
    let folder = place.run("inspect rec");
    assert_eq!(folder.status, 0, "{}", folder.stderr);
    assert!(folder.stdout.contains("1 run, 40 s"), "{}", folder.stdout);
    let bag = place.run(&format!("inspect {}", fixture("drive.mcap")));
    assert_eq!(bag.status, 0, "{}", bag.stderr);
    assert!(bag.stdout.contains("sensor_msgs/msg/JointState"), "{}", bag.stdout);
    assert!(bag.stdout.contains("the wheel radius"), "{}", bag.stdout);
    // A map over odometry needs no options.
    let chain = place.run(&format!("inspect {}", fixture("chain.db3")));
    assert_eq!(chain.status, 0, "{}", chain.stderr);
    assert!(!chain.stdout.contains("--parent-frame"), "{}", chain.stdout);
}

#[test]
fn bags_are_read_with_the_options_that_inspection_prints() {
    let place = Workplace::new();
    let bag = fixture("chain.db3");
    let printed = place.run(&format!("inspect {bag}")).stdout;
    let printed = printed.replace("\\\n", " ");
    let (_, printed) = printed.split_once("go on with").expect("commands");
    let line = printed.lines().find(|line| line.contains("trackdyn ")).expect("a command");
    let options = line.split_whitespace().skip(3).collect::<Vec<_>>().join(" ");
    let (options, _) = options.split_once("--vehicle").expect("a vehicle");
    let options = options.replace("METRES", "0.1");
    let command = format!("odometry {bag} {options} --vehicle {} --tau 0", vehicle());
    let run = place.run(&command);
    assert_eq!(run.status, 0, "{command}: {}", run.stderr);
    assert!(run.stderr.contains("base_link in map by map -> odom"), "{}", run.stderr);

    let bag = fixture("turns.mcap");
    let arguments = format!("{bag} --tracks-topic /wrapped --wheel-radius 0.1 --tau 0");
    let arguments = format!("odometry {arguments} --vehicle {} --joint-signal", vehicle());
    let run = place.run(&format!("{arguments} position"));
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stderr.contains("front_left: its position wraps (1 times)"), "{}", run.stderr);
    let run = place.run(&format!("{arguments} velocity"));
    assert!(run.status == 1 && run.stderr.contains("have no such signal"), "{}", run.stderr);
}

#[test]
fn a_trajectory_with_its_track_speeds_is_as_good_as_a_folder() {
    let place = Workplace::new();
    record(&place);
    let alone = place.run("inspect walk.tum");
    assert_eq!(alone.status, 0, "{}", alone.stderr);
    let poses = "poses     401, one every 0.100 s, t = 0.000 to 40.000 s";
    assert!(alone.stdout.contains(poses), "{}", alone.stdout);
    assert!(alone.stdout.contains("--tracks TRACKS.csv"), "{}", alone.stdout);
    let inspected = place.run("inspect walk.tum --tracks tracks.csv");
    assert!(inspected.stdout.contains("1 run, 40 s"), "{}", inspected.stdout);

    let identify = |recording: &str, out: &str| {
        let arguments = format!("identify {recording} --vehicle {} --out {out}", vehicle());
        let run = place.run(&format!("{arguments} --generations 5"));
        assert_eq!(run.status, 0, "{}", run.stderr);
        let text = String::from_utf8(place.read(&format!("{out}/kinematics.toml"))).expect("text");
        text.parse::<toml::Table>().expect("TOML")["x_icr_left_m"].as_float().expect("a number")
    };
    // The half angle of a quaternion and back rounds yaw by 1e-16 rad.
    let (folder, tum) = (identify("rec", "a"), identify("walk.tum --tracks tracks.csv", "b"));
    assert!((folder - tum).abs() < 1e-9, "{folder} {tum}");

    let arguments = format!("odometry walk.tum --tracks tracks.csv --vehicle {}", vehicle());
    let replay = place.run(&format!("{arguments} --kinematics b/kinematics.toml --out c"));
    assert_eq!(replay.status, 0, "{}", replay.stderr);
}

#[test]
fn trajectories_that_do_not_fit_are_pointed_at() {
    let place = Workplace::new();
    record(&place);
    place.write("bad.tum", "0 0 0 0 0 0 0 1\n1 0 0 0 zero 0 0 1\n");
    place.write("short.csv", "t,v_left\n0,1\n");
    place.write("notes.pdf", "");
    let vehicle = vehicle();
    for (arguments, part) in [
        (
            "identify walk.tum",
            "walk.tum: a trajectory has no track speeds: give them with --tracks",
        ),
        ("odometry walk.tum", "--tracks"),
        ("identify bad.tum --tracks tracks.csv", "bad.tum:2:5: qx = \"zero\": expected a number"),
        ("identify walk.tum --tracks short.csv", "short.csv:1: columns t,v_left: expected"),
        ("identify walk.tum --tracks missing.csv", "missing.csv: cannot be read"),
        ("identify rec --tracks tracks.csv", "rec is no .tum or .txt trajectory"),
        ("identify notes.pdf", "notes.pdf: a file of another kind"),
    ] {
        let run = place.run(&format!("{arguments} --vehicle {vehicle}"));
        assert_eq!(run.status, 1, "{arguments}: {}", run.stdout);
        assert!(run.stderr.contains(part), "{arguments}: {part:?} is not in:\n{}", run.stderr);
    }
}

/// Every pair of nine speeds, of a robot with ICRs 0.8 m apart and 50 mm forward.
fn operating_points(rate: impl Fn(f64, f64) -> f64) -> String {
    let speeds = || (-4..=4).map(|k| 0.1 * f64::from(k));
    let mut table = String::from("v_left,v_right,v_forward,v_lateral,yaw_rate\n");
    for (l, r) in speeds().flat_map(|l| speeds().map(move |r| (l, r))) {
        let w = rate(l, r);
        // a wave in place of noise
        let wave = 0.003 * (37.0 * l + 101.0 * r).sin();
        let forward = l + 0.4 * w + wave;
        let lateral = if l == 0.0 { String::new() } else { format!("{}", wave - 0.05 * w) };
        let _ = writeln!(table, "{l},{r},{forward},{lateral},{}", w + 2.0 * wave);
    }
    table
}

#[test]
fn operating_points_give_icrs_with_intervals() {
    let place = Workplace::new();
    place.write("floor.csv", &operating_points(|l, r| (r - l) / 0.8));
    let inspected = place.run("inspect floor.csv");
    assert!(inspected.stdout.contains("81 steady operating points"), "{}", inspected.stdout);
    assert!(inspected.stdout.contains("72 lateral speeds"), "{}", inspected.stdout);
    let run = place.run(&format!("identify floor.csv --vehicle {}", vehicle()));
    assert_eq!(run.status, 0, "{}", run.stderr);
    for part in ["x_r - x_l", "95 % interval", "alpha_r", "largest residuals", "leaving out"] {
        assert!(run.stdout.contains(part), "{part} is not in:\n{}", run.stdout);
    }
    assert!(!run.stdout.contains("driven less"), "{}", run.stdout);
    let text = String::from_utf8(place.read("out/kinematics.toml")).expect("text");
    let file: toml::Table = text.parse().expect("TOML");
    // 3 mm/s and 6 mrad/s at 81 points to 0.4 m/s: a few millimetres
    for (key, truth) in [("x_icr_left_m", -0.4), ("x_icr_right_m", 0.4), ("y_icr_m", 0.05)] {
        let value = file[key].as_float().expect("a number");
        assert!((value - truth).abs() < 5e-3, "{key} = {value}");
    }
    let used = place.run("kinematics --speeds 0.3,0.9 --kinematics out/kinematics_alpha.toml");
    assert_eq!(used.status, 0, "{}", used.stderr);
}

/// A table without lateral speeds tells x_l and x_r, and nothing of y: that is said, and the file
/// holds their distance.
#[test]
fn points_without_lateral_speeds_give_what_they_can() {
    let place = Workplace::new();
    let table = operating_points(|l, r| (r - l) / 0.8);
    let without = table.lines().enumerate().map(|(row, line)| {
        let mut cells: Vec<&str> = line.split(',').collect();
        if row > 0 {
            cells[3] = "";
        }
        cells.join(",") + "\n"
    });
    place.write("floor.csv", &without.collect::<String>());
    let run = place.run(&format!("identify floor.csv --vehicle {}", vehicle()));
    assert_eq!(run.status, 0, "{}", run.stderr);
    for part in ["measure v_lateral", "x_l      ", "x_r - x_l", "chi"] {
        assert!(run.stdout.contains(part), "{part} is not in:\n{}", run.stdout);
    }
    assert!(!run.stdout.contains("NaN"), "{}", run.stdout);
    let text = String::from_utf8(place.read("out/kinematics.toml")).expect("text");
    let file: toml::Table = text.parse().expect("TOML");
    assert_eq!(file["schema"].as_str(), Some("trackdyn.separation/1"));
    let gap = file["icr_separation_m"].as_float().expect("a number");
    assert!((gap - 0.8).abs() < 5e-3, "{gap}");
    // `export ros2` takes it, and what needs all parameters says what is open.
    let run = place.run("export ros2 out/kinematics.toml --wheel-radius 0.1 --out ros");
    assert!(run.status == 0 && run.stderr.contains("the distance of the ICRs alone"));
    for command in [
        "kinematics --speeds 0.3,0.9 --kinematics out/kinematics.toml",
        "export gz out/kinematics.toml --out gz",
        "export urdf-frames out/kinematics.toml --out urdf",
    ] {
        let run = place.run(command);
        assert_eq!(run.status, 1, "{command}");
        assert!(run.stderr.contains("x_l, x_r and y are open"), "{}", run.stderr);
    }
}

#[test]
fn points_that_lag_are_told() {
    let place = Workplace::new();
    // a motor that stalls at full speed against the other track
    let rate = |l: f64, r: f64| (if l < -0.25 && r > 0.35 { 0.1 } else { r } - l) / 0.8;
    place.write("floor.csv", &operating_points(rate));
    for command in ["inspect floor.csv", &format!("identify floor.csv --vehicle {}", vehicle())] {
        let run = place.run(command);
        assert_eq!(run.status, 0, "{}", run.stderr);
        assert!(run.stdout.contains("left -0.400, right 0.400 m/s: "), "{}", run.stdout);
    }
}

#[test]
fn operating_points_that_do_not_do_are_refused() {
    let place = Workplace::new();
    let vehicle = vehicle();
    place.write("floor.csv", &operating_points(|l, r| (r - l) / 0.8));
    place.write("bad.csv", "v_left,v_right,v_forward,v_lateral,yaw_rate\n0,x,0,0,0\n");
    for (arguments, part) in [
        ("identify bad.csv", "bad.csv:2:2: v_right = \"x\": expected a finite number"),
        (
            "identify floor.csv --tau 0.1",
            "--tau: floor.csv holds steady points: expected with recordings of motion only",
        ),
        (
            "identify floor.csv --runs 1 --time 0,1 --settle 1 --fit time-offset",
            "--runs, --time, --settle, --fit: floor.csv holds steady points",
        ),
        ("odometry floor.csv", "floor.csv: holds steady points: expected a recording of motion"),
    ] {
        let run = place.run(&format!("{arguments} --vehicle {vehicle}"));
        assert_eq!(run.status, 1, "{arguments}: {}", run.stdout);
        assert!(run.stderr.contains(part), "{arguments}: {part:?} is not in:\n{}", run.stderr);
    }
    // straight driving shows no ICR
    place.write(
        "straight.csv",
        "v_left,v_right,v_forward,v_lateral,yaw_rate\n0.1,0.1,0.1,0,0\n\
        0.2,0.2,0.2,0,0.001\n0.3,0.3,0.3,0,-0.001\n0.4,0.4,0.39,0,0\n0.5,0.5,0.5,0,0\n\
        0.6,0.6,0.61,0,0\n0.7,0.7,0.7,0,0\n",
    );
    let run = place.run(&format!("identify straight.csv --vehicle {vehicle}"));
    assert_eq!(run.status, 2, "{}{}", run.stdout, run.stderr);
    assert!(!place.path().join("out/kinematics.toml").exists());
}

#[cfg(not(feature = "parquet"))]
#[test]
fn parquet_without_its_feature_says_how_to_build_it() {
    let run = Workplace::new().run(&format!("inspect {}", fixture("parquet")));
    assert_eq!(run.status, 1);
    assert!(run.stderr.contains("cargo build --release --features parquet"), "{}", run.stderr);
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_is_read_with_its_feature() {
    let run = Workplace::new().run(&format!("inspect {}", fixture("parquet")));
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stdout.contains("2 runs") && run.stdout.contains("20 poses"), "{}", run.stdout);
}
