//! `trackdyn inspect`: judgement, picture, and commands that do.

use crate::{Workplace, auriga_alpha, vehicle};
use std::fmt::Write;
use trackdyn_estimate::synthetic::{Stretch, random_steps};
use trackdyn_recording::{Recording, Source, UncheckedRun, folder};

const WIDTH: usize = 120;

/// A recording of Auriga-alpha's size.
fn recording(schedules: Vec<Vec<Stretch>>) -> Recording {
    auriga_alpha(schedules).recording().expect("long enough")
}

/// The recording with its rows changed, as a folder.
fn write(place: &Workplace, name: &str, of: &Recording, change: impl Fn(&mut UncheckedRun)) {
    let runs = of.runs().iter().cloned().map(|run| {
        let mut rows = run.into_rows();
        change(&mut rows);
        rows
    });
    let changed = Recording::new(name, "robot", runs.collect(), Source::computed(), Vec::new());
    folder::write(&changed.expect("usable"), &place.path().join(name)).expect("written");
}

/// The commands that are printed to go on with.
fn commands(text: &str) -> Vec<String> {
    let (_, commands) = text.split_once("\ngo on with\n").unwrap_or_default();
    let joined = commands.replace("\\\n", " ");
    let lines = joined.lines().filter_map(|line| line.trim().strip_prefix("trackdyn "));
    lines.map(str::to_owned).collect()
}

#[test]
fn a_good_recording_is_ready_and_the_commands_do() {
    let place = Workplace::new();
    let schedules = (0..2).map(|seed| random_steps(30, 2.0, 0.8, seed)).collect();
    write(&place, "my drive", &recording(schedules), |_| ());
    std::fs::rename(place.path().join("my drive"), place.path().join("drive")).expect("renamed");
    let vehicle = vehicle();
    let run = place.run(&format!("inspect drive --vehicle {vehicle} --out found"));
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stderr.contains("inspect.png"), "{}", run.stderr);
    assert!(place.read("found/inspect.png").starts_with(b"\x89PNG"));
    let text = &run.stdout;
    assert!(text.lines().all(|line| line.chars().count() < WIDTH), "{text}");
    for part in ["2 runs, 120 s", "identify  yes", "odometry  yes", "x_r - x_l = 0.8"] {
        assert!(text.contains(part), "{part} is not in:\n{text}");
    }
    assert!(!text.contains("what looks wrong"), "{text}");
    let commands = commands(text);
    assert_eq!(commands.len(), 3, "{text}");
    for command in &commands[..2] {
        let run = place.run(command);
        assert_eq!(run.status, 0, "{command}: {}", run.stderr);
    }
    assert!(place.path().join("found/kinematics.toml").exists());
    // what odometry replays was not fitted
    assert!(commands[0].contains("--runs 0 ") && commands[1].contains("--runs 1 "), "{text}");
    let again = "inspect drive --kinematics found/kinematics.toml --out again";
    assert_eq!(place.run(again).status, 0);
    assert_ne!(place.read("again/inspect.png"), place.read("found/inspect.png"));
}

/// Paths that a shell would part or take for options are quoted.
#[cfg(unix)]
#[test]
fn commands_are_quoted_for_the_shell() {
    let place = Workplace::new();
    write(&place, "drive", &recording(vec![random_steps(30, 2.0, 0.8, 1)]), |_| ());
    let name = "it's a $(drive)";
    std::fs::rename(place.path().join("drive"), place.path().join(name)).expect("renamed");
    let mut inspect = place.command("inspect");
    let printed = inspect.arg(name).output().expect("the program starts").stdout;
    let printed = String::from_utf8(printed).expect("text");
    let command = commands(&printed).into_iter().next().expect("a command");
    let command = command.replace("VEHICLE.toml", &vehicle());
    let program = env!("CARGO_BIN_EXE_trackdyn");
    let shell = std::process::Command::new("sh")
        .args(["-c", &format!("'{program}' {command}")])
        .current_dir(place.path())
        .output()
        .expect("a shell");
    assert!(shell.status.success(), "{command}: {}", String::from_utf8_lossy(&shell.stderr));
}

#[test]
fn what_is_missing_is_told_with_what_to_drive() {
    let place = Workplace::new();
    // one curve, over and over
    let curve = |k: u32| Stretch {
        duration: 2.0,
        speeds: trackdyn_core::PerSide::new(0.3, 0.4 + 0.01 * f64::from(k % 7)),
    };
    write(&place, "curve", &recording(vec![(0..20).map(curve).collect()]), |_| ());
    let run = place.run("inspect curve");
    assert_eq!(run.status, 0, "{}", run.stderr);
    let text = &run.stdout;
    for part in [
        "turning on the spot both ways: 0.0 turns left and 0.0 right: turn on the spot",
        "straight driving: 0.0 m",
        "time: 40 s",
        "in part: the ICRs without factors",
    ] {
        assert!(text.split_whitespace().collect::<Vec<_>>().join(" ").contains(part), "{text}");
    }
    // no turn, which diagnose asks for as identify does
    let straight = |k: u32| Stretch {
        duration: 4.0,
        speeds: trackdyn_core::PerSide::new(0.3, 0.3).map(|speed| speed + 0.02 * f64::from(k % 5)),
    };
    write(&place, "straight", &recording(vec![(0..15).map(straight).collect()]), |_| ());
    let run = place.run("inspect straight");
    assert!(run.stdout.contains("  diagnose  no: the robot hardly turns"), "{}", run.stdout);
    // yaw alone
    write(&place, "yaw", &recording(vec![random_steps(30, 2.0, 0.8, 1)]), |rows| {
        for sample in &mut rows.poses.samples {
            (sample.pose.x, sample.pose.y) = (0.0, 0.0);
        }
    });
    let run = place.run("inspect yaw");
    assert_eq!(run.status, 0, "{}", run.stderr);
    for part in ["in part: the distance of the ICRs alone", "odometry  no:", "diagnose  no:"] {
        assert!(run.stdout.contains(part), "{part} is not in:\n{}", run.stdout);
    }
    assert_eq!(commands(&run.stdout).len(), 1, "{}", run.stdout);
}

#[test]
fn what_looks_wrong_is_told() {
    let place = Workplace::new();
    let drive = recording(vec![random_steps(40, 2.0, 0.8, 1)]);
    // an encoder that restarts, and a pose sensor that is silent for a while
    write(&place, "faults", &drive, |_| ());
    let tracks = String::from_utf8(place.read("faults/tracks.csv")).expect("text");
    let mut changed = String::new();
    for (row, line) in tracks.lines().enumerate() {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        if row == 500 {
            let at =
                tracks.lines().next().expect("a header").split(',').position(|c| c == "v_left");
            cells[at.expect("a column")] = "40.0".to_owned();
        }
        let _ = writeln!(changed, "{}", cells.join(","));
    }
    place.write("faults/tracks.csv", &changed);
    let poses = String::from_utf8(place.read("faults/poses.csv")).expect("text");
    let kept = poses.lines().enumerate().filter(|(row, _)| !(100..160).contains(row));
    let kept: Vec<&str> = kept.map(|(_, line)| line).collect();
    place.write("faults/poses.csv", &(kept.join("\n") + "\n"));
    let run = place.run("inspect faults");
    assert_eq!(run.status, 0, "{}", run.stderr);
    let (_, wrong) = run.stdout.split_once("what looks wrong").expect("something");
    assert!(wrong.contains("jump away from their neighbours"), "{}", run.stdout);
    assert!(wrong.contains("1 gaps, the longest 6"), "{}", run.stdout);
    // a gauge that contradicts the ICRs
    place.write(
        "wide.toml",
        &std::fs::read_to_string(vehicle())
            .expect("a vehicle")
            .replace("gauge_m = 0.42", "gauge_m = 1.3"),
    );
    let run = place.run("inspect faults --vehicle wide.toml");
    assert!(run.stdout.contains("friction cannot put them"), "{}", run.stdout);
    assert!(!run.stdout.contains("trackdyn identify"), "{}", run.stdout);
}

/// One column for both sides.
#[test]
fn tracks_that_do_not_turn_as_the_poses_do_are_told() {
    let place = Workplace::new();
    let drive = recording(vec![random_steps(40, 2.0, 0.8, 1)]);
    write(&place, "drive", &drive, |rows| {
        for sample in &mut rows.tracks.samples {
            sample.v_left = f64::midpoint(sample.v_left, sample.v_right);
            sample.v_right = sample.v_left;
        }
    });
    let run = place.run("inspect drive");
    assert_eq!(run.status, 0, "{}", run.stderr);
    let text = run.stdout.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains("and the tracks say hardly any turning"), "{}", run.stdout);
    assert!(!text.contains("turning both ways"), "{}", run.stdout);
    assert!(text.contains("odometry no: the tracks do not turn"), "{}", run.stdout);
}

#[test]
fn nonsense_is_refused_in_a_sentence() {
    let place = Workplace::new();
    place.write("noise.mcap", "no bag at all");
    place.write("noise.db3", "no bag at all");
    place.write("noise.bag", "no bag at all");
    place.write("noise.csv", "a,b\n1,2\n");
    place.write("noise.tum", "hello\n");
    place.write("noise.txt", "");
    place.write("notes.pdf", "%PDF");
    std::fs::create_dir(place.path().join("empty")).expect("a folder");
    for name in [
        "noise.mcap",
        "noise.db3",
        "noise.bag",
        "noise.csv",
        "noise.tum",
        "noise.txt",
        "notes.pdf",
        "empty",
        "nowhere",
    ] {
        let run = place.run(&format!("inspect {name}"));
        assert_eq!(run.status, 1, "{name}: {}", run.stdout);
        assert!(run.stderr.starts_with("error: ") && run.stderr.contains(name), "{}", run.stderr);
        assert!(run.stdout.is_empty(), "{}", run.stdout);
        assert!(!place.path().join("out").exists(), "{name}");
    }
}

/// A picture of another recording would be taken for one of this.
#[test]
fn a_recording_without_a_picture_leaves_none_behind() {
    let place = Workplace::new();
    write(&place, "drive", &recording(vec![random_steps(20, 2.0, 0.8, 1)]), |_| ());
    assert_eq!(place.run("inspect drive").status, 0);
    assert!(place.path().join("out/inspect.png").exists());
    place.write("walk.tum", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n");
    let run = place.run("inspect walk.tum");
    assert!(run.status == 0 && run.stderr.contains("removed"), "{}", run.stderr);
    assert!(!place.path().join("out/inspect.png").exists());
}
