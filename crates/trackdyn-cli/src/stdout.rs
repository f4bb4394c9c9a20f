//! Results go to stdout.

use crate::plain::plain;
use std::io::{self, ErrorKind, Write};

/// Prints results. Where nobody reads any more, as behind `| head`, what is left is dropped: files
/// that were asked for, and the exit status, are the same.
///
/// # Errors
/// Why stdout cannot be written, such as a full disk.
pub fn show(text: &str) -> Result<(), String> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(plain(text).as_bytes()).and_then(|()| stdout.flush()) {
        Err(cause) if cause.kind() != ErrorKind::BrokenPipe => Err(format!("stdout: {cause}")),
        _ => Ok(()),
    }
}
