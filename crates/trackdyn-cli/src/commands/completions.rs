//! `trackdyn completions SHELL`.

use crate::commands::Outcome;
use crate::exit::Exit;
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
    clap_complete::generate(options.shell, &mut command, "trackdyn", &mut std::io::stdout().lock());
    Ok(Exit::Done)
}
