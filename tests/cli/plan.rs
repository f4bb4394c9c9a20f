//! From an open question to a schedule that can be driven.

use crate::{Run, Workplace, project_text};

/// A diagnosis that leaves these members open.
pub fn diagnosis(status: &str, members: &[&str]) -> String {
    let head = format!(
        "schema = \"trackdyn.diagnosis/1\"\nstatus = \"{status}\"\n\
         [located]\nexcess_over_noise = 2.0\nbroken = []\nwhere = \"\"\n\
         channels = {{ lateral = 1.0, longitudinal = 0.0, yaw = 0.0 }}\n"
    );
    let missing = members.first().map_or(String::new(), |first| {
        format!(
            "[[missing]]\neffect = \"{first}\"\none_of = {members:?}\nparameters = []\n\
             evidence = {{ p = 0.001, ln_bayes_factor = 20.0, held_out_gain = 20.0 }}\n"
        )
    });
    let fit = "[fit]\nheld_out_before = 2.0\nheld_out_after = 1.0\nnoise_floor = 1.0\n\
               excess_explained = 1.0\n";
    head + &missing + fit
}

fn plan(status: &str, members: &[&str], options: &str) -> (Workplace, Run) {
    let place = Workplace::new();
    place.write("diagnosis.toml", &diagnosis(status, members));
    place.write("vehicle.corrected.toml", &project_text("configs/vehicles/auriga-alpha.toml"));
    let run = place.run(&format!("plan --diagnosis diagnosis.toml --out out {options}"));
    (place, run)
}

/// Only the two files of the diagnosis are there.
fn wrote_nothing(place: &Workplace) -> bool {
    place.files().len() == 2 && !place.path().join("out").exists()
}

#[test]
fn a_plan_is_driven_by_the_simulator_within_its_limits() {
    let options = "--fastest 0.6 --duration 30";
    let (place, run) = plan("ambiguous", &["motion-resistance", "hitch-drag"], options);
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stdout.contains("the plan decides"), "{}", run.stdout);
    let schedule = String::from_utf8(place.read("out/plan.csv")).expect("text");
    let mut last = -1.0;
    for line in schedule.lines().skip(1) {
        let numbers: Vec<f64> = line.split(',').map(|n| n.parse().expect("a number")).collect();
        assert!(numbers[0] > last && numbers[0] <= 30.0, "{line}");
        assert!(numbers[1].abs() <= 0.6 && numbers[2].abs() <= 0.6, "{line}");
        last = numbers[0];
    }
    let file: toml::Table =
        String::from_utf8(place.read("out/plan.toml")).expect("text").parse().expect("TOML");
    assert_eq!(file["schema"].as_str(), Some("trackdyn.plan/1"));
    assert!((file["duration_s"].as_float().expect("a number") - last).abs() < 1e-6);
    assert!(file["source"]["fingerprint"].as_str().is_some_and(|digits| digits.len() == 16));
    let driven = place.run("simulate --schedule out/plan.csv --sensors perfect --out drive");
    assert_eq!(driven.status, 0, "{}", driven.stderr);
    let read = place.read("drive/schedule.csv");
    assert!(read == schedule.as_bytes(), "the simulator read another schedule");
}

/// The noise is that of the diagnosis unless it is given, and is told either way.
#[test]
fn the_noise_of_the_diagnosis_is_planned_with() {
    let place = Workplace::new();
    let noise = "[noise]\npose_forward_m = 0.003\npose_left_m = 0.004\npose_yaw_rad = 0.002\n\
                 walk_forward_m = 0.001\nwalk_left_m = 0.002\nwalk_yaw_rad = 0.0005\n\
                 walk_heading_rad = 0.0\n";
    let text = diagnosis("ambiguous", &["motion-resistance", "hitch-drag"]);
    place.write("vehicle.corrected.toml", &project_text("configs/vehicles/auriga-alpha.toml"));
    let planned = |text: &str, options: &str| {
        place.write("diagnosis.toml", text);
        let command = format!("plan --diagnosis diagnosis.toml --out out --duration 30 {options}");
        let run = place.run(&command);
        assert_eq!(run.status, 0, "{options}: {}", run.stderr);
        let printed = run.stdout.split_whitespace().collect::<Vec<_>>().join(" ");
        let file = String::from_utf8(place.read("out/plan.toml")).expect("text");
        let file: toml::Table = file.parse().expect("TOML");
        let noise = |key: &str| file["noise"][key].as_float().expect("a number");
        let keys = ["pose_forward_m", "pose_left_m", "pose_yaw_rad", "walk_yaw_rad"];
        (printed, keys.map(noise))
    };
    let close = |found: [f64; 4], expected: [f64; 4]| {
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?}");
    };
    let (stdout, found) = planned(&format!("{text}{noise}"), "");
    close(found, [0.003, 0.004, 0.002, 0.0005]);
    let told = "noise each pose 3.0 mm forward, 4.0 mm left, 0.11 deg";
    assert!(stdout.contains(told) && stdout.contains("as the diagnosis measured it"), "{stdout}");
    assert!(stdout.starts_with("vehicle Auriga-alpha "), "{stdout}");
    let (stdout, found) = planned(&format!("{text}{noise}"), "--noise-xy 0.01");
    close(found, [0.01, 0.01, 0.002, 0.0005]);
    assert!(stdout.contains("(as given)"), "{stdout}");
    let (stdout, found) = planned(&text, "");
    close(found, [0.001; 4]);
    assert!(stdout.contains("(assumed"), "{stdout}");
    place.write("diagnosis.toml", &format!("{text}{}", noise.replace("0.003", "-0.003")));
    let run = place.run("plan --diagnosis diagnosis.toml");
    let part = "noise.pose_forward_m = -0.003: expected a standard deviation above 0";
    assert!(run.status == 1 && run.stderr.contains(part), "{}", run.stderr);
}

/// What is printed to go on with can be typed.
#[test]
fn a_plan_says_how_to_go_on() {
    let place = Workplace::new();
    let made_by = "[source]\ncommand = \"trackdyn diagnose old --vehicle auriga-alpha --draws 1000 \
                   --out found\"\n";
    let text = diagnosis("ambiguous", &["motion-resistance", "hitch-drag"]);
    std::fs::create_dir(place.path().join("found")).expect("made");
    place.write("found/diagnosis.toml", &format!("{text}{made_by}"));
    let vehicle = project_text("configs/vehicles/auriga-alpha.toml");
    place.write("found/vehicle.corrected.toml", &vehicle);
    let run = place.run("plan --diagnosis found/diagnosis.toml --duration 30");
    assert_eq!(run.status, 0, "{}", run.stderr);
    let joined = run.stdout.replace("\\\n", " ");
    let commands = joined.lines().filter_map(|line| line.trim().strip_prefix("trackdyn "));
    let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    let commands: Vec<String> = commands.map(words).collect();
    let [rehearse, inspect, both] = commands.as_slice() else { panic!("{}", run.stdout) };
    let driven = place.run(rehearse);
    assert_eq!(driven.status, 0, "{rehearse}: {}", driven.stderr);
    let looked = place.run(&inspect.replace("NEW_LOG", "out/plan/rehearsal"));
    assert_eq!(looked.status, 0, "{inspect}: {}", looked.stderr);
    assert_eq!(*both, "diagnose old NEW_LOG --vehicle auriga-alpha --draws 1000 --out found-both");
}

#[test]
fn a_plan_does_not_hang_on_the_number_of_threads() {
    let (place, _) = plan("ambiguous", &["slope", "tether"], "--duration 20");
    let first = place.read("out/plan.csv");
    let again =
        place.run_with_threads("plan --diagnosis diagnosis.toml --out out --duration 20", 1);
    assert_eq!(again.status, 0, "{}", again.stderr);
    assert!(place.read("out/plan.csv") == first);
}

#[test]
fn what_no_driving_decides_is_said() {
    let (place, run) = plan("ambiguous", &["cog-shift", "friction-split"], "");
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stdout.contains("driving cannot decide"), "{}", run.stdout);
    assert!(run.stdout.contains("instead: weigh each track"), "{}", run.stdout);
    assert!(wrote_nothing(&place));
}

#[test]
fn nothing_open_is_nothing_to_plan() {
    for (status, members) in [("nothing-missing", &[][..]), ("explained", &["slope"])] {
        let (place, run) = plan(status, members, "");
        assert_eq!(run.status, 0, "{}", run.stderr);
        assert!(run.stdout.contains("nothing to plan"), "{}", run.stdout);
        assert!(run.stdout.contains("vehicle not told"), "{}", run.stdout);
        assert!(wrote_nothing(&place));
        let text = diagnosis(status, members) + "[source]\nvehicle = \"crawler\"\n";
        place.write("diagnosis.toml", &text);
        let run = place.run("plan --diagnosis diagnosis.toml --out out");
        assert!(run.stdout.ends_with("several effects; crawler\n"), "{}", run.stdout);
    }
}

#[test]
fn a_size_beyond_its_range_is_shown() {
    let place = Workplace::new();
    let table = "[[missing.parameters]]\nname = \"angle_deg\"\nvalue = 720.0\n\
                 low95 = 0.1\nhigh95 = 0.2\nunit = \"deg\"\n\n[fit]";
    let text = diagnosis("ambiguous", &["slope", "tether"]).replace("parameters = []\n", "");
    place.write("diagnosis.toml", &text.replace("[fit]", table));
    place.write("vehicle.corrected.toml", &project_text("configs/vehicles/auriga-alpha.toml"));
    let run = place.run("plan --diagnosis diagnosis.toml --out out");
    assert_eq!(run.status, 1, "{}", run.stdout);
    let shown = "diagnosis.toml:14: missing.parameters.angle_deg = 720.0: expected a value from";
    assert!(run.stderr.contains(shown), "{}", run.stderr);
}

#[test]
fn nonsense_is_refused_and_nothing_written() {
    let cases: [(&str, &[&str], &str, &[&str]); 4] = [
        (
            "ambiguous",
            &["slope", "sloppe"],
            "",
            &["diagnosis.toml:10: missing.one_of = \"sloppe\": expected an effect of the \
                 catalogue"],
        ),
        (
            "vague",
            &["slope"],
            "",
            &["diagnosis.toml:2: status = \"vague\": expected \"explained\""],
        ),
        (
            "ambiguous",
            &["slope", "tether"],
            "--duration 2",
            &["--duration: 2 s: expected at least 4.32 s"],
        ),
        (
            "ambiguous",
            &["slope", "tether"],
            "--vehicle missing.toml",
            &["missing.toml: cannot be read"],
        ),
    ];
    for (status, members, options, parts) in cases {
        let (place, run) = plan(status, members, options);
        assert_eq!(run.status, 1, "{}", run.stdout);
        for part in parts {
            assert!(run.stderr.contains(part), "{part:?} is not in:\n{}", run.stderr);
        }
        assert!(wrote_nothing(&place));
    }
}
