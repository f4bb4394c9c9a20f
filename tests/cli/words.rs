//! One vocabulary of options, and lines that a terminal shows whole.

use crate::plan::diagnosis;
use crate::{Workplace, auriga_alpha, project_file, project_text};
use std::collections::{BTreeMap, BTreeSet};
use trackdyn_estimate::synthetic::random_steps;
use trackdyn_recording::folder;

/// Fewer characters than this stand in a line.
const WIDTH: usize = 120;

/// All commands, with those that have commands of their own.
const COMMANDS: [&str; 30] = [
    "map",
    "kinematics",
    "simulate",
    "drive",
    "odometry",
    "check",
    "export",
    "export ros2",
    "export gz",
    "export urdf-frames",
    "export table",
    "export sdf",
    "export mjcf",
    "export usd",
    "export chrono",
    "export mcap",
    "effects",
    "init",
    "inspect",
    "identify",
    "diagnose",
    "compare",
    "plan",
    "trial",
    "trial make",
    "trial run",
    "trial score",
    "trial drive",
    "completions",
    "man",
];

/// Text without lines that a terminal would break.
#[track_caller]
fn assert_narrow(what: &str, text: &str) {
    let wide: Vec<&str> = text.lines().filter(|line| line.chars().count() >= WIDTH).collect();
    assert!(wide.is_empty(), "{what}: {}", wide.join("\n"));
}

/// The options of a help with what they take.
fn options(help: &str) -> Vec<(String, String)> {
    let lines = help.lines().map(str::trim_start).filter(|line| line.starts_with('-'));
    let option = |line: &str| {
        let line = line.split_once("--")?.1;
        let (name, rest) = line.split_once(' ').unwrap_or((line, ""));
        let value = rest.strip_prefix('<').and_then(|rest| rest.split_once('>'));
        Some((name.to_owned(), value.map_or(String::new(), |(value, _)| value.to_owned())))
    };
    lines.filter_map(option).collect()
}

/// A name stands for one thing: it takes the same wherever it is an option.
#[test]
fn an_option_takes_the_same_in_every_command() {
    let place = Workplace::new();
    let mut found: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for command in COMMANDS {
        let run = place.run(&format!("{command} --help"));
        assert_eq!(run.status, 0, "{command}: {}", run.stderr);
        assert_narrow(command, &run.stdout);
        for (name, value) in options(&run.stdout) {
            found.entry(name).or_default().insert(value);
        }
    }
    assert!(found.len() > 50, "{found:?}");
    let several: Vec<_> = found.iter().filter(|(_, values)| values.len() > 1).collect();
    assert!(several.is_empty(), "{several:?}");
    for gone in ["left-wheel", "noise-xy-m", "noise-yaw-rad"] {
        assert!(!found.contains_key(gone), "{gone} has another name now");
    }
}

/// All commands are listed above.
#[test]
fn helps_are_those_of_all_commands() {
    let place = Workplace::new();
    for parent in ["", "export", "trial"] {
        let help = place.run(&format!("{parent} --help")).stdout;
        let (_, listed) = help.split_once("Commands:\n").expect("commands");
        let names = listed.lines().take_while(|line| !line.is_empty());
        let names = names.filter(|line| line.starts_with("  ") && !line.starts_with("   "));
        for name in names.filter_map(|line| line.split_whitespace().next()) {
            let whole = format!("{parent} {name}").trim().to_owned();
            assert!(name == "help" || COMMANDS.contains(&&*whole), "{whole}");
        }
        assert_narrow(parent, &help);
    }
}

/// What scripts type goes on working.
#[test]
fn former_names_of_options_are_understood() {
    let place = Workplace::new();
    place.write("diagnosis.toml", &diagnosis("ambiguous", &["slope", "tether"]));
    place.write("vehicle.corrected.toml", &project_text("configs/vehicles/auriga-alpha.toml"));
    for command in [
        "map --grid 3 --speed 0.5 --time 2 --out map",
        "export ros2 map/kinematics.toml --wheel-radius 0.1 --left-wheel l --right-wheel r",
        "simulate --runs 1 --duration 3 --out drive",
        "plan --diagnosis diagnosis.toml --noise-xy-m 0.002 --noise-yaw-rad 0.002",
    ] {
        let run = place.run(command);
        assert_eq!(run.status, 0, "{command}: {}", run.stderr);
    }
    let run = place.run("simulate --schedule missing.csv --run-count 2");
    assert_eq!(run.status, 1);
    place.write("s.csv", "t,v_left,v_right\n0,0.2,0.6\n4,0,0\n5,0,0\n");
    let run = place.run("simulate --schedule s.csv --run-count 2");
    assert!(run.stderr.contains("error: --run-count: "), "{}", run.stderr);
}

/// Options of one subject stand together in helps.
#[test]
fn helps_have_groups() {
    let place = Workplace::new();
    for (command, groups) in [
        (
            "identify",
            &["Vehicle:", "How the recording is read:", "What of the recording counts:"][..],
        ),
        ("map", &["Vehicle:", "Place and time:"]),
        ("diagnose", &["How the recording is read:", "Bootstrap:"]),
    ] {
        let help = place.run(&format!("{command} --help")).stdout;
        for group in groups {
            assert!(help.contains(&format!("\n{group}\n")), "{command}: {group}: {help}");
        }
        // an option of the command itself is in no group of others
        let (_, own) = help.split_once("\nOptions:\n").expect("options");
        let own: Vec<&str> =
            own.lines().take_while(|line| line.is_empty() || line.starts_with(' ')).collect();
        let own = own.join("\n");
        assert!(own.contains("--out") && own.contains("--help"), "{command}: {own}");
        assert!(!own.contains("--vehicle") || command == "diagnose", "{command}: {own}");
    }
}

/// Results and notes of the usual commands.
#[test]
fn outputs_are_narrow_and_notes_stand_once() {
    let place = Workplace::new();
    let drive = auriga_alpha((0..2).map(|run| random_steps(20, 2.0, 0.8, run)).collect());
    folder::write(&drive.recording().expect("long"), &place.path().join("drive")).expect("written");
    place.write("diagnosis.toml", &diagnosis("ambiguous", &["slope", "tether"]));
    place.write("vehicle.corrected.toml", &project_text("configs/vehicles/auriga-alpha.toml"));
    let bag = project_file("tests/fixtures/recordings/drive.mcap").display().to_string();
    let reference = project_file("configs/references/auriga-alpha.toml").display().to_string();
    let effects = "--effect centripetal --effect motion-resistance --effect time-offset \
                   --effect load-transfer:cog_height_m=0.05 --effect friction-split";
    for (command, status) in [
        (format!("map --grid 5 --out map {effects}"), 0),
        ("kinematics --twist 0.5,0.3".to_owned(), 0),
        (format!("simulate --run-count 2 --duration 20 --out simulated {effects}"), 0),
        ("drive --quasi-static --kinematics map/kinematics.toml".to_owned(), 0),
        ("inspect drive --gauge 0.42".to_owned(), 0),
        (format!("inspect {bag}"), 0),
        (format!("inspect {bag} --wheel-radius 0.1"), 0),
        ("identify drive --gauge 0.42 --generations 2 --fit sensor-yaw,lever-arm".to_owned(), 0),
        ("identify drive --gauge 1.42 --generations 2 --out wide".to_owned(), 2),
        ("odometry drive --gauge 0.42 --kinematics out/kinematics.toml".to_owned(), 0),
        ("odometry drive --gauge 0.42 --kinematics map/kinematics.toml".to_owned(), 0),
        ("diagnose simulated --vehicle simulated/vehicle.toml --draws 1000".to_owned(), 0),
        ("diagnose simulated --vehicle auriga-alpha --draws 1000".to_owned(), 0),
        ("plan --diagnosis diagnosis.toml".to_owned(), 0),
        (format!("check {reference}"), 0),
        ("export gz map/kinematics.toml".to_owned(), 0),
        ("export ros2 out/kinematics_alpha.toml --wheel-radius 0.1".to_owned(), 0),
        ("effects".to_owned(), 0),
        ("effects load-transfer".to_owned(), 0),
        ("effects directional-lugs".to_owned(), 0),
        ("identify missing --gauge 0.42".to_owned(), 1),
        (format!("identify {bag} --gauge 0.42"), 1),
    ] {
        let run = place.run(&command);
        assert_eq!(run.status, status, "{command}: {}{}", run.stdout, run.stderr);
        // paths stay whole, for they are to be copied
        let printed = (run.stdout.clone() + &run.printed).replace(&bag, "bag.mcap");
        assert_narrow(&command, &printed.replace(&reference, "reference.toml"));
        let notes: Vec<&str> =
            run.stderr.lines().filter(|line| line.starts_with("note: ")).collect();
        let once: BTreeSet<&str> = notes.iter().copied().collect();
        assert_eq!(notes.len(), once.len(), "{command}: {}", run.stderr);
    }
}
