//! A trial in the making, beside its key: what is finished survives an interruption.
//!
//! ```text
//! KEY.making/order.toml
//! KEY.making/case-0001/{answer.toml, vehicle.toml, recording/...}
//! ```
//!
//! Answers and seed lie with the key, which is drawn first, and never in the trial's folder. That
//! is filled when all cases are there, in the order of their numbers. So neither its places on the
//! disk nor the times of its files say how long a case took, and an interrupted trial looks like
//! any other.

use crate::answer::{Answer, Answers, SCHEMA};
use crate::case::{self, Case};
use crate::error::Error;
use crate::folder;
use crate::key::{Key, Root};
use crate::order::Order;
use crate::seal::Commitment;
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
pub struct Draft {
    folder: PathBuf,
    key_file: PathBuf,
    key: Key,
    order: Order,
}

impl Draft {
    /// Begins a trial with the key in a file, or with a new one that is written to it; or takes up
    /// what was begun there.
    ///
    /// With the key and the order of a trial it is made once more, byte for byte.
    ///
    /// # Errors
    /// [`Error::Made`] where another trial is there already, [`Error::OtherOrder`] where what was
    /// begun is another trial; [`Error::Output`], [`Error::Document`], [`Error::File`],
    /// [`Error::Key`].
    ///
    /// # Panics
    /// Never: an order is TOML.
    pub fn begin(trial: &Path, key: &Path, order: &Order) -> Result<Self, Error> {
        let mut name = OsString::from(key);
        name.push(".making");
        let folder = PathBuf::from(name);
        let path = folder.join(ORDER);
        if path.exists() {
            let begun: Order = Document::read(&path)?.parse()?;
            if begun != *order {
                let (begun, asked) = (begun.to_string(), order.to_string());
                return Err(Error::OtherOrder { folder, begun, asked });
            }
            let is_other = folder::is_made(trial) && folder::open_answers(trial, key).is_err();
            if is_other {
                return Err(Error::Made { path: trial.to_owned() });
            }
            return Ok(Self {
                folder,
                key: Key::read(key)?,
                key_file: key.to_owned(),
                order: begun,
            });
        }
        if folder::is_made(trial) || folder::cases(trial).is_ok() {
            return Err(Error::Made { path: trial.to_owned() });
        }
        prepare_folder(trial)?;
        prepare_folder(&folder)?;
        let drawn = if key.exists() {
            Key::read(key)?
        } else {
            let drawn = Key::new();
            drawn.write(key)?;
            drawn
        };
        let text = toml::to_string(order).expect("numbers and texts are TOML");
        write_file(&path, text.as_bytes())?;
        Ok(Self { folder, key: drawn, key_file: key.to_owned(), order: order.clone() })
    }

    /// What its cases are drawn from.
    pub fn root(&self) -> Root {
        self.key.root(self.order.seed)
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

    /// Writes cases and commitment to the trial's folder and the answers beside the key, and is
    /// gone.
    ///
    /// # Errors
    /// [`Error::Made`] where a case of another trial is there; [`Error::File`], [`Error::Document`]
    /// where one is not finished; [`Error::Output`].
    pub fn publish(self, trial: &Path) -> Result<(Answers, Commitment), Error> {
        prepare_folder(trial)?;
        let numbers = (0..).take(self.order.cases);
        let cases = numbers.map(|number| {
            let id = case::name(number);
            let (kept, there) = (self.folder.join(&id), trial.join(&id));
            let answer: Answer = Document::read(&kept.join(ANSWER))?.parse()?;
            if !there.exists() {
                folder::place(trial, &id, |home| folder::copy_case(&kept, home))?;
            } else if folder::fingerprint_of(&there)? != answer.files {
                return Err(Error::Made { path: there });
            }
            Ok(answer)
        });
        let answers = Answers {
            salt: self.key.salt(self.order.seed),
            schema: SCHEMA.to_owned(),
            version: self.order.version.clone(),
            seed: self.order.seed,
            root: Some(self.root()),
            run_time_s: self.order.unusual_run_time(),
            forms: self.order.forms,
            cases: cases.collect::<Result<_, Error>>()?,
        };
        let commitment = folder::write_answers(trial, &answers, &self.key_file)?;
        fs::remove_dir_all(&self.folder).map_err(Error::file(self.folder))?;
        Ok((answers, commitment))
    }
}
