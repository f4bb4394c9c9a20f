//! Ctrl-C and requests to end: they end the program between two files, never inside one, and leave
//! nothing behind.

use std::any::Any;
use std::io;
use std::sync::{Mutex, PoisonError};

/// What is to be undone, each with the number of its [`Undo`].
static OPEN_ACTIONS: Mutex<Vec<(u64, Action)>> = Mutex::new(Vec::new());

type Action = Box<dyn FnOnce() + Send>;

/// As long as it lives a signal that ends the program does this first.
struct Undo(u64);

/// Takes something to do before a signal ends the program, as long as what it gives lives.
pub fn before_the_end(action: Action) -> Box<dyn Any> {
    let mut open = OPEN_ACTIONS.lock().unwrap_or_else(PoisonError::into_inner);
    let number = open.last().map_or(0, |(last, _)| last + 1);
    open.push((number, action));
    Box::new(Undo(number))
}

impl Drop for Undo {
    fn drop(&mut self) {
        let mut open = OPEN_ACTIONS.lock().unwrap_or_else(PoisonError::into_inner);
        open.retain(|(number, _)| *number != self.0);
    }
}

/// From here on signals that end the program wait for the file that is being written.
///
/// The program then ends by that signal, as it would have: a shell that runs a loop of commands
/// ends too.
///
/// # Errors
/// What the system says against it.
#[cfg(unix)]
pub fn end_between_files() -> io::Result<()> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;
    use trackdyn::crates::core::output::files_at_rest;

    let mut signals = Signals::new([SIGINT, SIGTERM])?;
    std::thread::Builder::new().name("signals".to_owned()).spawn(move || {
        for signal in signals.forever() {
            let _rest = files_at_rest();
            let mut open = OPEN_ACTIONS.lock().unwrap_or_else(PoisonError::into_inner);
            open.drain(..).rev().for_each(|(_, undo)| undo());
            // It returns where the system does not let the program end: the next signal tries
            // again.
            let _ = emulate_default_handler(signal);
        }
    })?;
    Ok(())
}

/// Elsewhere the system ends the program where it is.
#[cfg(not(unix))]
pub fn end_between_files() -> io::Result<()> {
    Ok(())
}
