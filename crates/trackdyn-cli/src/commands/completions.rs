//! `trackdyn completions SHELL`.

use crate::commands::Outcome;
use crate::exit::Exit;
use crate::stdout::show;
use clap::{Args, Command};
use clap_complete::Shell;

/// Options of `trackdyn completions`.
#[derive(Args)]
pub struct Options {
    /// The shell
    shell: Shell,
}

/// Prints the completions.
pub fn run(options: &Options, mut command: Command) -> Outcome {
    let mut script = Vec::new();
    clap_complete::generate(options.shell, &mut command, "trackdyn", &mut script);
    show(&String::from_utf8(script)?)?;
    Ok(Exit::Done)
}
