//! The commands.

pub mod check;
pub mod completions;
pub mod effects;
pub mod export;
pub mod identify;
pub mod inspect;
pub mod kinematics;
pub mod man;
pub mod map;
pub mod odometry;

use crate::arguments::Command;
use crate::exit::Exit;
use std::error::Error;

/// What a command returns; an error is the user's to mend.
pub type Outcome = Result<Exit, Box<dyn Error>>;

/// Runs a command.
pub fn run(command: &Command) -> Outcome {
    match command {
        Command::Map(options) => map::run(options),
        Command::Kinematics(options) => kinematics::run(options),
        Command::Odometry(options) => odometry::run(options),
        Command::Check(options) => check::run(options),
        Command::Export(options) => export::run(options),
        Command::Effects(options) => effects::run(options),
        Command::Inspect(options) => inspect::run(options),
        Command::Identify(options) => identify::run(options),
        Command::Completions(options) => completions::run(options),
        Command::Man => man::run(),
    }
}
