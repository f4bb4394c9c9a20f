//! Programs that are put to a trial.

use crate::diagnosis;
use crate::error::Error;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Folder for what this project's own diagnosis of a case writes.
pub const DIAGNOSIS: &str = "diagnosis";
/// Largest number of letters of a name.
const MAX_NAME_LENGTH: usize = 40;

/// A program that is put to a trial, by the name under which its diagnoses are kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry(String);

impl Entry {
    /// Name of this project's own diagnosis.
    pub const OWN_NAME: &str = "trackdyn";

    /// Its name.
    pub fn name(&self) -> &str {
        &self.0
    }

    /// What it wrote of a case, in the folder of the case.
    pub fn diagnosis(&self, case: &Path) -> PathBuf {
        case.join(self.qualified(DIAGNOSIS, ""))
    }

    /// Whether there is a diagnosis of a case.
    pub fn has_diagnosed(&self, case: &Path) -> bool {
        self.diagnosis(case).join(diagnosis::FILE).exists()
    }

    /// Whether it failed at a case.
    pub fn has_failed(&self, case: &Path) -> bool {
        self.failure(case).exists()
    }

    /// Why it failed at a case, in the folder of the case.
    pub fn failure(&self, case: &Path) -> PathBuf {
        case.join(self.qualified("failure", ".txt"))
    }

    fn qualified(&self, stem: &str, extension: &str) -> String {
        if self.0 == Self::OWN_NAME {
            format!("{stem}{extension}")
        } else {
            format!("{stem}.{}{extension}", self.0)
        }
    }
}

impl Default for Entry {
    fn default() -> Self {
        Self(Self::OWN_NAME.to_owned())
    }
}

impl FromStr for Entry {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        let sign = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        if (1..=MAX_NAME_LENGTH).contains(&name.len()) && name.chars().all(sign) {
            return Ok(Self(name.to_owned()));
        }
        Err(Error::Option {
            name: "name",
            value: name.to_owned(),
            expected: "1 to 40 letters, digits, - and _",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_program_has_places_of_its_own() {
        let (own, other) = (Entry::default(), "stepwise".parse::<Entry>().expect("a name"));
        let case = Path::new("case-0001");
        assert_eq!(own.diagnosis(case), case.join("diagnosis"));
        assert_eq!(other.diagnosis(case), case.join("diagnosis.stepwise"));
        assert_eq!(other.failure(case), case.join("failure.stepwise.txt"));
        assert_eq!("trackdyn".parse::<Entry>().expect("a name"), own);
        for name in ["", "../x", "a b", "a.b"] {
            assert!(name.parse::<Entry>().is_err(), "{name}");
        }
    }
}
