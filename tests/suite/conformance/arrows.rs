//! Dependencies between the crates point one way.

use super::crates::{Crate, all};
use std::path::Path;

/// Which crates of the project each crate may use, without `trackdyn-`.
const ALLOWED_USES: [(&str, &[&str]); 14] = [
    ("core", &[]),
    ("model", &["core"]),
    ("recording", &["core"]),
    ("estimate", &["core", "model", "recording"]),
    ("drive", &["core", "model", "recording"]),
    ("diagnose", &["core", "model", "recording", "estimate"]),
    ("export", &["core", "model"]),
    ("report", &["core", "model", "estimate", "drive", "diagnose"]),
    (
        "trackdyn",
        &["core", "model", "recording", "estimate", "drive", "diagnose", "export", "report"],
    ),
    ("cli", &["trackdyn", "second-simulator", "blind-trial"]),
    ("py", &["trackdyn"]),
    ("localisation", &["core"]),
    ("second-simulator", &["core", "model"]),
    ("blind-trial", &["core", "model", "recording", "estimate", "drive", "second-simulator"]),
];

/// The crates that may know the second simulator and the trial, be it in their tests.
const LABORATORY: [&str; 3] = ["second-simulator", "blind-trial", "cli"];

#[test]
fn crates_depend_in_one_direction() {
    for Crate { name, manifest, .. } in all() {
        let table: toml::Table = manifest.parse().expect("TOML");
        let allowed = ALLOWED_USES.iter().find(|(of, _)| *of == name);
        let (_, allowed) = allowed.unwrap_or_else(|| panic!("{name} has no line in this test"));
        for dependency in table["dependencies"].as_table().expect("dependencies").keys() {
            if !dependency.starts_with("trackdyn") {
                continue;
            }
            let used = dependency.strip_prefix("trackdyn-").unwrap_or(dependency);
            assert!(allowed.contains(&used), "{name} must not use {dependency}");
        }
    }
}

#[test]
fn a_diagnosis_cannot_know_its_judge() {
    for Crate { name, manifest, .. } in all() {
        // whatever the kind of dependency, even of tests: a trial that knows its judge is none
        let knows = manifest.contains("trackdyn-second-simulator")
            || manifest.contains("trackdyn-blind-trial");
        assert!(!knows || LABORATORY.contains(&name.as_str()), "{name} must not know the judge");
    }
}

/// What the second simulator may take from the model: the description of a vehicle, and the names
/// of the symmetries that it is measured to break.
const DESCRIPTION: [&str; 6] =
    ["RunningGear", "Symmetry", "Vehicle", "VehicleError", "VehicleFile", "effect"];

#[test]
fn the_second_simulator_shares_no_physics() {
    let simulator = all().into_iter().find(|of| of.name == "second-simulator").expect("a crate");
    let mut uses = 0;
    for (path, text) in simulator.sources() {
        for taken in text.split("trackdyn_model").skip(1).filter(|t| t.starts_with("::")) {
            let names = taken.split(';').next().unwrap_or_default();
            for name in names.split(|c: char| !c.is_alphanumeric()).filter(|n| !n.is_empty()) {
                assert!(DESCRIPTION.contains(&name), "{} uses {name}", Path::display(&path));
                uses += 1;
            }
        }
    }
    assert!(uses > 0, "the sources are not where they were");
}
