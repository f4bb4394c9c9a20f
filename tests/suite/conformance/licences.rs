//! Licences of what the project is built from.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

/// What cargo-deny reads, too.
const ALLOWED_LICENCES: &str = include_str!("../../../.ci/deny.toml");

/// Whether one of the alternatives of a licence expression is all allowed. `/` is an old `OR`.
fn is_allowed(expression: &str, allowed: &BTreeSet<String>) -> bool {
    let plain = expression.replace('/', " OR ").replace(['(', ')'], " ");
    let words = plain.split_whitespace().collect::<Vec<_>>().join(" ");
    // `(A OR B) AND C`: each of the factors must have an allowed alternative.
    words.split(" AND ").all(|factor| factor.split(" OR ").any(|one| allowed.contains(one.trim())))
}

#[test]
fn every_dependency_has_a_licence_that_is_allowed() {
    let table: toml::Table = ALLOWED_LICENCES.parse().expect("TOML");
    let allowed = table["licenses"]["allow"].as_array().expect("a list");
    let allowed: BTreeSet<String> =
        allowed.iter().map(|one| one.as_str().expect("a name").to_owned()).collect();
    assert!(is_allowed("(MIT OR GPL-3.0) AND Unicode-3.0", &allowed));
    assert!(!is_allowed("GPL-3.0 OR LGPL-2.1-or-later", &allowed));
    let run = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args(["metadata", "--format-version", "1", "--locked"])
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."))
        .output()
        .expect("cargo runs");
    let found: serde_json::Value =
        serde_json::from_slice(&run.stdout).unwrap_or_else(|error| panic!("{error}: {run:?}"));
    let packages = found["packages"].as_array().expect("a list");
    assert!(packages.len() > 100, "{}", packages.len());
    let others: Vec<String> = packages
        .iter()
        .filter(|package| !is_allowed(package["license"].as_str().unwrap_or(""), &allowed))
        .map(|package| format!("{}: {}", package["name"], package["license"]))
        .collect();
    assert!(others.is_empty(), "{others:#?}");
}
