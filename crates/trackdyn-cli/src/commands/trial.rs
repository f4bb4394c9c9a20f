//! `trackdyn trial`: the proof that the diagnosis finds what was concealed from it.

mod drive;
mod figures;
mod make;
mod run;
mod score;

use crate::commands::Outcome;
use clap::{Args, Subcommand};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Options of `trackdyn trial`.
#[derive(Args)]
pub struct Options {
    /// What to do
    #[command(subcommand)]
    step: Step,
}

/// The steps of a trial.
#[derive(Subcommand)]
enum Step {
    /// Make cases: recordings on the independent ground with concealed physics, and the answers
    /// apart from them
    Make(make::Options),
    /// Diagnose the cases, each by a process of its own that gets the recording and the vehicle
    /// only
    Run(run::Options),
    /// Check the commitment, open the answers and score the diagnoses
    Score(score::Options),
    /// Drive what is planned for ambiguous diagnoses on their concealed ground, and score what it
    /// resolves
    Drive(drive::Options),
}

/// Runs a step.
pub fn run(options: &Options) -> Outcome {
    match &options.step {
        Step::Make(options) => make::run(options),
        Step::Run(options) => run::run(options),
        Step::Score(options) => score::run(options),
        Step::Drive(options) => drive::run(options),
    }
}

/// Where the key of a trial is: as asked for, or beside its folder, as `<name>.key`.
fn key_file(asked: Option<&Path>, trial: &Path) -> Result<PathBuf, Box<dyn std::error::Error>> {
    if let Some(path) = asked {
        return Ok(path.to_owned());
    }
    let trial = std::path::absolute(trial)?;
    let Some(name) = trial.file_name() else {
        return Err(format!("{}: expected a folder with a name, or --key", trial.display()).into());
    };
    let mut name = OsString::from(name);
    name.push(".key");
    Ok(trial.with_file_name(name))
}

/// The key of a trial whose answers are to be opened: it has to be there.
fn key_to_open(asked: Option<&Path>, trial: &Path) -> Result<PathBuf, Box<dyn std::error::Error>> {
    let key = key_file(asked, trial)?;
    if asked.is_none() && !key.exists() {
        let reason = "no key is there: expected --key FILE, the one of trial make";
        return Err(format!("{}: {reason}", key.display()).into());
    }
    Ok(key)
}
