//! The command line of trackdyn: one file per command in `commands`.
//!
//! Results go to stdout, talk and progress to stderr. Exit status: see [`exit::Exit`].

#![warn(clippy::print_stdout, clippy::print_stderr)]

mod arguments;
mod changes;
mod commands;
mod exit;
mod folder;
mod gyroscope;
mod interrupt;
mod options;
mod plain;
mod progress;
mod provenance;
mod shell;
mod stderr;
mod stdout;
mod threads;
mod wording;
mod wrapped;

use arguments::Arguments;
use exit::Exit;
use plain::plain;
use std::io::{Write, stderr, stdout};
use std::process::ExitCode;
use stderr::fail;
use wrapped::in_lines;

fn main() -> ExitCode {
    let arguments = match Arguments::read() {
        Ok(arguments) => arguments,
        Err(message) => {
            let exit = if message.use_stderr() { Exit::BadInput } else { Exit::Done };
            let text = message.render().to_string();
            let is_error = message.use_stderr();
            let shown = plain(&text);
            let shown = if is_error { in_lines(&shown) } else { shown };
            // Nothing is left to do where even the message cannot be printed.
            let _ = match shown {
                plain if plain == text => message.print(),
                plain if is_error => write!(stderr(), "{plain}"),
                plain => write!(stdout(), "{plain}"),
            };
            return exit.into();
        }
    };
    if let Err(error) = threads::check() {
        fail(&error);
        return Exit::BadInput.into();
    }
    if let Err(error) = interrupt::end_between_files() {
        fail(&format!("Ctrl-C cannot be waited for: {error}"));
        return Exit::BadInput.into();
    }
    match arguments.command.run() {
        Ok(exit) => exit.into(),
        Err(error) => {
            fail(&wording::message(&*error));
            Exit::of(&*error).into()
        }
    }
}
