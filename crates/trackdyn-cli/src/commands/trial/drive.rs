//! `trackdyn trial drive`: whether the driving that is planned for an ambiguous diagnosis resolves
//! it.
//!
//! After opening: each case with an open set is planned for by a process, driven on its own ground,
//! and diagnosed anew, from the old recording and the new one together, by another process.

use super::key_to_open;
use super::room::{OUT, Program, Room};
use crate::commands::Outcome as Exited;
use crate::exit::Exit;
use crate::progress::Progress;
use crate::stderr::say;
use crate::stdout::show;
use clap::Args;
use serde::{Deserialize, Serialize};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Duration;
use trackdyn::crates::core::Schedule;
use trackdyn::crates::core::document::Document;
use trackdyn::crates::core::output::{prepare_folder, write_file};
use trackdyn_blind_trial::driving::HELD_OUT;
use trackdyn_blind_trial::entry::DIAGNOSIS;
use trackdyn_blind_trial::revisit::revisit;
use trackdyn_blind_trial::score::resolution::{open_sets, rates};
use trackdyn_blind_trial::score::{Judged, Outcome, Revisited, rates_csv, resolution_markdown};
use trackdyn_blind_trial::{Answers, Diagnosis, Entry, diagnosis, folder};

/// The recording of the new driving, and the plan for it.
const NEW_DRIVE: &str = "again";
const PLAN: &str = "plan";
const SCHEDULE: &str = "plan.csv";
/// What was asked for.
const REQUEST: &str = "asked.toml";
/// What a diagnosis leaves for a plan.
const CORRECTED_VEHICLE: &str = "vehicle.corrected.toml";

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

/// What the results in a folder hang on.
#[derive(Serialize, Deserialize)]
struct Asked {
    /// The trial: SHA-256 of its answers.
    answers_sha256: String,
    /// Time of the planned driving, s.
    duration_s: u32,
}

/// Where a case is and where what comes of it goes.
struct Visit<'a> {
    answers: &'a Answers,
    judged: &'a Judged,
    case: PathBuf,
    home: PathBuf,
    options: &'a Options,
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
    let answers_sha256 = folder::commitment(&options.trial)?.answers_sha256;
    take_up(&out, &Asked { answers_sha256, duration_s: options.duration })?;
    let progress = Progress::new(open.len());
    let mut revisited = Vec::with_capacity(open.len());
    for judged in open {
        let id = &judged.answer.id;
        let (case, home) = (options.trial.join(id), out.join(id));
        let visit = Visit { answers: &answers, judged, case, home, options };
        revisited.push(Revisited { before: judged, outcome: visit.outcome()? });
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

/// Begins a folder of results, or goes on with it where the same was asked for.
fn take_up(out: &Path, asked: &Asked) -> Result<(), Box<dyn Error>> {
    let path = out.join(REQUEST);
    if path.exists() {
        let before: Asked = Document::read(&path)?.parse()?;
        if before.answers_sha256 != asked.answers_sha256 {
            let name = out.display();
            return Err(
                format!("{name}: of another trial: expected another folder by --out").into()
            );
        }
        if before.duration_s != asked.duration_s {
            return Err(format!(
                "{}: the plans here are for {} s: expected --duration {}, or another folder by \
                 --out",
                out.display(),
                before.duration_s,
                before.duration_s,
            )
            .into());
        }
        return Ok(());
    }
    prepare_folder(out)?;
    write_file(&path, toml::to_string(asked)?.as_bytes())?;
    Ok(())
}

impl Visit<'_> {
    /// What came of the case, now or before; a failure is tried again.
    fn outcome(&self) -> Result<Outcome, Box<dyn Error>> {
        prepare_folder(&self.home)?;
        let written = self.home.join(DIAGNOSIS);
        if !written.join(diagnosis::FILE).exists() {
            if let Some(reason) = self.plan()? {
                return Ok(Outcome::Failed(reason));
            }
            let Some(schedule) = self.schedule()? else { return Ok(Outcome::NothingToDrive) };
            match revisit(self.answers, &self.judged.answer.id, schedule) {
                Ok(recording) => {
                    trackdyn::crates::recording::folder::write(
                        &recording,
                        &self.home.join(NEW_DRIVE),
                    )?;
                }
                Err(error) => return Ok(Outcome::Failed(error.to_string())),
            }
            if let Some(reason) = self.diagnose(&written)? {
                return Ok(Outcome::Failed(reason));
            }
        }
        Ok(match Diagnosis::read(&written) {
            Ok(diagnosis) => Outcome::Diagnosed(Box::new(diagnosis)),
            Err(error) => Outcome::Failed(error.to_string()),
        })
    }

    /// Plans by what the diagnosis left and what an owner knows of the sensors; says why it failed.
    fn plan(&self) -> Result<Option<String>, Box<dyn Error>> {
        let room = Room::new()?;
        let before = Entry::default().diagnosis(&self.case);
        for name in [diagnosis::FILE, CORRECTED_VEHICLE] {
            if let Err(reason) = room.bring(&before.join(name), name) {
                return Ok(Some(reason));
            }
        }
        let answer = &self.judged.answer;
        let numbers = [
            answer.fastest_m_per_s,
            f64::from(self.options.duration),
            answer.pose_white_m,
            answer.pose_white_rad,
        ];
        let keys = ["--fastest", "--duration", "--noise-xy", "--noise-yaw"];
        let numbers = numbers.map(|number| number.to_string());
        let mut arguments = vec!["--diagnosis", diagnosis::FILE, "--out", OUT];
        arguments.extend(keys.iter().zip(&numbers).flat_map(|(key, text)| [*key, text]));
        let failed = room.run(&self.program("plan")?, &arguments)?;
        if failed.is_none() {
            room.take(&self.home.join(PLAN))?;
        }
        Ok(failed)
    }

    /// What is to be driven; none where no driving decides.
    fn schedule(&self) -> Result<Option<Schedule>, Box<dyn Error>> {
        let path = self.home.join(PLAN).join(SCHEDULE);
        if !path.exists() {
            return Ok(None);
        }
        let runs = trackdyn::crates::drive::schedules::read(&path)?;
        Ok(runs.into_iter().next().map(|run| run.schedule))
    }

    /// Diagnoses old and new driving together; says why it failed.
    fn diagnose(&self, place: &Path) -> Result<Option<String>, Box<dyn Error>> {
        let room = Room::new()?;
        for name in [folder::RECORDING, folder::VEHICLE] {
            room.bring(&self.case.join(name), name)?;
        }
        room.bring(&self.home.join(NEW_DRIVE), NEW_DRIVE)?;
        let sources = [folder::RECORDING, NEW_DRIVE, "--vehicle", folder::VEHICLE];
        let arguments = [&sources[..], &["--held-out", HELD_OUT, "--out", OUT]].concat();
        let failed = room.run(&self.program("diagnose")?, &arguments)?;
        if failed.is_none() {
            room.take(place)?;
        }
        Ok(failed)
    }

    fn program(&self, command: &'static str) -> Result<Program, Box<dyn Error>> {
        let limit = Duration::from_secs(self.options.limit);
        Ok(Program { path: std::env::current_exe()?, first: Some(command), limit })
    }
}
