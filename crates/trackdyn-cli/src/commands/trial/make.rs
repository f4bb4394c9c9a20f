//! `trackdyn trial make`: cases, and the sealed answers.

use super::key_file;
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::progress::Progress;
use clap::Args;
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use trackdyn_core::output::prepare_folder;
use trackdyn_trial::answer::SCHEMA;
use trackdyn_trial::seal::Key;
use trackdyn_trial::{Answers, Case, Error, PlannedCase, Stratum, folder, plan};

/// Most cases.
const MOST: i64 = 9999;
/// Cases that are made before they are written, in the order of their numbers: a folder's place on the
/// disk does not say how long its case took.
const BATCH: usize = 32;

/// Options of `trackdyn trial make`.
#[derive(Args)]
pub struct Options {
    /// Number of cases
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=MOST))]
    cases: u32,
    /// Seed of everything that is drawn; whoever knows it can make the answers again
    #[arg(long, value_name = "SEED")]
    seed: u64,
    /// Folder for the cases, the sealed answers and the commitment to them
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// File for the key to the answers [default: beside DIR, NAME.key]
    #[arg(long, value_name = "FILE")]
    key: Option<PathBuf>,
}

/// Makes the cases.
pub fn run(options: &Options) -> Outcome {
    let key_file = key_file(options.key.as_deref(), &options.out)?;
    refuse_inside(&key_file, &options.out)?;
    if options.out.join(folder::SEALED).exists() || key_file.exists() {
        let what = "a trial is made once: expected a new --out and a new --key";
        return Err(format!("{}: {what}", options.out.display()).into());
    }
    prepare_folder(&options.out)?;
    let planned = plan(options.cases as usize, options.seed);
    let progress = Progress::new(planned.len());
    let numbered: Vec<_> = (0..).zip(&planned).collect();
    let mut answers = Vec::with_capacity(planned.len());
    for batch in numbered.chunks(BATCH) {
        let make = |(number, planned): &(u64, &PlannedCase)| {
            let case = Case::make(planned, *number, options.seed);
            progress.advance(1);
            case
        };
        let cases = batch.par_iter().map(make).collect::<Result<Vec<Case>, Error>>()?;
        for case in cases {
            folder::write_case(&options.out, &case)?;
            answers.push(case.answer);
        }
    }
    progress.finish();
    let counts = Stratum::ALL.map(|stratum| {
        format!("{} {}", answers.iter().filter(|a| a.stratum == stratum).count(), stratum.name())
    });
    let answers = Answers {
        schema: SCHEMA.to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        seed: options.seed,
        cases: answers,
    };
    let key = Key::new();
    key.write(&key_file)?;
    let commitment = folder::write_answers(&options.out, &answers, &key)?;
    println!("{} cases: {}", options.cases, counts.join(", "));
    println!("answers  SHA-256 {}", commitment.answers_sha256);
    println!("sealed   SHA-256 {}", commitment.sealed_sha256);
    eprintln!("wrote {} and the key to {}", options.out.display(), key_file.display());
    Ok(Exit::Done)
}

/// A key in the trial's own folder would go wherever the recordings go.
fn refuse_inside(key: &Path, trial: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let (key, trial) = (std::path::absolute(key)?, std::path::absolute(trial)?);
    if key.starts_with(&trial) {
        return Err(format!(
            "--key {}: expected a file outside {}",
            key.display(),
            trial.display()
        )
        .into());
    }
    Ok(())
}
