//! Cases that a program is to diagnose, each by a process in a room of its own.

use crate::diagnosis::Diagnosis;
use crate::driving::HELD_OUT;
use crate::entry::Entry;
use crate::error::Error;
use crate::folder;
use crate::room::{Guard, OUT, Program, Room};
use crate::shard::Shard;
use serde::Serialize;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;
use trackdyn_core::output::write_file;
use trackdyn_core::rounding::Digits;

/// What is written beside a diagnosis.
const RUN: &str = "run.toml";
/// Digits of the time that a process took.
const DIGITS: Digits = Digits::Decimals(3);

/// The cases of a shard, some of which a program may have diagnosed before.
#[derive(Clone, Debug)]
pub struct Sitting {
    entry: Entry,
    cases: Vec<PathBuf>,
    open: Vec<PathBuf>,
}

/// How a process went.
#[derive(Serialize)]
struct RunTable {
    /// Time that it took, s.
    seconds: f64,
}

impl Sitting {
    /// Takes up the cases of a shard. Those that the program has diagnosed are done, and so are
    /// those at which it failed, unless it is to try again.
    ///
    /// # Errors
    /// Those of [`folder::cases`].
    pub fn take_up(trial: &Path, entry: Entry, shard: Shard, retry: bool) -> Result<Self, Error> {
        let cases = shard.take(folder::cases(trial)?);
        let is_done = |case: &Path| entry.has_diagnosed(case) || (!retry && entry.has_failed(case));
        let open = cases.iter().filter(|case| !is_done(case)).cloned().collect();
        Ok(Self { entry, cases, open })
    }

    /// The program.
    pub fn entry(&self) -> &Entry {
        &self.entry
    }

    /// Number of cases.
    pub fn count(&self) -> usize {
        self.cases.len()
    }

    /// The cases that were not done when it was taken up.
    pub fn open(&self) -> &[PathBuf] {
        &self.open
    }

    /// Number of cases at which the program has failed by now.
    pub fn failed(&self) -> usize {
        self.cases.iter().filter(|case| self.entry.has_failed(case)).count()
    }

    /// Diagnoses a case. Keeps what was written, or why there is nothing, and gives the latter.
    ///
    /// # Errors
    /// [`Error::Program`] for a program that cannot be run; [`Error::File`], [`Error::Output`],
    /// [`Error::System`].
    pub fn diagnose(
        &self,
        case: &Path,
        program: &Program,
        guard: Guard,
    ) -> Result<Option<String>, Error> {
        let failed = self.failure(case, program, guard)?;
        let kept = self.entry.failure(case);
        match &failed {
            Some(reason) => write_file(&kept, reason.as_bytes())?,
            None if kept.exists() => fs::remove_file(&kept).map_err(Error::file(kept))?,
            None => {}
        }
        Ok(failed)
    }

    /// Diagnoses a case in a room, and takes what was written; or says why there is nothing.
    fn failure(
        &self,
        case: &Path,
        program: &Program,
        guard: Guard,
    ) -> Result<Option<String>, Error> {
        let room = Room::new(guard)?;
        for name in [folder::RECORDING, folder::VEHICLE] {
            room.bring(&case.join(name), name)?;
        }
        let started = Instant::now();
        let arguments =
            [folder::RECORDING, "--vehicle", folder::VEHICLE, "--held-out", HELD_OUT, "--out", OUT];
        if let Some(reason) = room.run(program, &arguments)? {
            return Ok(Some(reason));
        }
        let seconds = DIGITS.round(started.elapsed().as_secs_f64());
        if let Err(error) = Diagnosis::read(&room.out()) {
            return Ok(Some(format!("the process wrote no diagnosis\n{error}")));
        }
        let table = toml::to_string(&RunTable { seconds }).expect("a number is TOML");
        write_file(&room.out().join(RUN), table.as_bytes())?;
        Ok(room.take(&self.entry.diagnosis(case)).err().map(|error| error.to_string()))
    }
}
