//! `trackdyn trial drive`: whether the driving that is planned for an ambiguous diagnosis resolves
//! it.

use super::key_to_open;
use crate::commands::Outcome as Exited;
use crate::exit::Exit;
use crate::interrupt::before_the_end;
use crate::progress::Progress;
use crate::stderr::say;
use crate::stdout::show;
use clap::Args;
use std::path::PathBuf;
use std::time::Duration;
use trackdyn::crates::core::output::write_file;
use trackdyn_blind_trial::score::resolution::{open_sets, rates};
use trackdyn_blind_trial::score::{Judged, Outcome, Revisited, rates_csv, resolution_markdown};
use trackdyn_blind_trial::{Entry, Visits, folder};

/// Options of `trackdyn trial drive`.
#[derive(Args)]
pub struct Options {
    /// Folder of the trial
    trial: PathBuf,
    /// File with the key to the answers [default: beside DIR, NAME.key]
    #[arg(long, value_name = "FILE")]
    key: Option<PathBuf>,
    /// Time of the planned driving, s
    #[arg(long, value_name = "SECONDS", default_value_t = 60,
          value_parser = clap::value_parser!(u32).range(1..=3600))]
    duration: u32,
    /// Time after which a process is ended and counts as failed, s
    #[arg(long, value_name = "SECONDS", default_value_t = 3600,
          value_parser = clap::value_parser!(u64).range(1..))]
    limit: u64,
    /// Folder for plans, recordings, diagnoses and scores [default: DIR/driven]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Drives on where diagnoses are ambiguous, and scores what comes of it.
pub fn run(options: &Options) -> Exited {
    // a folder that is no trial is said to be none before a key is looked for
    folder::cases(&options.trial)?;
    let key = key_to_open(options.key.as_deref(), &options.trial)?;
    let (answers, _) = folder::open_answers(&options.trial, &key)?;
    let judged = folder::judge(&options.trial, &answers, &Entry::default())?;
    let open: Vec<&Judged> = judged.iter().filter(|case| !open_sets(case).is_empty()).collect();
    if open.is_empty() {
        show("nothing to drive for: no diagnosis leaves a set open that driving may split\n")?;
        return Ok(Exit::NoResult);
    }
    let out = options.out.clone().unwrap_or_else(|| options.trial.join("driven"));
    let visits = Visits {
        trial: &options.trial,
        answers: &answers,
        out: &out,
        duration: options.duration,
        program: std::env::current_exe()?,
        limit: Duration::from_secs(options.limit),
        guard: before_the_end,
    };
    visits.take_up()?;
    let progress = Progress::new(open.len());
    let mut revisited = Vec::with_capacity(open.len());
    for judged in open {
        revisited.push(Revisited { before: judged, outcome: visits.outcome(judged)? });
        progress.advance(1);
    }
    progress.finish();
    let page = resolution_markdown(&revisited);
    write_file(&out.join("driven.md"), page.as_bytes())?;
    write_file(&out.join("rates.csv"), rates_csv(&rates(&revisited)).as_bytes())?;
    show(&page)?;
    say(format_args!("wrote plans, recordings, diagnoses and scores to {}", out.display()));
    let is_failure = |case: &Revisited| matches!(case.outcome, Outcome::Failed(_));
    Ok(if revisited.iter().all(is_failure) { Exit::NoResult } else { Exit::Done })
}
