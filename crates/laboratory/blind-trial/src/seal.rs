//! The commitment to answers.
//!
//! Commit first, open later: the answers exist before any diagnosis does, and their SHA-256 is
//! published with the recordings. Whoever opens them afterwards shows that they are unchanged.
//! Until then they lie elsewhere. The hash gives nothing away, because the answers begin with a
//! salt of 256 bits that comes of the key.

use crate::answer::Answers;
use crate::error::Error;
use crate::key::sha256;
use serde::{Deserialize, Serialize};
use trackdyn_core::document::Document;

/// What is published with the recordings.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Commitment {
    /// SHA-256 of the answers, salt and all, hexadecimal.
    pub answers_sha256: String,
    /// SHA-256 of `answers.sealed`, hexadecimal, of trials that have that file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sealed_sha256: Option<String>,
}

/// Answers as they are written.
///
/// # Panics
/// Never: answers hold only what TOML can say.
pub fn text(answers: &Answers) -> String {
    toml::to_string(answers).expect("numbers, texts and tables are TOML")
}

impl Commitment {
    /// The commitment to answers.
    pub fn to(text: &str) -> Self {
        Self { answers_sha256: sha256(text.as_bytes()), sealed_sha256: None }
    }

    /// Reads answers and checks that they are those that were committed to.
    ///
    /// # Errors
    /// [`Error::Broken`] where they are not; [`Error::Document`].
    pub fn open(&self, text: &str) -> Result<Answers, Error> {
        let other = "these are answers of another trial, or the commitment was changed";
        check("the answers", text.as_bytes(), &self.answers_sha256, other)?;
        Ok(Document::new("answers", text).parse()?)
    }
}

/// Compares the SHA-256 of bytes with the one that was committed to.
pub(crate) fn check(
    what: &'static str,
    bytes: &[u8],
    committed: &str,
    reason: &'static str,
) -> Result<(), Error> {
    let found = sha256(bytes);
    if found == committed {
        return Ok(());
    }
    Err(Error::Broken { what, found, committed: committed.to_owned(), reason })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::SCHEMA;
    use crate::forms::Forms;
    use crate::key::Key;

    fn answers(salt: String) -> Answers {
        Answers {
            salt,
            schema: SCHEMA.to_owned(),
            version: "1".to_owned(),
            seed: 77,
            root: None,
            run_time_s: None,
            forms: Forms::Plain,
            cases: Vec::new(),
        }
    }

    #[test]
    fn answers_open_that_were_committed_to_and_no_others() {
        let answers = answers(Key::new().salt(77));
        let committed = text(&answers);
        let commitment = Commitment::to(&committed);
        assert_eq!(commitment.open(&committed).expect("opens"), answers);
        let forged = committed.replace("seed = 77", "seed = 78");
        assert_ne!(forged, committed);
        let error = commitment.open(&forged).expect_err("other answers").to_string();
        assert!(error.contains("another trial"), "{error}");
    }

    #[test]
    fn a_commitment_says_nothing_of_answers_that_can_be_guessed() {
        let hash = |key: &Key| Commitment::to(&text(&answers(key.salt(77)))).answers_sha256;
        let key = Key::new();
        assert_eq!(hash(&key), hash(&key));
        assert_ne!(hash(&key), hash(&Key::new()));
        // the salt comes first: no shorter text of it is a line of its own
        let salt = key.salt(77);
        assert!(text(&answers(salt.clone())).starts_with(&format!("salt = \"{salt}\"\n")));
        assert_eq!(salt.len(), 64);
    }
}
