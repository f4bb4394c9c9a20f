//! Where results come from stands in them, and no command replaces those of another.

use crate::{Workplace, auriga_alpha, vehicle};
use trackdyn_estimate::synthetic::random_steps;
use trackdyn_recording::folder;

/// A workplace with a recording of Auriga-alpha's size in the folder `drive`.
fn with_drive() -> Workplace {
    let place = Workplace::new();
    let drive = auriga_alpha((0..2).map(|run| random_steps(20, 2.0, 0.8, run)).collect());
    let recording = drive.recording().expect("long enough");
    folder::write(&recording, &place.path().join("drive")).expect("written");
    place
}

const IDENTIFY: &str = "identify drive --gauge 0.42 --generations 2";

#[test]
fn map_and_identify_do_not_replace_each_others_kinematics() {
    let place = with_drive();
    for (first, second) in [("map --grid 3", IDENTIFY), (IDENTIFY, "map --grid 3")] {
        assert_eq!(place.run(first).status, 0, "{first}");
        let before = place.read("out/kinematics.toml");
        let files = place.files();
        let run = place.run(second);
        assert_eq!(run.status, 1, "{second}: {}", run.stdout);
        let part = format!("--out out: its kinematics.toml is of `trackdyn {first}`");
        assert!(run.stderr.contains(&part), "{second}: {}", run.stderr);
        assert_eq!((place.read("out/kinematics.toml"), place.files()), (before, files), "{second}");
        // one's own is replaced, and another folder is free
        assert_eq!(place.run(first).status, 0, "{first}");
        assert_eq!(place.run(&format!("{second} --out other")).status, 0, "{second}");
        for folder in ["out", "other"] {
            std::fs::remove_dir_all(place.path().join(folder)).expect("removed");
        }
    }
}

/// A file by hand, or a damaged one, is nobody's to replace.
#[test]
fn kinematics_of_unknown_origin_stay() {
    let place = with_drive();
    std::fs::create_dir(place.path().join("out")).expect("made");
    for name in ["kinematics.toml", "kinematics_alpha.toml"] {
        place.write(&format!("out/{name}"), "my notes");
        let run = place.run(IDENTIFY);
        assert_eq!(run.status, 1, "{}", run.stdout);
        let part = format!("its {name} is of another origin");
        assert!(run.stderr.contains(&part), "{}", run.stderr);
        assert_eq!(place.read(&format!("out/{name}")), b"my notes");
        std::fs::remove_file(place.path().join(format!("out/{name}"))).expect("removed");
    }
}

/// The command in a file can be given to a shell again.
#[test]
fn commands_in_files_are_quoted() {
    let place = Workplace::new();
    let mut map = place.command("map --grid 3 --out");
    assert!(map.arg("my map").status().expect("the program starts").success());
    let text = String::from_utf8(place.read("my map/kinematics.toml")).expect("text");
    assert!(text.contains("command = \"trackdyn map --grid 3 --out 'my map'\""), "{text}");
}

#[test]
fn a_default_vehicle_is_not_taken_in_silence() {
    let place = Workplace::new();
    let default = "note: vehicle: auriga-alpha (default; --vehicle FILE|NAME takes another)\n";
    place.write("plan.csv", "t,v_left,v_right\n0,0.2,0.6\n4,0,0\n5,0,0\n");
    place.write("path.csv", "x,y\n0,0\n1,0\n");
    // two cases that name no vehicle
    place.write(
        "reference.toml",
        "schema = \"trackdyn.reference/1\"\ngrid = 5\n\
         [[case]]\nname = \"one\"\n\
         [case.expect]\neccentricity = { value = 0.1, tolerance = 0.1 }\n\
         [[case]]\nname = \"other\"\ncog_m = [0.0, 0.0]\n\
         [case.expect]\neccentricity = { value = 0.0, tolerance = 0.1 }\n",
    );
    for command in [
        "map --grid 3",
        "kinematics --speeds 0.3,0.9",
        "simulate --schedule plan.csv --out drive",
        "drive --path path.csv --quasi-static --out path",
        "check reference.toml",
    ] {
        let run = place.run(command);
        assert_eq!(run.status, 0, "{command}: {}", run.stderr);
        assert_eq!(run.stderr.matches(default).count(), 1, "{command}: {}", run.stderr);
        let chosen = format!("{command} --vehicle {}", vehicle());
        let run = place.run(&chosen);
        assert!(!run.stderr.contains("default"), "{chosen}: {}", run.stderr);
    }
    let run = place.run("kinematics --speeds 0.3,0.9 --kinematics out/kinematics.toml");
    assert!(run.status == 0 && run.stderr.is_empty(), "{}", run.stderr);
}

/// What is printed and written names the vehicle.
#[test]
fn every_output_names_its_vehicle() {
    let place = with_drive();
    let is_named = |command: &str, files: &[&str]| {
        let run = place.run(command);
        assert_eq!(run.status, 0, "{command}: {}", run.stderr);
        assert!(run.stdout.contains("Husky A200"), "{command}: {}", run.stdout);
        for name in files {
            let text = String::from_utf8(place.read(name)).expect("text");
            assert!(text.contains("Husky A200"), "{command}: {name}: {text}");
        }
    };
    let husky = "--vehicle husky-a200";
    is_named(&format!("map {husky} --grid 3 --out map"), &["map/kinematics.toml"]);
    is_named(&format!("kinematics {husky} --speeds 0.3,0.9"), &[]);
    is_named("kinematics --kinematics map/kinematics.toml --speeds 0.3,0.9", &[]);
    let simulate = format!("simulate {husky} --run-count 1 --duration 20 --out simulated");
    is_named(&simulate, &["simulated/simulation.toml", "simulated/recording.toml"]);
    is_named(&format!("drive {husky} --quasi-static --out path"), &["path/drive.toml"]);
    is_named(&format!("inspect simulated {husky}"), &[]);
    let found = ["found/identification.toml", "found/kinematics.toml"];
    // its own drive, whose ICRs are further apart than its gauge
    let drive = "simulated --generations 2 --force --out found";
    let run = place.run(&format!("identify {drive} {husky}"));
    assert!(run.stdout.contains("Husky A200"), "{}", run.stdout);
    for name in found.into_iter().filter(|name| place.path().join(name).exists()) {
        assert!(String::from_utf8(place.read(name)).expect("text").contains("Husky A200"));
    }
    let replay =
        format!("odometry simulated {husky} --kinematics map/kinematics.toml --out replay");
    is_named(&replay, &["replay/odometry.toml"]);
    let export = "export ros2 map/kinematics.toml --wheel-radius 0.1 --out ros";
    assert_eq!(place.run(export).status, 0);
    for name in ["ros/diff_drive_controller.yaml", "ros/icr_frame.launch.py"] {
        let text = String::from_utf8(place.read(name)).expect("text");
        assert!(text.contains("# vehicle: Husky A200"), "{text}");
    }
}
