//! Cases driven on: whether the driving that is planned for an ambiguous diagnosis resolves it.
//!
//! After opening, a case with an open set is planned for by a process, driven on its own ground,
//! and diagnosed anew, from the old recording and the new one together, by another process.

use crate::answer::Answers;
use crate::diagnosis::{self, Diagnosis};
use crate::driving::HELD_OUT;
use crate::entry::{DIAGNOSIS, Entry};
use crate::error::Error;
use crate::folder;
use crate::revisit::revisit;
use crate::room::{Guard, OUT, Program, Room};
use crate::score::{Judged, Outcome};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::Duration;
use trackdyn_core::Schedule;
use trackdyn_core::document::Document;
use trackdyn_core::output::{prepare_folder, write_file};
use trackdyn_drive::schedules;

/// The recording of the new driving, and the plan for it.
const NEW_DRIVE: &str = "again";
const PLAN: &str = "plan";
const SCHEDULE: &str = "plan.csv";
/// What was asked for.
const REQUEST: &str = "asked.toml";
/// What a diagnosis leaves for a plan.
const CORRECTED_VEHICLE: &str = "vehicle.corrected.toml";

/// What the results in a folder depend on.
#[derive(Serialize, Deserialize)]
struct Asked {
    /// The trial: SHA-256 of its answers.
    answers_sha256: String,
    /// Time of the planned driving, s.
    duration_s: u32,
}

/// Who plans and diagnoses, for how much driving, and where results go.
#[derive(Clone, Debug)]
pub struct Visits<'a> {
    /// Folder of the trial.
    pub trial: &'a Path,
    /// Its answers.
    pub answers: &'a Answers,
    /// Folder for plans, recordings and diagnoses.
    pub out: &'a Path,
    /// Time of the planned driving, s.
    pub duration: u32,
    /// The program with the commands `plan` and `diagnose`.
    pub program: PathBuf,
    /// Time after which a process of it is ended.
    pub limit: Duration,
    /// What a signal that ends this program has to do first.
    pub guard: Guard,
}

impl Visits<'_> {
    /// Begins the folder of results, or goes on with it where it is for the same trial and time.
    ///
    /// # Errors
    /// [`Error::OtherTrial`], [`Error::OtherDuration`]; [`Error::Output`], [`Error::Document`].
    ///
    /// # Panics
    /// Never: a hash and a number are TOML.
    pub fn take_up(&self) -> Result<(), Error> {
        let answers_sha256 = folder::commitment(self.trial)?.answers_sha256;
        let asked = Asked { answers_sha256, duration_s: self.duration };
        let (folder, path) = (self.out.to_owned(), self.out.join(REQUEST));
        if !path.exists() {
            prepare_folder(self.out)?;
            let text = toml::to_string(&asked).expect("a hash and a number are TOML");
            return Ok(write_file(&path, text.as_bytes())?);
        }
        let before: Asked = Document::read(&path)?.parse()?;
        if before.answers_sha256 != asked.answers_sha256 {
            return Err(Error::OtherTrial { folder });
        }
        if before.duration_s != asked.duration_s {
            return Err(Error::OtherDuration { folder, begun: before.duration_s });
        }
        Ok(())
    }

    /// What comes of a case, now or before; a failure is tried again.
    ///
    /// # Errors
    /// [`Error::Program`] for a program that cannot be run; [`Error::File`], [`Error::Output`],
    /// [`Error::Recording`], [`Error::System`].
    pub fn outcome(&self, judged: &Judged) -> Result<Outcome, Error> {
        let id = &judged.answer.id;
        let visit = Visit { by: self, judged, case: self.trial.join(id), home: self.out.join(id) };
        visit.outcome()
    }
}

/// Where a case is and where what comes of it goes.
struct Visit<'a> {
    by: &'a Visits<'a>,
    judged: &'a Judged,
    case: PathBuf,
    home: PathBuf,
}

impl Visit<'_> {
    fn outcome(&self) -> Result<Outcome, Error> {
        prepare_folder(&self.home)?;
        let written = self.home.join(DIAGNOSIS);
        if !written.join(diagnosis::FILE).exists() {
            if let Some(reason) = self.plan()? {
                return Ok(Outcome::Failed(reason));
            }
            let Some(schedule) = self.schedule()? else { return Ok(Outcome::NothingToDrive) };
            match revisit(self.by.answers, &self.judged.answer.id, schedule) {
                Ok(recording) => {
                    trackdyn_recording::folder::write(&recording, &self.home.join(NEW_DRIVE))?;
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
    fn plan(&self) -> Result<Option<String>, Error> {
        let room = Room::new(self.by.guard)?;
        let before = Entry::default().diagnosis(&self.case);
        for name in [diagnosis::FILE, CORRECTED_VEHICLE] {
            if let Err(reason) = room.bring(&before.join(name), name) {
                return Ok(Some(reason.to_string()));
            }
        }
        let answer = &self.judged.answer;
        let numbers = [
            answer.fastest_m_per_s,
            f64::from(self.by.duration),
            answer.pose_white_m,
            answer.pose_white_rad,
        ];
        let keys = ["--fastest", "--duration", "--noise-xy", "--noise-yaw"];
        let numbers = numbers.map(|number| number.to_string());
        let mut arguments = vec!["--diagnosis", diagnosis::FILE, "--out", OUT];
        arguments.extend(keys.iter().zip(&numbers).flat_map(|(key, text)| [*key, text]));
        let failed = room.run(&self.program("plan"), &arguments)?;
        if failed.is_none() {
            room.take(&self.home.join(PLAN))?;
        }
        Ok(failed)
    }

    /// What is to be driven; none where no driving decides.
    fn schedule(&self) -> Result<Option<Schedule>, Error> {
        let path = self.home.join(PLAN).join(SCHEDULE);
        if !path.exists() {
            return Ok(None);
        }
        let runs = schedules::read(&path)?;
        Ok(runs.into_iter().next().map(|run| run.schedule))
    }

    /// Diagnoses old and new driving together; says why it failed.
    fn diagnose(&self, place: &Path) -> Result<Option<String>, Error> {
        let room = Room::new(self.by.guard)?;
        for name in [folder::RECORDING, folder::VEHICLE] {
            room.bring(&self.case.join(name), name)?;
        }
        room.bring(&self.home.join(NEW_DRIVE), NEW_DRIVE)?;
        let sources = [folder::RECORDING, NEW_DRIVE, "--vehicle", folder::VEHICLE];
        let arguments = [&sources[..], &["--held-out", HELD_OUT, "--out", OUT]].concat();
        let failed = room.run(&self.program("diagnose"), &arguments)?;
        if failed.is_none() {
            room.take(place)?;
        }
        Ok(failed)
    }

    fn program(&self, command: &'static str) -> Program {
        Program { path: self.by.program.clone(), first: Some(command), limit: self.by.limit }
    }
}
