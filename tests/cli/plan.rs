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
        assert!(wrote_nothing(&place));
    }
}

#[test]
fn a_size_beyond_its_range_is_shown() {
    let place = Workplace::new();
    let table = "[[missing.parameters]]\nname = \"angle_deg\"\nvalue = 720.0\nlow95 = 0.1\nhigh95 = 0.2\nunit = \"deg\"\n\n[fit]";
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
