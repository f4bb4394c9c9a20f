//! `trackdyn man`: the manual page.

use crate::arguments::Arguments;
use crate::commands::Outcome;
use crate::exit::Exit;
use clap::CommandFactory;

/// Prints the page in roff.
pub fn run() -> Outcome {
    clap_mangen::Man::new(Arguments::command()).render(&mut std::io::stdout().lock())?;
    Ok(Exit::Done)
}
