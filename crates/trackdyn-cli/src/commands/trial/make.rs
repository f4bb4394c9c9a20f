//! `trackdyn trial make`: cases, and the answers apart from them.

use super::key_file;
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::options::finite;
use crate::progress::Progress;
use crate::stderr::say;
use crate::stdout::show;
use clap::{Args, ValueEnum};
use rayon::prelude::*;
use std::io;
use std::path::{Path, PathBuf};
use trackdyn_blind_trial::driving::RUN_TIME;
use trackdyn_blind_trial::{Case, Draft, Error, Forms, Order, PlannedCase, Stratum, folder, plan};

/// Largest number of cases.
const MAX_CASES: i64 = 9999;
/// Shortest and longest run, s: a start, a stop and some driving between; an hour.
const RUN_TIME_LIMITS: [f64; 2] = [10.0, 3600.0];
/// Largest seed: numbers in TOML have 63 bits.
const MAX_SEED: u64 = i64::MAX as u64;

/// Options of `trackdyn trial make`.
#[derive(Args)]
pub struct Options {
    /// Number of cases
    #[arg(long, value_name = "N",
          value_parser = clap::value_parser!(u32).range(1..=MAX_CASES))]
    cases: u32,
    /// Seed of everything that is drawn; whoever has it and the key can make the answers again
    #[arg(long, value_name = "N",
          value_parser = clap::value_parser!(u64).range(..=MAX_SEED))]
    seed: u64,
    /// Time of each of the twelve runs of a case, s; less makes a trial quicker, with larger
    /// effects for the same z
    #[arg(long, value_name = "SECONDS", default_value_t = RUN_TIME, value_parser = run_time)]
    duration: f64,
    /// Forms of the laws: one drawn for each case, or the one that each law had in trials until
    /// November 2026, with the laws outside the catalogue that those had
    #[arg(long, value_enum, default_value_t = LawForms::Drawn)]
    forms: LawForms,
    /// Folder for the cases and the commitment to the answers
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// File for the key, beside which the answers are put; one that is there is taken, and with the
    /// number, the seed, the duration and the forms that it was used with the same trial is made
    /// once more
    /// [default: beside DIR, NAME.key]
    #[arg(long, value_name = "FILE")]
    key: Option<PathBuf>,
}

/// Which forms the laws of a trial have.
#[derive(Clone, Copy, ValueEnum)]
enum LawForms {
    /// One for each law
    Plain,
    /// One for each case, drawn from the family of the law
    Drawn,
}

impl From<LawForms> for Forms {
    fn from(forms: LawForms) -> Self {
        match forms {
            LawForms::Plain => Self::Plain,
            LawForms::Drawn => Self::Drawn,
        }
    }
}

/// Makes the cases that are not there yet, and commits to the answers when all are.
pub fn run(options: &Options) -> Outcome {
    let key = key_file(options.key.as_deref(), &options.out)?;
    refuse_inside(&key, &options.out)?;
    let order = Order {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        seed: options.seed,
        cases: options.cases as usize,
        run_time_s: options.duration,
        forms: options.forms.into(),
    };
    let draft = Draft::begin(&options.out, &key, &order)?;
    let root = draft.root();
    let planned = plan(order.cases, &root, order.forms);
    let all = (0_u64..).zip(&planned);
    let open: Vec<_> = all.filter(|(number, _)| !draft.has(*number)).collect();
    let progress = Progress::new(planned.len());
    if open.len() < planned.len() {
        say(format_args!("{} of {} cases were there", planned.len() - open.len(), planned.len()));
        progress.advance(planned.len() - open.len());
    }
    let make = |(number, planned): &(u64, &PlannedCase)| {
        draft.keep(&Case::make(planned, *number, &order, &root)?)?;
        progress.advance(1);
        Ok(())
    };
    open.par_iter().try_for_each(make).map_err(|error: Error| error)?;
    progress.finish();
    let (answers, commitment) = draft.publish(&options.out)?;
    let counts = Stratum::ALL.map(|stratum| {
        let of = answers.cases.iter().filter(|answer| answer.stratum == stratum);
        format!("{} {}", of.count(), stratum.name())
    });
    show(&format!(
        "{} cases: {}\nanswers  SHA-256 {}\n",
        options.cases,
        counts.join(", "),
        commitment.answers_sha256
    ))?;
    say(format_args!(
        "wrote {}, the key to {}, and the answers to {}",
        options.out.display(),
        key.display(),
        folder::answers_file(&key, &commitment).display()
    ));
    Ok(Exit::Done)
}

fn run_time(text: &str) -> Result<f64, String> {
    let [low, high] = RUN_TIME_LIMITS;
    let value = finite(text)?;
    if (low..=high).contains(&value) {
        Ok(value)
    } else {
        Err(format!("expected {low} to {high} s"))
    }
}

/// Where a path leads, of which the end need not be there.
fn real(path: &Path) -> io::Result<PathBuf> {
    match (path.canonicalize(), path.parent(), path.file_name()) {
        (Err(_), Some(parent), Some(name)) => Ok(real(parent)?.join(name)),
        (found, _, _) => found,
    }
}

/// A key in the trial's own folder would go wherever the recordings go.
fn refuse_inside(key: &Path, trial: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let real = |path: &Path| {
        let found = std::path::absolute(path).and_then(|path| real(&path));
        found.map_err(|cause| format!("{}: {cause}", path.display()))
    };
    let (key, trial) = (real(key)?, real(trial)?);
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
