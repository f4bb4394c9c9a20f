//! Which vehicle is meant: by a file, by a name, by its gauge alone.

use crate::{Workplace, auriga_alpha, project_text, vehicle};
use trackdyn_estimate::synthetic::random_steps;
use trackdyn_recording::folder;

/// A workplace with a recording of Auriga-alpha's size in the folder `drive`.
fn with_drive() -> Workplace {
    let place = Workplace::new();
    let drive = auriga_alpha((0..2).map(|run| random_steps(30, 2.0, 0.8, run)).collect());
    let recording = drive.recording().expect("long enough");
    folder::write(&recording, &place.path().join("drive")).expect("written");
    place
}

#[test]
fn vehicles_are_known_by_their_names() {
    let place = Workplace::new();
    let run = place.run("map --grid 3 --vehicle husky-a200");
    assert!(run.status == 0 && run.stdout.starts_with("Husky A200,"), "{}", run.stderr);
    let written = String::from_utf8(place.read("out/kinematics.toml")).expect("text");
    assert!(written.contains("vehicle = \"Husky A200\""), "{written}");
    // a folder of this name, such as that of earlier results, is no vehicle file
    std::fs::create_dir(place.path().join("husky-a200")).expect("made");
    let run = place.run("map --grid 3 --vehicle husky-a200");
    assert!(run.stdout.starts_with("Husky A200,"), "{}", run.stderr);
}

#[test]
fn a_file_counts_before_a_name() {
    let place = Workplace::new();
    place.write("husky-a200", &project_text("configs/vehicles/marmotte.toml"));
    let run = place.run("map --grid 3 --vehicle husky-a200");
    assert!(run.status == 0 && run.stdout.starts_with("Marmotte,"), "{}", run.stderr);
}

#[test]
fn what_is_neither_name_nor_file_is_told_the_names() {
    let place = Workplace::new();
    for command in ["map", "simulate", "diagnose drive", "identify drive", "inspect drive"] {
        let run = place.run(&format!("{command} --vehicle husky"));
        assert_eq!(run.status, 1, "{command}: {}", run.stdout);
        let expected = "error: --vehicle husky: expected a file that exists, or one of \
                        auriga-alpha, husky-a200, marmotte, maxxii, warthog";
        assert!(run.stderr.contains(expected), "{command}: {}", run.stderr);
        let run = place.run(&format!("{command} --vehicle husky.toml"));
        assert!(run.stderr.contains("husky.toml: cannot be read"), "{command}: {}", run.stderr);
    }
    assert!(place.files().is_empty());
}

/// Where the gauge alone counts, it may stand alone: the results are those of the vehicle.
#[test]
fn a_gauge_does_in_place_of_a_vehicle() {
    let place = with_drive();
    let numbers = |given: &str, out: &str| -> Vec<String> {
        let fit = place.run(&format!("identify drive {given} --runs 0 --out {out}"));
        assert_eq!(fit.status, 0, "{given}: {}", fit.stderr);
        let kinematics = format!("--kinematics {out}/kinematics.toml --out {out}");
        let replay = place.run(&format!("odometry drive {given} --runs 1 {kinematics}"));
        assert_eq!(replay.status, 0, "{given}: {}", replay.stderr);
        let printed = (fit.stdout + &replay.stdout).replace("vehicle not given", "Auriga-alpha");
        let printed = printed.replace(&format!("take  {out}/"), "take  ");
        // a gauge has no forces
        printed.lines().filter(|line| !line.contains("physics")).map(str::to_owned).collect()
    };
    assert_eq!(numbers("--gauge 0.42", "gauge"), numbers("--vehicle auriga-alpha", "name"));
    let odometry = String::from_utf8(place.read("gauge/odometry.toml")).expect("text");
    let odometry: toml::Table = odometry.parse().expect("TOML");
    assert_eq!(odometry["source"]["gauge_m"].as_float(), Some(0.42));
    assert_eq!(odometry["source"]["vehicle"].as_str(), Some("vehicle not given"));
}

#[test]
fn one_of_vehicle_and_gauge_is_taken() {
    let place = with_drive();
    for command in ["identify", "odometry"] {
        let run = place.run(&format!("{command} drive"));
        assert_eq!(run.status, 1, "{}", run.stdout);
        for part in ["--vehicle <FILE|NAME>", "--gauge <M>"] {
            assert!(run.stderr.contains(part), "{command}: {}", run.stderr);
        }
    }
    for command in ["identify", "odometry", "inspect"] {
        for (given, part) in [
            ("--vehicle auriga-alpha --gauge 0.42", "cannot be used with"),
            (
                "--gauge -0.42",
                "--gauge -0.42: expected the distance between the track centre-lines",
            ),
            ("--gauge 555", "--gauge 555: expected the distance between the track centre-lines"),
        ] {
            let run = place.run(&format!("{command} drive {given}"));
            assert_eq!(run.status, 1, "{command} {given}: {}", run.stdout);
            assert!(run.stderr.contains(part), "{command} {given}: {}", run.stderr);
        }
    }
    assert!(!place.path().join("out").exists());
}

/// What `inspect` prints to go on with names the vehicle as it was given.
#[test]
fn the_commands_to_go_on_with_have_the_option_that_was_given() {
    let place = with_drive();
    let file = vehicle();
    for (given, gauge, diagnosed) in [
        ("--gauge 0.42", "--gauge 0.42", "--vehicle VEHICLE.toml"),
        ("--vehicle auriga-alpha", "--vehicle auriga-alpha", "--vehicle auriga-alpha"),
        (&format!("--vehicle {file}"), &format!("--vehicle {file}"), &format!("--vehicle {file}")),
        ("", "--vehicle VEHICLE.toml", "--vehicle VEHICLE.toml"),
    ] {
        let run = place.run(&format!("inspect drive {given}"));
        assert_eq!(run.status, 0, "{}", run.stderr);
        let (_, next) = run.stdout.split_once("\ngo on with\n").expect("commands");
        let next = next.replace("\\\n", " ").split_whitespace().collect::<Vec<_>>().join(" ");
        for (command, expected) in
            [("identify", gauge), ("odometry", gauge), ("diagnose", diagnosed)]
        {
            let found = next.contains(&format!("trackdyn {command} drive {expected}"));
            assert!(found, "{given}: {command}: {next}");
        }
        let is_open = gauge.contains("VEHICLE.toml");
        assert_eq!(
            next.contains("need its gauge only (--gauge, in m)"),
            is_open || diagnosed != gauge
        );
    }
}
