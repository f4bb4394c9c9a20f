//! A trial in the making, beside its key: what is finished survives an interruption.
//!
//! ```text
//! KEY.making/order.toml
//! KEY.making/case-0001/{answer.toml, vehicle.toml, recording/...}
//! ```
//!
//! Answers and seed lie with the key and never in the trial's folder. That is filled when all cases are
//! there, in the order of their numbers: neither its places on the disk nor the times at which files came
//! to be say how long a case took, and an interrupted trial is the same as any other.

use crate::answer::{Answer, Answers, SCHEMA};
use crate::case::{self, Case};
use crate::error::Error;
use crate::folder;
use crate::order::Order;
use crate::seal::{Commitment, Key};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use trackdyn_core::document::Document;
use trackdyn_core::output::{prepare_folder, write_file};

/// What was asked for.
const ORDER: &str = "order.toml";
/// The answer of a case.
const ANSWER: &str = "answer.toml";

/// A trial in the making.
#[derive(Debug)]
pub struct Draft {
    folder: PathBuf,
    key: PathBuf,
    order: Order,
}

impl Draft {
    /// Begins a trial whose key will be written to `key`, or takes up the one that was begun there.
    ///
    /// # Errors
    /// [`Error::Made`] where the trial or the key is there already, [`Error::OtherOrder`] where what was
    /// begun is another trial; [`Error::Output`], [`Error::Document`].
    ///
    /// # Panics
    /// Never: an order is TOML.
    pub fn begin(trial: &Path, key: &Path, order: &Order) -> Result<Self, Error> {
        let mut name = OsString::from(key);
        name.push(".making");
        let draft = Self { folder: name.into(), key: key.to_owned(), order: order.clone() };
        let path = draft.folder.join(ORDER);
        if path.exists() {
            let begun: Order = Document::read(&path)?.parse()?;
            if begun != *order {
                let (begun, asked) = (begun.to_string(), order.to_string());
                return Err(Error::OtherOrder { folder: draft.folder, begun, asked });
            }
            return Ok(draft);
        }
        let there = [trial.join(folder::SEALED), key.to_owned()].into_iter().find(|p| p.exists());
        let has_cases = || folder::cases(trial).is_ok_and(|cases| !cases.is_empty());
        if let Some(path) = there.or_else(|| has_cases().then(|| trial.to_owned())) {
            return Err(Error::Made { path });
        }
        prepare_folder(trial)?;
        prepare_folder(&draft.folder)?;
        let text = toml::to_string(order).expect("numbers and texts are TOML");
        write_file(&path, text.as_bytes())?;
        Ok(draft)
    }

    /// Whether the case of a number (from 0) is there.
    pub fn has(&self, number: u64) -> bool {
        self.folder.join(case::name(number)).exists()
    }

    /// Keeps a case: whole, or not at all.
    ///
    /// # Errors
    /// [`Error::Output`], [`Error::Recording`], [`Error::File`].
    ///
    /// # Panics
    /// Never: an answer is TOML.
    pub fn keep(&self, case: &Case) -> Result<(), Error> {
        folder::place(&self.folder, &case.answer.id, |home| {
            folder::write_case(home, case)?;
            let answer = Answer { files: folder::fingerprint_of(home)?, ..case.answer.clone() };
            let text = toml::to_string(&answer).expect("numbers, texts and tables are TOML");
            Ok(write_file(&home.join(ANSWER), text.as_bytes())?)
        })
    }

    /// Writes cases, sealed answers and commitment to the trial's folder, then the key, and is gone.
    ///
    /// # Errors
    /// [`Error::File`], [`Error::Document`] where a case is not there; [`Error::Output`].
    pub fn publish(self, trial: &Path) -> Result<(Answers, Commitment), Error> {
        prepare_folder(trial)?;
        let numbers = (0..).take(self.order.cases);
        let cases = numbers.map(|number| {
            let id = case::name(number);
            let kept = self.folder.join(&id);
            let answer: Answer = Document::read(&kept.join(ANSWER))?.parse()?;
            if !trial.join(&id).exists() {
                folder::place(trial, &id, |home| folder::copy_case(&kept, home))?;
            }
            Ok(answer)
        });
        let answers = Answers {
            schema: SCHEMA.to_owned(),
            version: self.order.version.clone(),
            seed: self.order.seed,
            run_time_s: self.order.unusual_run_time(),
            cases: cases.collect::<Result<_, Error>>()?,
        };
        let key = if self.key.exists() { Key::read(&self.key)? } else { Key::new() };
        key.write(&self.key)?;
        let commitment = folder::write_answers(trial, &answers, &key)?;
        fs::remove_dir_all(&self.folder).map_err(Error::file(self.folder))?;
        Ok((answers, commitment))
    }
}
