//! `trackdyn trial run`: a process per case, which sees nothing of the trial.

mod dask;

use super::key_file;
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::interrupt::before_the_end;
use crate::progress::Progress;
use crate::stderr::{note, say};
use crate::stdout::show;
use clap::{Args, ValueEnum};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Duration;
use trackdyn_blind_trial::seal::Commitment;
use trackdyn_blind_trial::{Entry, Program, Shard, Sitting, folder};

/// Options of `trackdyn trial run`.
#[derive(Args)]
pub struct Options {
    /// Folder of the trial
    trial: PathBuf,
    /// Take every N-th case only, from the I-th on (1 to N)
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Program that writes DIR/diagnosis.toml when it is called as `PROGRAM RECORDING --vehicle
    /// FILE --held-out LIST --out DIR` [default: `trackdyn diagnose`]
    #[arg(long, value_name = "PROGRAM")]
    program: Option<PathBuf>,
    /// Name under which its diagnoses are kept and scored [default: that of the program's file]
    #[arg(long, value_name = "NAME")]
    name: Option<Entry>,
    /// Time after which a process is ended and counts as failed, s
    #[arg(long, value_name = "SECONDS", default_value_t = 3600,
          value_parser = clap::value_parser!(u64).range(1..))]
    limit: u64,
    /// Run cases again whose process failed
    #[arg(long)]
    retry: bool,
    /// Who runs them: this machine, one after the other; or workers of Dask, by the Python package
    #[arg(long, value_name = "local|dask", default_value = "local", hide_possible_values = true)]
    executor: Executor,
    /// Scheduler of Dask whose workers run them [default: workers on this machine]
    #[arg(long, value_name = "ADDRESS")]
    scheduler: Option<String>,
    /// Workers of Dask on this machine [default: one a processor]
    #[arg(long, value_name = "N", conflicts_with = "scheduler")]
    workers: Option<usize>,
}

/// Who runs cases.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Executor {
    /// This machine, one after the other.
    Local,
    /// Workers of Dask.
    Dask,
}

/// Diagnoses the cases that have not been.
pub fn run(options: &Options) -> Outcome {
    if options.executor == Executor::Dask {
        return dask::hand_over(options);
    }
    if options.scheduler.is_some() || options.workers.is_some() {
        return Err("--scheduler, --workers: expected with --executor dask".into());
    }
    let (entry, program) = (entry(options)?, program(options)?);
    let shard = options.shard.unwrap_or_default();
    let sitting = Sitting::take_up(&options.trial, entry, shard, options.retry)?;
    note_what_is_within_reach(&options.trial, &folder::commitment(&options.trial)?);
    let open = sitting.open();
    let progress = Progress::new(open.len());
    let mut failed = 0;
    for case in open {
        if let Some(reason) = sitting.diagnose(case, &program, before_the_end)? {
            failed += 1;
            let name = case.file_name().unwrap_or_default().to_string_lossy();
            say(format_args!("{name}: {}", reason.lines().next().unwrap_or_default()));
        }
        progress.advance(1);
    }
    progress.finish();
    let before = sitting.count() - open.len();
    let diagnosed = open.len() - failed;
    let lost = sitting.failed() - failed;
    let lost = if lost == 0 { String::new() } else { format!(" ({lost} of them failed)") };
    show(&format!(
        "{}: {} cases: {diagnosed} diagnosed now, {failed} failed, {before} before{lost}\n",
        sitting.entry().name(),
        sitting.count(),
    ))?;
    Ok(if failed > 0 && diagnosed == 0 { Exit::NoResult } else { Exit::Done })
}

/// A process is free to look for what it was not given: rooms keep the answers from an honest one
/// only.
fn note_what_is_within_reach(trial: &Path, commitment: &Commitment) {
    let Ok(key) = key_file(None, trial) else { return };
    let answers = folder::answers_file(&key, commitment);
    for file in [key, answers].iter().filter(|file| file.exists()) {
        note(format_args!(
            "{} is within reach of the processes that diagnose: for a proof keep it \
             elsewhere meanwhile",
            file.display()
        ));
    }
}

/// The program as asked for, or this one.
fn program(options: &Options) -> Result<Program, Box<dyn Error>> {
    let limit = Duration::from_secs(options.limit);
    Ok(match &options.program {
        Some(path) => Program { path: std::path::absolute(path)?, first: None, limit },
        None => Program { path: std::env::current_exe()?, first: Some("diagnose"), limit },
    })
}

fn entry(options: &Options) -> Result<Entry, Box<dyn Error>> {
    match (&options.name, &options.program) {
        (Some(name), _) => Ok(name.clone()),
        (None, None) => Ok(Entry::default()),
        (None, Some(program)) => {
            let name = program.file_stem().unwrap_or_default().to_string_lossy();
            let entry = name.parse();
            entry.map_err(|error| format!("{error}: give it a name by --name").into())
        }
    }
}
