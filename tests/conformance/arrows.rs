//! Dependencies between the crates point one way.

use std::path::Path;

/// Which crates of the project each crate may use.
const ALLOWED: [(&str, &[&str]); 14] = [
    ("trackdyn-core", &[]),
    ("trackdyn-physics", &["trackdyn-core"]),
    ("trackdyn-recording", &["trackdyn-core"]),
    ("trackdyn-localisation", &["trackdyn-core"]),
    ("trackdyn-motion", &["trackdyn-core", "trackdyn-physics"]),
    ("trackdyn-identify", &["trackdyn-core", "trackdyn-motion", "trackdyn-recording"]),
    ("trackdyn-odometry", &["trackdyn-core", "trackdyn-motion", "trackdyn-recording"]),
    ("trackdyn-field", &["trackdyn-core", "trackdyn-motion", "trackdyn-recording"]),
    (
        "trackdyn-report",
        &[
            "trackdyn-core",
            "trackdyn-physics",
            "trackdyn-motion",
            "trackdyn-odometry",
            "trackdyn-field",
            "trackdyn-diagnose",
        ],
    ),
    (
        "trackdyn-diagnose",
        &[
            "trackdyn-core",
            "trackdyn-physics",
            "trackdyn-motion",
            "trackdyn-recording",
            "trackdyn-identify",
        ],
    ),
    ("trackdyn-export", &["trackdyn-core", "trackdyn-motion"]),
    ("trackdyn-proof", &["trackdyn-core", "trackdyn-physics"]),
    (
        "trackdyn-trial",
        &[
            "trackdyn-core",
            "trackdyn-physics",
            "trackdyn-recording",
            "trackdyn-identify",
            "trackdyn-field",
            "trackdyn-proof",
        ],
    ),
    (
        "trackdyn-cli",
        &[
            "trackdyn-core",
            "trackdyn-physics",
            "trackdyn-motion",
            "trackdyn-recording",
            "trackdyn-identify",
            "trackdyn-diagnose",
            "trackdyn-odometry",
            "trackdyn-field",
            "trackdyn-report",
            "trackdyn-export",
            "trackdyn-proof",
            "trackdyn-trial",
        ],
    ),
];

#[test]
fn crates_depend_in_one_direction() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    let mut seen = 0;
    for entry in std::fs::read_dir(crates).expect("the folder of crates") {
        let manifest = entry.expect("readable").path().join("Cargo.toml");
        let text = std::fs::read_to_string(&manifest).expect("a manifest");
        let table: toml::Table = text.parse().expect("TOML");
        let name = table["package"]["name"].as_str().expect("a name");
        let allowed = ALLOWED.iter().find(|(of, _)| *of == name);
        let (_, allowed) = allowed.unwrap_or_else(|| panic!("{name} has no line in this test"));
        for dependency in table["dependencies"].as_table().expect("dependencies").keys() {
            assert!(
                !dependency.starts_with("trackdyn") || allowed.contains(&dependency.as_str()),
                "{name} must not use {dependency}"
            );
        }
        seen += 1;
    }
    assert_eq!(seen, ALLOWED.len());
}

/// What the independent ground may take from the physics: the description of a vehicle.
const SHARED_WITH_PROOF: [&str; 4] = ["RunningGear", "Vehicle", "VehicleError", "VehicleFile"];

#[test]
fn only_the_program_and_its_trial_reach_the_independent_ground() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    for entry in std::fs::read_dir(crates).expect("the folder of crates") {
        let folder = entry.expect("readable").path();
        let name = folder.file_name().expect("a name").to_string_lossy().into_owned();
        let text = std::fs::read_to_string(folder.join("Cargo.toml")).expect("a manifest");
        // whatever the kind of dependency, even of tests: a trial that knows its judge is none
        assert!(
            ["trackdyn-proof", "trackdyn-trial", "trackdyn-cli"].contains(&name.as_str())
                || !(text.contains("trackdyn-proof") || text.contains("trackdyn-trial")),
            "{name} must not know trackdyn-proof or trackdyn-trial"
        );
    }
}

#[test]
fn the_independent_ground_shares_no_physics() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/trackdyn-proof/src");
    let mut folders = vec![source];
    let mut uses = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("sources") {
            let path = entry.expect("readable").path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let text = std::fs::read_to_string(&path).expect("a source");
            for taken in text.split("trackdyn_physics").skip(1).filter(|t| t.starts_with("::")) {
                let names = taken.split(';').next().unwrap_or_default();
                for name in names.split(|c: char| !c.is_alphanumeric()).filter(|n| !n.is_empty()) {
                    assert!(SHARED_WITH_PROOF.contains(&name), "{} uses {name}", path.display());
                    uses += 1;
                }
            }
        }
    }
    assert!(uses > 0, "the sources are not where they were");
}
