//! `trackdyn man`: the manual pages.

use crate::commands::Outcome;
use crate::exit::Exit;
use crate::stdout::show;
use clap::Command;

/// Prints the page of the program and those of its commands, one after the other, in roff.
pub fn run(command: Command) -> Outcome {
    let mut command = command.disable_help_subcommand(true);
    command.build();
    let mut pages = Vec::new();
    render(&command, &mut pages)?;
    show(&String::from_utf8(pages)?)?;
    Ok(Exit::Done)
}

/// The page of a command, then those of its own commands.
fn render(command: &Command, pages: &mut Vec<u8>) -> std::io::Result<()> {
    clap_mangen::Man::new(command.clone()).render(pages)?;
    command.get_subcommands().try_for_each(|command| render(command, pages))
}
