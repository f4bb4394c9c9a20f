//! `trackdyn trial run`: a process per case, which sees nothing of the trial.

use super::key_file;
use super::room::{OUT, Program, Room};
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::progress::Progress;
use crate::stderr::{note, say};
use crate::stdout::show;
use clap::Args;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::time::{Duration, Instant};
use trackdyn::crates::core::output::write_file;
use trackdyn_blind_trial::driving::HELD_OUT;
use trackdyn_blind_trial::seal::Commitment;
use trackdyn_blind_trial::{Diagnosis, Entry, folder};

/// Options of `trackdyn trial run`.
#[derive(Args)]
pub struct Options {
    /// Folder of the trial
    trial: PathBuf,
    /// Take every N-th case only, from the I-th on (1 to N)
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Program that is called as `PROGRAM RECORDING --vehicle FILE --held-out LIST --out DIR` and
    /// writes DIR/diagnosis.toml [default: `trackdyn diagnose`]
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
}

/// A part of the cases.
#[derive(Clone, Copy)]
struct Shard {
    index: usize,
    of: usize,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(index, of)| {
            Some(Self { index: index.parse().ok()?, of: of.parse().ok()? })
        });
        parts
            .filter(|shard| (1..=shard.of).contains(&shard.index))
            .ok_or_else(|| "expected I/N with I from 1 to N, such as 2/4".to_owned())
    }
}

/// Diagnoses the cases that have not been.
pub fn run(options: &Options) -> Outcome {
    let entry = entry(options)?;
    let program = program(options)?;
    let cases = folder::cases(&options.trial)?;
    note_what_is_within_reach(&options.trial, &folder::commitment(&options.trial)?);
    let Shard { index, of } = options.shard.unwrap_or(Shard { index: 1, of: 1 });
    let mine: Vec<&PathBuf> = cases.iter().skip(index - 1).step_by(of).collect();
    let is_done =
        |case: &Path| entry.has_diagnosed(case) || (!options.retry && entry.has_failed(case));
    let open: Vec<&PathBuf> = mine.iter().copied().filter(|case| !is_done(case)).collect();
    let progress = Progress::new(open.len());
    let mut failed = 0;
    for case in &open {
        if let Some(reason) = diagnose(case, &entry, &program)? {
            failed += 1;
            let name = case.file_name().unwrap_or_default().to_string_lossy();
            say(format_args!("{name}: {}", reason.lines().next().unwrap_or_default()));
            write_file(&entry.failure(case), reason.as_bytes())?;
        }
        progress.advance(1);
    }
    progress.finish();
    let before = mine.len() - open.len();
    let diagnosed = open.len() - failed;
    let lost = mine.iter().filter(|case| entry.has_failed(case)).count() - failed;
    let lost = if lost == 0 { String::new() } else { format!(" ({lost} of them failed)") };
    show(&format!(
        "{}: {} cases: {diagnosed} diagnosed now, {failed} failed, {before} before{lost}\n",
        entry.name(),
        mine.len(),
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

/// Diagnoses a case in a room of its own, and takes back what was written, or says why there is
/// nothing.
fn diagnose(
    case: &Path,
    entry: &Entry,
    program: &Program,
) -> Result<Option<String>, Box<dyn Error>> {
    let room = Room::new()?;
    for name in [folder::RECORDING, folder::VEHICLE] {
        room.bring(&case.join(name), name)?;
    }
    let started = Instant::now();
    let arguments =
        [folder::RECORDING, "--vehicle", folder::VEHICLE, "--held-out", HELD_OUT, "--out", OUT];
    if let Some(reason) = room.run(program, &arguments)? {
        return Ok(Some(reason));
    }
    let seconds = started.elapsed().as_secs_f64();
    if let Err(error) = Diagnosis::read(&room.out()) {
        return Ok(Some(format!("the process wrote no diagnosis\n{error}")));
    }
    let text = format!("seconds = {seconds:.3}\n");
    write_file(&room.out().join("run.toml"), text.as_bytes())?;
    if let Err(reason) = room.take(&entry.diagnosis(case)) {
        return Ok(Some(reason));
    }
    let failure = entry.failure(case);
    if failure.exists() {
        fs::remove_file(failure)?;
    }
    Ok(None)
}
