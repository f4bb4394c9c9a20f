//! `trackdyn init`: a vehicle file that the other commands read.

use crate::Workplace;
use std::process::Stdio;

const TRACKED_OPTIONS: &str = "--gauge 0.42 --track 0.7,0.15 --mass 258";

#[test]
fn what_init_writes_is_read_by_the_other_commands() {
    let place = Workplace::new();
    let wheels = "--gauge 0.555 --wheels 0.1,0.12 --axles 0.256,-0.256 --mass 75 --cog -0.01,0.03 \
                  --friction 0.9,0.7 --wheel-radius 0.165 --name Husky";
    for (file, options) in [("tracked.toml", TRACKED_OPTIONS), ("wheeled.toml", wheels)] {
        let run = place.run(&format!("init {file} {options}"));
        assert_eq!(run.status, 0, "{}", run.stderr);
        assert!(run.stderr.contains(&format!("wrote {file}")), "{}", run.stderr);
        let text = String::from_utf8(place.read(file)).expect("text");
        assert!(text.contains("# right, forward of the centre"), "{text}");
        let map = place.run(&format!("map --vehicle {file} --grid 3 --out {file}.d"));
        assert_eq!(map.status, 0, "{}", map.stderr);
    }
    let text = String::from_utf8(place.read("tracked.toml")).expect("text");
    assert!(text.contains("name = \"tracked\"") && text.contains("a guess"), "{text}");
    let text = String::from_utf8(place.read("wheeled.toml")).expect("text");
    assert!(text.contains("--wheel-radius 0.165") && !text.contains("a guess"), "{text}");
    let simulate = "simulate --vehicle tracked.toml --runs 2 --duration 20 --out drive";
    assert_eq!(place.run(simulate).status, 0);
    for command in ["identify", "odometry", "inspect", "diagnose"] {
        let run = place.run(&format!("{command} drive --vehicle tracked.toml --out {command}"));
        assert_eq!(run.status, 0, "{command}: {}", run.stderr);
    }
}

#[test]
fn a_file_that_is_there_is_replaced_only_by_force() {
    let place = Workplace::new();
    place.write("mine.toml", "measured for hours");
    let run = place.run(&format!("init mine.toml {TRACKED_OPTIONS}"));
    assert!(run.status == 1 && run.stderr.contains("mine.toml: is there already"));
    assert!(run.stderr.contains("--force"), "{}", run.stderr);
    assert_eq!(place.read("mine.toml"), b"measured for hours");
    assert_eq!(place.run(&format!("init mine.toml {TRACKED_OPTIONS} --force")).status, 0);
    assert!(place.read("mine.toml").starts_with(b"# A vehicle"));
}

#[test]
fn mistakes_are_named_and_nothing_is_written() {
    let place = Workplace::new();
    for (options, part) in [
        (
            "--gauge -1 --track 0.7,0.15 --mass 258",
            "'-1' for '--gauge <M>': expected a number above",
        ),
        ("--gauge 0.42 --track 0.7 --mass 258", "'0.7' for '--track <LENGTH,WIDTH>': expected two"),
        ("--gauge 0.42 --track 0.7,0.15 --mass heavy", "'heavy' for '--mass <KG>'"),
        ("--gauge 0.42 --track 0.7,0.5 --mass 258", "track.belt_width_m = 0.5: expected"),
        ("--gauge 0.42 --track 0.7,0.15 --mass 258 --cog 0.3,0", "cog_m = [0.3, 0"),
        ("--gauge 0.42 --wheels 0.3,0.1 --axles 0.1,0 --mass 9", "wheels.axles_m = [0.1, 0.0]"),
        ("--gauge 0.42 --wheels 0.3,0.1 --track 0.7,0.15 --mass 9", "cannot be used with"),
    ] {
        let run = place.run(&format!("init robot.toml {options}"));
        assert_eq!(run.status, 1, "{options}: {}", run.stdout);
        assert!(run.stderr.contains(part), "{options}: {part:?} is not in:\n{}", run.stderr);
        assert!(!place.path().join("robot.toml").exists(), "{options}");
    }
    // without a terminal, nothing can be asked
    let mut init = place.command("init robot.toml --gauge 0.42 --wheels 0.1,0.1");
    let output = init.stdin(Stdio::null()).output().expect("the program starts");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr.contains("expected --axles, --mass, or a terminal"), "{stderr}");
}
