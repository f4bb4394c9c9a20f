//! What is compiled for the program serves the tests and the Python package: one set of features.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

/// Packages with their features, as cargo resolves them for what it is told to build.
fn resolved(of: &[&str]) -> BTreeSet<String> {
    let run = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args(["tree", "--offline", "--prefix", "none", "--format", "{p} {f}"])
        .args(of)
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."))
        .output()
        .expect("cargo runs");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let lines = String::from_utf8(run.stdout).expect("text");
    // a package that stands in the tree before ends in (*)
    lines.lines().map(|line| line.trim_end_matches(" (*)").to_owned()).collect()
}

#[test]
fn program_and_python_package_have_the_features_of_the_tests() {
    let all = resolved(&["--workspace"]);
    for package in ["trackdyn-cli", "trackdyn-py"] {
        let own = resolved(&["--package", package, "--edges", "normal,build"]);
        let others: Vec<&String> = own.difference(&all).collect();
        assert!(
            others.is_empty(),
            "{package} has fewer features than the tests of the workspace, and what it needs is \
             compiled twice. Add the features to its Cargo.toml: {others:#?}"
        );
    }
}
