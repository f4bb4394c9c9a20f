//! The command line, for the files that are written.

use trackdyn::Provenance;

/// This version of the program at the request of its command line.
pub fn provenance() -> Provenance {
    let arguments = std::env::args_os().skip(1);
    let arguments = arguments.map(|argument| argument.to_string_lossy().into_owned());
    let words: Vec<String> = std::iter::once("trackdyn".to_owned()).chain(arguments).collect();
    Provenance::new(words.join(" "))
}
