//! `trackdyn compare`: its answer and its files, and what it refuses.

use crate::Workplace;

/// Two drives on other schedules; the second on ground with this.
fn drives(place: &Workplace, more: &str) {
    for (seed, out, effects) in [(1, "sim", ""), (2, "real", more)] {
        let run = place.run(&format!(
            "simulate --quasi-static --run-count 4 --duration 12 --seed {seed} {effects} \
             --out {out}"
        ));
        assert_eq!(run.status, 0, "{}", run.stderr);
    }
    let vehicle = String::from_utf8(place.read("sim/vehicle.toml")).expect("text");
    place.write("robot.toml", &vehicle);
}

#[test]
fn a_comparison_names_what_the_robot_has_and_is_the_same_on_any_number_of_threads() {
    let place = Workplace::new();
    drives(&place, "--effect centripetal");
    let command = "compare sim --with real --vehicle robot.toml --draws 1000";
    let run = place.run(&format!("{command} --out one"));
    assert_eq!(run.status, 0, "{}", run.stderr);
    let text = String::from_utf8(place.read("one/compare.toml")).expect("text");
    let file: toml::Table = text.parse().expect("TOML");
    let differs = file["differs"].as_array().expect("tables");
    assert_eq!(differs[0]["what"].as_str(), Some("centripetal"), "{}", run.stdout);
    assert_eq!(differs[0]["which"].as_str(), Some("real"));
    assert!(file["sim"]["fingerprint"].as_str().is_some(), "{file}");
    assert!(run.stdout.contains("SIM lacks centripetal, which REAL has"), "{}", run.stdout);
    assert!(run.stdout.lines().all(|line| line.chars().count() <= 116), "{}", run.stdout);
    let page = String::from_utf8(place.read("one/compare.html")).expect("text");
    assert!(page.contains("What differs, and what to set in the simulator"));
    let again = place.run_with_threads(&format!("{command} --out two"), 1);
    assert_eq!(run.stdout, again.stdout);
    let file = |folder: &str| place.read(&format!("{folder}/compare.toml"));
    let [one, two] = ["one", "two"].map(|folder| {
        String::from_utf8(file(folder)).expect("text").replace("--out two", "--out one")
    });
    assert_eq!(one, two);
}

#[test]
fn a_comparison_refuses_what_cannot_be_compared() {
    let place = Workplace::new();
    drives(&place, "");
    for (command, expected) in [
        ("compare sim --vehicle robot.toml", "--with"),
        ("compare sim --with sim --vehicle robot.toml", "expected in one of both sets"),
        ("compare sim --with gone --vehicle robot.toml", "gone"),
        ("compare sim --with real --vehicle gone.toml", "gone.toml"),
        ("compare sim --with real --vehicle robot.toml --held-out-real 77", "77"),
    ] {
        let run = place.run(command);
        assert_ne!(run.status, 0, "{command}");
        assert!(run.stderr.contains(expected), "{command}: {}", run.stderr);
    }
}
