//! The commands.

pub mod check;
pub mod compare;
pub mod completions;
pub mod diagnose;
pub mod drive;
pub mod effects;
pub mod export;
pub mod identify;
pub mod init;
pub mod inspect;
pub mod kinematics;
pub mod man;
pub mod map;
pub mod odometry;
pub mod plan;
pub mod simulate;
pub mod trial;

use crate::exit::Exit;
use std::error::Error;

/// What a command returns; an error is the user's to mend.
pub type Outcome = Result<Exit, Box<dyn Error>>;
