//! `trackdyn trial score`: opens the answers and scores the diagnoses.

use super::{figures, key_to_open};
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::folder::prepare_folder;
use crate::stderr::say;
use crate::stdout::show;
use clap::Args;
use std::path::{Path, PathBuf};
use trackdyn::crates::core::output::write_file;
use trackdyn_blind_trial::{Entry, Opened, Score, folder, score};

/// Options of `trackdyn trial score`.
#[derive(Args)]
pub struct Options {
    /// Folder of the trial; several trials count as one
    #[arg(required = true, value_name = "TRIAL")]
    trials: Vec<PathBuf>,
    /// File with the key to the answers; of several trials one each, in their order [default:
    /// beside DIR, NAME.key]
    #[arg(long = "key", value_name = "FILE")]
    keys: Vec<PathBuf>,
    /// SHA-256 of the answers as it was published elsewhere, to be compared; of several trials one
    /// each, in their order
    #[arg(long = "commitment", value_name = "HASH")]
    commitments: Vec<String>,
    /// Name of the program whose diagnoses are scored; several times for several programs beside
    /// each other [default: trackdyn]
    #[arg(long = "name", value_name = "NAME")]
    names: Vec<Entry>,
    /// Folder for tables and figures [default: DIR/score, DIR/score.NAME of other programs; none of
    /// several trials]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Scores the diagnoses that are there.
pub fn run(options: &Options) -> Outcome {
    let mut entries = options.names.clone();
    if entries.is_empty() {
        entries.push(Entry::default());
    }
    refuse_unknown(&entries, &options.trials)?;
    let keys = key_files(options)?;
    one_each("--commitment", options.commitments.len(), options.trials.len())?;
    let opened = Opened::open(options.trials.iter().map(PathBuf::as_path).zip(keys))?;
    opened.check(&options.commitments)?;
    let out = match (&options.out, options.trials.as_slice()) {
        (Some(out), _) => out.clone(),
        (None, [trial]) => trial.join(usual_folder(&entries)),
        (None, _) => return Err("several trials: expected --out DIR for their scores".into()),
    };
    let of = |entry| Ok(Score::of(opened.judge(entry)?));
    let scores: Vec<Score> =
        entries.iter().map(of).collect::<Result<_, trackdyn_blind_trial::Error>>()?;
    let named: Vec<(&str, &Score)> = entries.iter().map(Entry::name).zip(&scores).collect();
    prepare_folder(&out)?;
    let caption =
        format!("trackdyn {}, {opened}{}", env!("CARGO_PKG_VERSION"), undiagnosed(&scores));
    let page = match named.as_slice() {
        [(_, score)] => score::markdown(score),
        _ => score::comparison(&named),
    };
    for one in &named {
        let home = if named.len() == 1 { out.clone() } else { out.join(one.0) };
        write(&home, *one, &caption)?;
    }
    figures::write(&out, &named, &caption)?;
    let page = format!("{page}\nAnswers: SHA-256 {}.\n", opened.hashes().join(" and "));
    write_file(&out.join("score.md"), page.as_bytes())?;
    for (name, text) in opened.texts() {
        write_file(&out.join(name), text.as_bytes())?;
    }
    show(&page)?;
    say(format_args!(
        "the commitment holds; wrote tables, figures and the opened answers to {}",
        out.display()
    ));
    Ok(Exit::Done)
}

/// Answers are not opened for a program that was never run: its name may be mistyped.
fn refuse_unknown(entries: &[Entry], trials: &[PathBuf]) -> Result<(), Box<dyn std::error::Error>> {
    let mut cases = Vec::new();
    for trial in trials {
        cases.extend(folder::cases(trial)?);
    }
    for entry in entries {
        let has_replied = |case: &PathBuf| entry.has_diagnosed(case) || entry.has_failed(case);
        if !cases.iter().any(has_replied) {
            return Err(format!(
                "--name {}: expected a program that was run on the trial: the answers stay sealed",
                entry.name()
            )
            .into());
        }
    }
    Ok(())
}

/// The key of each trial.
fn key_files(options: &Options) -> Result<Vec<PathBuf>, Box<dyn std::error::Error>> {
    let (trials, keys) = (&options.trials, &options.keys);
    one_each("--key", keys.len(), trials.len())?;
    let of = |(place, trial)| key_to_open(keys.get(place).map(PathBuf::as_path), trial);
    trials.iter().map(PathBuf::as_path).enumerate().map(of).collect()
}

/// An option that comes once for each trial, or not at all.
fn one_each(name: &str, times: usize, trials: usize) -> Result<(), String> {
    if times == 0 || times == trials {
        return Ok(());
    }
    Err(format!("{trials} trials, {times} times {name}: expected one of each trial"))
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

/// Of how many cases nothing came back, for a caption; empty where something did of all.
fn undiagnosed(scores: &[Score]) -> String {
    if scores.iter().all(|score| score.absent == 0) {
        return String::new();
    }
    let absent: Vec<String> = scores.iter().map(|score| score.absent.to_string()).collect();
    format!(", not diagnosed: {}", absent.join(" and "))
}

/// Where the scores of programs go, so that those of others do not replace them.
fn usual_folder(entries: &[Entry]) -> String {
    match entries {
        [own] if own.name() == Entry::OWN_NAME => "score".to_owned(),
        _ => format!("score.{}", entries.iter().map(Entry::name).collect::<Vec<_>>().join("+")),
    }
}
