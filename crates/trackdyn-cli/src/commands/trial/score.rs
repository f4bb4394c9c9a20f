//! `trackdyn trial score`: opens the answers and scores the diagnoses.

use super::key_file;
use crate::commands::Outcome;
use crate::exit::Exit;
use clap::Args;
use std::path::PathBuf;
use trackdyn_core::output::{prepare_folder, write_file};
use trackdyn_trial::seal::Key;
use trackdyn_trial::{Score, folder, score, seal};

/// Options of `trackdyn trial score`.
#[derive(Args)]
pub struct Options {
    /// Folder of the trial
    trial: PathBuf,
    /// File with the key to the answers [default: beside DIR, NAME.key]
    #[arg(long, value_name = "FILE")]
    key: Option<PathBuf>,
    /// Folder for the tables [default: DIR/score]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Scores the diagnoses that are there.
pub fn run(options: &Options) -> Outcome {
    let key = Key::read(&key_file(options.key.as_deref(), &options.trial)?)?;
    let answers = folder::open_answers(&options.trial, &key)?;
    let score = Score::of(folder::judge(&options.trial, &answers)?);
    let out = options.out.clone().unwrap_or_else(|| options.trial.join("score"));
    prepare_folder(&out)?;
    let page = score::markdown(&score);
    for (name, text) in [
        ("score.md", &page),
        ("rates.csv", &score::rates_csv(&score)),
        ("power.csv", &score::power_csv(&score)),
        ("confusion.csv", &score::confusion_csv(&score)),
        ("cases.csv", &score::cases_csv(&score)),
        ("answers.toml", &seal::text(&answers)),
    ] {
        write_file(&out.join(name), text.as_bytes())?;
    }
    print!("{page}");
    eprintln!("the commitment holds; wrote the tables and the opened answers to {}", out.display());
    Ok(if score.judged.is_empty() { Exit::NoResult } else { Exit::Done })
}
