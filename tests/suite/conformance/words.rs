//! Sources and manifests are readable: lines are short, and a comment stands alone.

use super::crates::files_below;
use std::path::Path;

/// Largest number of characters in a line.
const MAX_COLUMNS: usize = 100;

/// What is wrong with the lines of a source, with their numbers.
fn faults(text: &str) -> Vec<(usize, &'static str)> {
    let mut found = Vec::new();
    let mut is_in_paragraph = false;
    for (number, line) in (1..).zip(text.lines()) {
        if line.chars().count() > MAX_COLUMNS {
            found.push((number, "more than 100 columns"));
        }
        let comment = line.trim_start().strip_prefix("//").unwrap_or_default();
        let comment = comment.trim_start_matches(['/', '!']).trim_start();
        if !is_in_paragraph && comment.starts_with("The same") {
            found.push((number, "a paragraph that begins with \"The same\" does not stand alone"));
        }
        is_in_paragraph = !comment.is_empty();
    }
    found
}

#[test]
fn lines_are_short_and_comments_stand_alone() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let is_read = |path: &Path| {
        path.extension().is_some_and(|ending| ending == "rs") || path.ends_with("Cargo.toml")
    };
    let mut files = vec![("Cargo.toml".into(), std::fs::read_to_string(top.join("Cargo.toml")))];
    for folder in ["crates", "tests", "benches"] {
        let below = files_below(&top.join(folder), &is_read).into_iter();
        files.extend(below.map(|(path, text)| (Path::new(folder).join(path), Ok(text))));
    }
    let mut found = Vec::new();
    let mut lines = 0;
    for (path, text) in files {
        let text = text.expect("a text");
        lines += text.lines().count();
        let faults = faults(&text).into_iter();
        found.extend(faults.map(|(line, fault)| format!("{}:{line}: {fault}", path.display())));
    }
    assert!(lines > 100_000, "only {lines} lines were seen");
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn faults_are_seen() {
    let wide = "x".repeat(MAX_COLUMNS + 1);
    let text = format!(
        "/// Thing.\n/// The same here is fine.\n{wide}\n    /// The same of a thing.\n\
         //! Thing.\n//!\n//! The same of a paragraph.\nlet x = 1;\n    // The same in code.\n"
    );
    let lines: Vec<usize> = faults(&text).into_iter().map(|(line, _)| line).collect();
    assert_eq!(lines, [3, 4, 7, 9]);
}
