//! `trackdyn trial score`: opens the answers and scores the diagnoses.

use super::{figures, key_file};
use crate::commands::Outcome;
use crate::exit::Exit;
use clap::Args;
use std::path::{Path, PathBuf};
use trackdyn_core::output::{fingerprint, prepare_folder, write_file};
use trackdyn_trial::seal::Key;
use trackdyn_trial::{Entry, Score, folder, score, seal};

/// Options of `trackdyn trial score`.
#[derive(Args)]
pub struct Options {
    /// Folder of the trial
    trial: PathBuf,
    /// File with the key to the answers [default: beside DIR, NAME.key]
    #[arg(long, value_name = "FILE")]
    key: Option<PathBuf>,
    /// Name of the program whose diagnoses are scored; several times for several programs beside each other
    /// [default: trackdyn]
    #[arg(long = "name", value_name = "NAME")]
    names: Vec<Entry>,
    /// Folder for tables and figures [default: DIR/score, DIR/score.NAME of other programs]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Scores the diagnoses that are there.
pub fn run(options: &Options) -> Outcome {
    let key = Key::read(&key_file(options.key.as_deref(), &options.trial)?)?;
    let answers = folder::open_answers(&options.trial, &key)?;
    let mut entries = options.names.clone();
    if entries.is_empty() {
        entries.push(Entry::default());
    }
    let of = |entry| Ok(Score::of(folder::judge(&options.trial, &answers, entry)?));
    let scores: Vec<Score> =
        entries.iter().map(of).collect::<Result<_, trackdyn_trial::Error>>()?;
    let named: Vec<(&str, &Score)> = entries.iter().map(Entry::name).zip(&scores).collect();
    let out = options.out.clone().unwrap_or_else(|| options.trial.join(usual_folder(&entries)));
    prepare_folder(&out)?;
    let text = seal::text(&answers);
    let caption = format!(
        "trackdyn {}, trial of {} cases, SHA-256 of the answers {}…",
        env!("CARGO_PKG_VERSION"),
        answers.cases.len(),
        fingerprint(text.as_bytes())
    );
    let page = match named.as_slice() {
        [(_, score)] => score::markdown(score),
        _ => score::comparison(&named),
    };
    for one in &named {
        let home = if named.len() == 1 { out.clone() } else { out.join(one.0) };
        write(&home, *one, &caption)?;
    }
    figures::write(&out, &named, &caption)?;
    write_file(&out.join("score.md"), page.as_bytes())?;
    write_file(&out.join("answers.toml"), text.as_bytes())?;
    print!("{page}");
    eprintln!(
        "the commitment holds; wrote tables, figures and the opened answers to {}",
        out.display()
    );
    let is_empty = scores.iter().all(|score| score.judged.is_empty());
    Ok(if is_empty { Exit::NoResult } else { Exit::Done })
}

/// Writes the tables of a program, and what it took for what.
fn write(
    out: &Path,
    (name, score): (&str, &Score),
    caption: &str,
) -> Result<(), Box<dyn std::error::Error>> {
    prepare_folder(out)?;
    for (file, text) in [
        ("score.md", score::markdown(score)),
        ("rates.csv", score::rates_csv(&score.rates)),
        ("coverage.csv", score::rates_csv(&score.coverage)),
        ("power.csv", score::power_csv(score)),
        ("confusion.csv", score::confusion_csv(score)),
        ("cases.csv", score::cases_csv(score)),
    ] {
        write_file(&out.join(file), text.as_bytes())?;
    }
    figures::write_confusion(out, (name, score), caption)
}

/// Where the scores of programs go, so that those of others do not replace them.
fn usual_folder(entries: &[Entry]) -> String {
    match entries {
        [own] if own.name() == Entry::OWN => "score".to_owned(),
        _ => format!("score.{}", entries.iter().map(Entry::name).collect::<Vec<_>>().join("+")),
    }
}
