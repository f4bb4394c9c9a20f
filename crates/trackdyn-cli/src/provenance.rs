//! The command line, for the files that are written: a shell takes it as it took the one given.

use crate::shell::quoted;
use trackdyn::Provenance;

/// This version of the program at the request of its command line.
pub fn provenance() -> Provenance {
    let arguments = std::env::args_os().skip(1);
    let arguments = arguments.map(|argument| quoted(&argument.to_string_lossy()));
    let words: Vec<String> = std::iter::once("trackdyn".to_owned()).chain(arguments).collect();
    Provenance::new(words.join(" "))
}
