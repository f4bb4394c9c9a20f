//! Sources are readable: lines are short, and a doc comment stands alone.

use super::crates::all;
use std::path::Path;

/// Largest number of characters in a line.
const MAX_COLUMNS: usize = 100;

/// Crates, and folders of crates, that do not keep the rules yet.
const NOT_YET: [(&str, &str); 8] = [
    ("blind-trial", ""),
    ("cli", "commands/trial"),
    ("cli", "commands/trial.rs"),
    ("diagnose", ""),
    ("localisation", ""),
    ("model", "effects"),
    ("report", ""),
    ("second-simulator", ""),
];

/// What is wrong with the lines of a source, with their numbers.
fn faults(text: &str) -> Vec<(usize, &'static str)> {
    let mut found = Vec::new();
    let mut is_documented = false;
    for (number, line) in (1..).zip(text.lines()) {
        if line.chars().count() > MAX_COLUMNS {
            found.push((number, "more than 100 columns"));
        }
        let comment = line.trim_start();
        let doc = comment.strip_prefix("///").or_else(|| comment.strip_prefix("//!"));
        if !is_documented && doc.is_some_and(|doc| doc.trim_start().starts_with("The same")) {
            found
                .push((number, "a doc comment that begins with \"The same\" does not stand alone"));
        }
        is_documented = doc.is_some();
    }
    found
}

fn is_exempt(name: &str, source: &Path) -> bool {
    NOT_YET.iter().any(|(of, folder)| *of == name && source.starts_with(folder))
}

#[test]
fn lines_are_short_and_doc_comments_stand_alone() {
    let mut found = Vec::new();
    let mut lines = 0;
    for of in all() {
        for (path, text) in of.sources() {
            if is_exempt(&of.name, &path) {
                continue;
            }
            lines += text.lines().count();
            let place = format!("{}/src/{}", of.name, path.display());
            let faults = faults(&text).into_iter();
            found.extend(faults.map(|(line, fault)| format!("{place}:{line}: {fault}")));
        }
    }
    assert!(lines > 10_000, "only {lines} lines were seen");
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn faults_are_seen() {
    let wide = "x".repeat(MAX_COLUMNS + 1);
    let text =
        format!("/// Thing.\n/// The same here is fine.\n{wide}\n    /// The same of a thing.\n");
    let lines: Vec<usize> = faults(&text).into_iter().map(|(line, _)| line).collect();
    assert_eq!(lines, [3, 4]);
    assert!(is_exempt("model", Path::new("effects/slope.rs")));
    assert!(!is_exempt("model", Path::new("effects.rs")));
}
