//! Talk goes to stderr.

use crate::plain::plain;
use crate::wrapped::{WIDTH, wrapped};
use std::collections::BTreeSet;
use std::fmt::Arguments;
use std::io::{Write, stderr};
use std::sync::{Mutex, PoisonError};

/// Notes and warnings that were said.
static PRINTED_LINES: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());

/// Says a line that is no result: where files went.
///
/// Where it cannot be written, as on a full disk or where nobody reads any more, it is dropped:
/// results, files and the exit status are the same.
pub fn say(line: Arguments) {
    let _ = writeln!(stderr().lock(), "{}", plain(&line.to_string()));
}

/// Says what a user should know, once, however often it comes up, in lines that a terminal shows
/// whole.
pub fn note(text: Arguments) {
    once("note: ", text);
}

/// Says what makes results wrong, as [`note`] does.
pub fn warn(text: Arguments) {
    once("warning: ", text);
}

/// Says why the program ends without a result, in lines that a terminal shows whole.
pub fn fail(reason: &str) {
    let mut text = String::new();
    for line in plain(&format!("error: {reason}")).lines() {
        if line.chars().count() <= WIDTH {
            // such as a line of a file with a mark below it
            text += line;
            text.push('\n');
        } else {
            let label = line.len() - line.trim_start().trim_start_matches("error: ").len();
            text += &wrapped(&line[..label], &line[label..]);
        }
    }
    let _ = stderr().lock().write_all(text.as_bytes());
}

fn once(label: &str, text: Arguments) {
    let text = wrapped(label, &plain(&text.to_string()));
    let mut said = PRINTED_LINES.lock().unwrap_or_else(PoisonError::into_inner);
    if said.insert(text.clone()) {
        let _ = stderr().lock().write_all(text.as_bytes());
    }
}
