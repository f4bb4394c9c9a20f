//! `trackdyn completions SHELL`.

use crate::arguments::Arguments;
use crate::commands::Outcome;
use crate::exit::Exit;
use clap::{Args, CommandFactory};
use clap_complete::Shell;

/// Options of `trackdyn completions`.
#[derive(Args)]
pub struct Options {
    /// The shell
    shell: Shell,
}

/// Prints the completions.
pub fn run(options: &Options) -> Outcome {
    let mut command = Arguments::command();
    clap_complete::generate(options.shell, &mut command, "trackdyn", &mut std::io::stdout().lock());
    Ok(Exit::Done)
}
