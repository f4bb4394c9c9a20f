//! Talk goes to stderr.

use std::fmt::Arguments;
use std::io::{Write, stderr};

/// Says a line that is no result: a note, an error, where files went.
///
/// Where it cannot be written, as on a full disk or where nobody reads any more, it is dropped:
/// results, files and the exit status are the same.
pub fn say(line: Arguments) {
    let _ = writeln!(stderr().lock(), "{line}");
}
