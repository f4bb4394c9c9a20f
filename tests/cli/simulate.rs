//! `trackdyn simulate` and `trackdyn drive`.

use crate::{Workplace, project_text};
use std::path::PathBuf;

const SCHEDULE: &str = "t,v_left,v_right\n0,0.2,0.6\n4,-0.3,0.3\n8,0.5,0.5\n10,0,0\n11,0,0\n";

#[test]
fn a_simulated_recording_is_read_and_identified() {
    let place = Workplace::new();
    let run = place.run("simulate --cog -0.015,0.04 --runs 3 --sensors laboratory --out drive");
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stdout.contains("yaw-inertia"), "Newton's law is on: {}", run.stdout);
    let run = place.run("inspect drive");
    assert_eq!(run.status, 0, "{}", run.stderr);
    // what was not simulated is not replaced
    std::fs::create_dir(place.path().join("log")).expect("a folder");
    place.write("log/recording.toml", "of a robot");
    let run = place.run("simulate --runs 1 --out log");
    assert!(
        run.status == 1 && run.stderr.contains("--out log: holds a recording"),
        "{}",
        run.stderr
    );
    assert_eq!(place.read("log/recording.toml"), b"of a robot");
    let run = place.run("identify drive --vehicle drive/vehicle.toml --out found");
    assert_eq!(run.status, 0, "{}", run.stderr);
    let text = String::from_utf8(place.read("found/kinematics.toml")).expect("text");
    let file: toml::Table = text.parse().expect("TOML");
    let x = |key: &str| file[key].as_float().expect("a number");
    // The centripetal force moves the mean ICRs by millimetres, and y by a centimetre.
    assert!((x("x_icr_left_m") + 0.375).abs() < 0.01, "{text}");
    assert!((x("x_icr_right_m") - 0.457).abs() < 0.01, "{text}");
}

#[test]
fn the_same_seed_gives_the_same_bytes_on_any_number_of_threads() {
    let place = Workplace::new();
    place.write("plan.csv", SCHEDULE);
    let arguments = "simulate --schedule plan.csv --effect slope --effect friction-drift --out rec";
    let contents = |threads: u32| {
        let run = place.run_with_threads(arguments, threads);
        assert_eq!(run.status, 0, "{}", run.stderr);
        place
            .files()
            .into_iter()
            .map(|file| place.read(&file.to_string_lossy()))
            .collect::<Vec<_>>()
    };
    assert_eq!(contents(1), contents(4));
    let run = place.run("simulate --schedule plan.csv --seed 2 --out other");
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert_ne!(place.read("rec/poses.csv"), place.read("other/poses.csv"));
    let text = String::from_utf8(place.read("other/simulation.toml")).expect("text");
    assert!(text.contains("seed = 2"), "{text}");
}

#[test]
fn bad_schedules_and_worlds_are_refused_and_leave_nothing() {
    let place = Workplace::new();
    place.write("text.csv", "t,v_left,v_right\n0,0.5,0.5\n1,fast,0\n");
    place.write("short.csv", "t,v_left,v_right\n0,0.5,0.5\n");
    place.write("path.csv", "x,y\n0,0\n1,nan\n");
    for (arguments, message) in [
        ("simulate --schedule text.csv", "text.csv:3:2: v_left = \"fast\""),
        ("simulate --schedule short.csv", "single row"),
        ("simulate --schedule wild", "manual, validation, designed, square"),
        ("simulate --sensors wild", "perfect, laboratory, field"),
        ("simulate --step 5", "between 0.00001 and 0.1 s"),
        ("simulate --effect tether:pull=3", "tension_n"),
        (
            "simulate --ground independent --mechanism slope:angle_deg=1,angle_deg=2",
            "slope.angle_deg: given twice",
        ),
        ("simulate --time 5", "unexpected argument '--time'"),
        ("drive --heading 90", "unexpected argument '--heading'"),
        ("drive --path path.csv", "path.csv:3:2: y = \"nan\""),
        ("drive --speed 0", "a positive number"),
    ] {
        let run = place.run(arguments);
        assert_eq!(run.status, 1, "{arguments}: {}", run.stdout);
        assert!(run.stderr.contains(message), "{arguments}: {}", run.stderr);
    }
    let inputs = ["path.csv", "short.csv", "text.csv"].map(PathBuf::from);
    assert_eq!(place.files(), inputs, "nothing is written");
}

/// Friction begins to drift as the recording begins, whatever its clock shows; stamps are those of
/// the schedule.
#[test]
fn laws_that_know_the_time_begin_with_the_recording() {
    let place = Workplace::new();
    let last = |start: i32| -> Vec<f64> {
        let row = |(t, speeds): (i32, &str)| format!("{},{speeds}\n", start + t);
        let rows = [(0, "0.2,0.6"), (2, "0.5,0.1"), (4, "0,0"), (5, "0,0")].map(row).concat();
        place.write("schedule.csv", &format!("t,v_left,v_right\n{rows}"));
        let run = place.run(
            "simulate --schedule schedule.csv --effect friction-drift:rate_1_per_s=0.01 --sensors \
             perfect --out drive",
        );
        assert_eq!(run.status, 0, "{}", run.stderr);
        let text = String::from_utf8(place.read("drive/truth.csv")).expect("text");
        let last = text.lines().last().expect("rows");
        last.split(',').take(5).map(|cell| cell.parse().expect("a number")).collect()
    };
    let [early, late] = [last(0), last(1_000_000)];
    assert!((late[1] - early[1] - 1e6).abs() < 1e-6, "{early:?} {late:?}");
    for (early, late) in early.iter().zip(&late).skip(2) {
        assert!((early - late).abs() < 1e-6, "{early} {late}");
    }
}

/// A simulation writes the vehicle that it moved, with what was switched on: not over its owner's
/// file.
#[test]
fn an_owner_s_vehicle_file_is_not_replaced() {
    let place = Workplace::new();
    std::fs::create_dir(place.path().join("robot")).expect("a folder");
    let vehicle = project_text("configs/vehicles/auriga-alpha.toml");
    place.write("robot/vehicle.toml", &vehicle);
    let run = place.run("simulate --vehicle robot/vehicle.toml --runs 1 --duration 5 --out robot");
    assert!(run.status == 1 && run.stderr.contains("holds a vehicle.toml"), "{}", run.stderr);
    assert_eq!(place.read("robot/vehicle.toml"), vehicle.as_bytes());
    assert_eq!(place.files().len(), 1);
}

#[test]
fn a_robot_that_lifts_drives_on_and_one_that_tips_stops_with_the_reason() {
    let place = Workplace::new();
    place.write("jump.csv", "t,v_left,v_right\n0,4,4\n1,0,0\n");
    let run = place.run("simulate --schedule jump.csv --effect load-transfer:cog_height_m=0.3");
    assert_eq!(run.status, 0, "{}", run.stderr);
    let tall = "--effect load-transfer:cog_height_m=0.6 --out tall";
    let run = place.run(&format!("simulate --schedule jump.csv {tall}"));
    assert_eq!(run.status, 1, "{}", run.stdout);
    assert!(run.stderr.contains("tips over"), "{}", run.stderr);
}

#[test]
fn identified_kinematics_track_a_square_better_than_the_ideal_drive() {
    let place = Workplace::new();
    assert_eq!(place.run("map --cog -0.015,0.04").status, 0);
    let run = place.run(
        "drive --cog -0.015,0.04 --estimate odometry --kinematics out/kinematics.toml --out square",
    );
    assert_eq!(run.status, 0, "{}", run.stderr);
    let text = String::from_utf8(place.read("square/drive.toml")).expect("text");
    let file: toml::Table = text.parse().expect("TOML");
    let drives = file["drive"].as_array().expect("drives");
    let largest = |k: usize| drives[k]["cross_track_max_m"].as_float().expect("a number");
    assert!(largest(0) > 1.0 && largest(1) < 0.1, "{text}");
    assert!(!place.read("square/drive.png").is_empty());
}

#[test]
fn the_independent_ground_moves_the_robot_alike() {
    let place = Workplace::new();
    place.write("plan.csv", SCHEDULE);
    for ground in ["own", "independent"] {
        let run = place.run(&format!(
            "simulate --schedule plan.csv --sensors perfect --ground {ground} --out {ground}"
        ));
        assert_eq!(run.status, 0, "{}", run.stderr);
    }
    let end = |folder: &str| {
        let text = String::from_utf8(place.read(&format!("{folder}/truth.csv"))).expect("text");
        let row = text.lines().last().expect("a row").to_owned();
        row.split(',')
            .skip(2)
            .take(3)
            .map(|cell| cell.parse().expect("a number"))
            .collect::<Vec<f64>>()
    };
    for (ours, theirs) in end("own").into_iter().zip(end("independent")) {
        // The shoes of the independent ground leave a third of a millimetre in the ICRs.
        assert!((ours - theirs).abs() < 0.02, "{ours} {theirs}");
    }
    let run = place.run("simulate --schedule plan.csv --mechanism washboard --out washboard");
    assert!(run.status == 1 && run.stderr.contains("--ground independent"), "{}", run.stderr);
    let run = place
        .run("simulate --schedule plan.csv --ground independent --mechanism washboard --out board");
    assert_eq!(run.status, 0, "{}", run.stderr);
    // a constant of its law is a parameter of the catalogue's
    let on = |effect: &str| {
        place.run(&format!(
            "simulate --schedule plan.csv --ground independent --effect {effect} --out law"
        ))
    };
    for effect in ["friction-creep", "shear-displacement"] {
        let run = on(effect);
        assert_eq!(run.status, 0, "{effect}: {}", run.stderr);
    }
    let run = on("friction-creep:sharpness=0.31");
    assert!(run.status == 1 && run.stderr.contains("sharpness = 0.31"), "{}", run.stderr);
}
