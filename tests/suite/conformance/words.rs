//! Sources, manifests and pages are readable: lines are short, comments stand alone, and pages are
//! not too long.

use super::crates::files_below;
use std::path::Path;

/// Largest number of characters in a line.
const MAX_COLUMNS: usize = 100;

/// Largest number of words of README.md.
const MAX_README_WORDS: usize = 1_500;

/// Largest number of words of all pages below docs but the log of trials.
const MAX_DOCS_WORDS: usize = 35_000;

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

/// Number of words: what stands between spaces and has a letter or a digit.
fn count_words(text: &str) -> usize {
    let is_word = |token: &&str| token.chars().any(char::is_alphanumeric);
    text.split_whitespace().filter(is_word).count()
}

#[test]
fn pages_are_not_too_long() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let readme = std::fs::read_to_string(top.join("README.md")).expect("a text");
    let words = count_words(&readme);
    assert!(words <= MAX_README_WORDS, "README.md has {words} words");
    let is_page = |path: &Path| path.extension().is_some_and(|ending| ending == "md");
    let mut pages = files_below(&top.join("docs"), &is_page);
    pages.retain(|(path, _)| !path.starts_with("trials/log"));
    assert!(pages.len() > 25, "only {} pages were seen", pages.len());
    let mut counts: Vec<(usize, String)> = pages
        .into_iter()
        .map(|(path, text)| (count_words(&text), path.display().to_string()))
        .collect();
    counts.sort_unstable();
    let words: usize = counts.iter().map(|(words, _)| words).sum();
    assert!(words <= MAX_DOCS_WORDS, "docs has {words} words: {counts:#?}");
}

#[test]
fn words_are_counted() {
    assert_eq!(count_words("| x_l \u{2212} 0.37 m |\n\n\u{2014} *one*, `two-three` ## 4\n"), 6);
}
