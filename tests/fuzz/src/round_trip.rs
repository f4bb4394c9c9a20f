//! Files that are written and read back.

use std::fmt::{Debug, Display};
use trackdyn_core::document::Document;

/// Reads a text. What was read is written and read back: the second must equal the first, and its
/// text the first one.
///
/// # Panics
/// Where it does not.
pub fn check<T: Debug + PartialEq, E: Display>(
    text: &str,
    read: impl Fn(&Document) -> Result<T, E>,
    write: impl Fn(&T) -> String,
) -> Option<T> {
    let found = match read(&Document::new("input", text)) {
        Ok(found) => found,
        Err(error) => {
            let _ = error.to_string();
            return None;
        }
    };
    let written = write(&found);
    match read(&Document::new("written", written.as_str())) {
        Ok(again) => {
            assert_eq!(written, write(&again), "another text");
            // what is not a number is not equal to itself
            assert!(written.contains("nan") || found == again, "{found:?}\n{again:?}");
        }
        Err(error) => panic!("not read back: {error}\n{written}"),
    }
    Some(found)
}
