//! Dependencies between the crates point one way.

use std::path::Path;

/// Which crates of the project each crate may use.
const ALLOWED: [(&str, &[&str]); 10] = [
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
        ],
    ),
    ("trackdyn-export", &["trackdyn-core", "trackdyn-motion"]),
    (
        "trackdyn-cli",
        &[
            "trackdyn-core",
            "trackdyn-physics",
            "trackdyn-motion",
            "trackdyn-recording",
            "trackdyn-identify",
            "trackdyn-odometry",
            "trackdyn-field",
            "trackdyn-report",
            "trackdyn-export",
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
