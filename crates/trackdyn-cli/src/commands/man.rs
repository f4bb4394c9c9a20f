//! `trackdyn man`: the manual page.

use crate::commands::Outcome;
use crate::exit::Exit;
use crate::stdout::show;
use clap::Command;

/// Prints the page in roff.
pub fn run(command: Command) -> Outcome {
    let mut page = Vec::new();
    clap_mangen::Man::new(command).render(&mut page)?;
    show(&String::from_utf8(page)?)?;
    Ok(Exit::Done)
}
