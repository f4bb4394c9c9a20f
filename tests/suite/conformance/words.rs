//! Sources are readable: lines are short, and a doc comment stands alone.

use super::crates::{all, sources_below};
use std::path::Path;

/// Largest number of characters in a line.
const MAX_COLUMNS: usize = 100;

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

#[test]
fn lines_are_short_and_doc_comments_stand_alone() {
    let suite = Path::new(env!("CARGO_MANIFEST_DIR")).join("suite");
    let suite = sources_below(&suite).into_iter().map(|source| ("suite".to_owned(), source));
    let crates = all().into_iter().flat_map(|of| {
        let sources = of.sources().into_iter().map(move |source| (of.name.clone(), source));
        sources.collect::<Vec<_>>()
    });
    let mut found = Vec::new();
    let mut lines = 0;
    for (name, (path, text)) in crates.chain(suite) {
        lines += text.lines().count();
        let faults = faults(&text).into_iter();
        let place = path.display();
        found.extend(faults.map(|(line, fault)| format!("{name}: {place}:{line}: {fault}")));
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
}
