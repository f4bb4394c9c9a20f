//! Trials whose answers are open, to be scored by themselves or together.

use crate::answer::Answers;
use crate::entry::Entry;
use crate::error::Error;
use crate::folder;
use crate::key::sha256;
use crate::score::Judged;
use std::path::{Path, PathBuf};
use trackdyn_core::output::fingerprint;

/// One trial, or several of one kind that count as one.
#[derive(Clone, Debug)]
pub struct Opened {
    trials: Vec<Trial>,
}

#[derive(Clone, Debug)]
struct Trial {
    folder: PathBuf,
    answers: Answers,
    /// The text that was committed to.
    text: String,
}

impl Opened {
    /// Opens trials, each a folder with the file of its key.
    ///
    /// # Errors
    /// Those of [`folder::open_answers`]; [`Error::Option`] where a trial comes twice, or where
    /// runs have another length than in the first.
    pub fn open<'a>(trials: impl IntoIterator<Item = (&'a Path, PathBuf)>) -> Result<Self, Error> {
        let mut opened = Self { trials: Vec::new() };
        for (folder, key) in trials {
            let (answers, text) = folder::open_answers(folder, &key)?;
            opened.add(Trial { folder: folder.to_owned(), answers, text })?;
        }
        Ok(opened)
    }

    /// SHA-256 of the answers of each trial, hexadecimal.
    pub fn hashes(&self) -> Vec<String> {
        self.trials.iter().map(|trial| sha256(trial.text.as_bytes())).collect()
    }

    /// Compares the answers with hashes that were published elsewhere, in the order of the trials:
    /// files of one folder may all be replaced.
    ///
    /// # Errors
    /// [`Error::Broken`].
    pub fn check(&self, published: &[String]) -> Result<(), Error> {
        for (found, published) in self.hashes().into_iter().zip(published) {
            if found != published.to_ascii_lowercase() {
                return Err(Error::Broken {
                    what: "the opened answers",
                    found,
                    committed: published.clone(),
                    reason: "these are not the answers that were committed to elsewhere",
                });
            }
        }
        Ok(())
    }

    fn add(&mut self, trial: Trial) -> Result<(), Error> {
        let refused = |expected| {
            let value = trial.folder.display().to_string();
            Err(Error::Option { name: "trial", value, expected })
        };
        if self.trials.iter().any(|other| other.text == trial.text) {
            return refused("each trial once: its cases would count twice");
        }
        let run_time = |trial: &Trial| trial.answers.run_time_s;
        if self.trials.first().is_some_and(|first| run_time(first) != run_time(&trial)) {
            return refused("trials with runs of one length: others cannot be compared");
        }
        self.trials.push(trial);
        Ok(())
    }

    /// The cases of all trials beside what came back of them from a program.
    ///
    /// Cases of several trials are called by the hash of their answers and their name there, as
    /// `8e5c0b8d/case-0001`.
    ///
    /// # Errors
    /// Those of [`folder::judge`].
    pub fn judge(&self, entry: &Entry) -> Result<Vec<Judged>, Error> {
        let mut judged = Vec::new();
        for trial in &self.trials {
            let mut cases = folder::judge(&trial.folder, &trial.answers, entry)?;
            if self.trials.len() > 1 {
                let hash = trial.hash();
                for case in &mut cases {
                    case.answer.id = format!("{hash}/{}", case.answer.id);
                }
            }
            judged.extend(cases);
        }
        Ok(judged)
    }

    /// The opened answers, with names for their files.
    pub fn texts(&self) -> Vec<(String, &str)> {
        let name = |trial: &Trial| match self.trials.as_slice() {
            [_] => "answers.toml".to_owned(),
            _ => format!("answers-{}.toml", trial.hash()),
        };
        self.trials.iter().map(|trial| (name(trial), trial.text.as_str())).collect()
    }
}

impl Trial {
    /// The first digits of the hash of its answers.
    fn hash(&self) -> String {
        fingerprint(self.text.as_bytes())[..8].to_owned()
    }
}

/// Numbers of cases and hashes, for captions.
impl std::fmt::Display for Opened {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let list = |of: &dyn Fn(&Trial) -> String| {
            self.trials.iter().map(of).collect::<Vec<_>>().join(" and ")
        };
        write!(
            f,
            "trial of {} cases, SHA-256 of the answers {}",
            list(&|trial| trial.answers.cases.len().to_string()),
            list(&|trial| format!("{}…", fingerprint(trial.text.as_bytes())))
        )
    }
}
