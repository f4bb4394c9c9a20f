//! `trackdyn man`: the manual page.

use crate::commands::Outcome;
use crate::exit::Exit;
use clap::Command;

/// Prints the page in roff.
pub fn run(command: Command) -> Outcome {
    clap_mangen::Man::new(command).render(&mut std::io::stdout().lock())?;
    Ok(Exit::Done)
}
