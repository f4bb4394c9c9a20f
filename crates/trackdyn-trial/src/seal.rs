//! Answers under seal.
//!
//! Commit first, open later: the answers exist before any diagnosis does, their SHA-256 is published
//! with the recordings, and whoever opens them afterwards shows that they are the same. The sealed file
//! can lie beside the recordings because without the key it is noise; the key lies elsewhere. The
//! hash is that of the answers themselves and not of the sealed file only, so that no second key can
//! open it to other answers.
//!
//! The cipher is the ChaCha20 stream under a key of 256 bits that is used once.

use crate::answer::Answers;
use crate::error::Error;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha20Rng;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fmt::Write;
use std::path::Path;
use trackdyn_core::document::Document;
use trackdyn_core::output::write_file;

/// The key of a trial.
#[derive(Clone, PartialEq, Eq)]
pub struct Key([u8; 32]);

impl Key {
    /// A key that the system draws; no seed leads to it.
    pub fn new() -> Self {
        Self(rand::random())
    }

    /// Reads a key file: 64 hexadecimal digits.
    ///
    /// # Errors
    /// [`Error::File`], [`Error::Key`].
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text = std::fs::read_to_string(path).map_err(Error::file(path))?;
        Self::parse(text.trim()).ok_or_else(|| Error::Key { path: path.to_owned() })
    }

    fn parse(text: &str) -> Option<Self> {
        let mut key = [0; 32];
        if text.len() != 64 || !text.is_ascii() {
            return None;
        }
        for (place, byte) in key.iter_mut().enumerate() {
            *byte = u8::from_str_radix(&text[2 * place..2 * place + 2], 16).ok()?;
        }
        Some(Self(key))
    }

    /// Writes the key file.
    ///
    /// # Errors
    /// [`Error::Output`].
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        Ok(write_file(path, format!("{}\n", hexadecimal(&self.0)).as_bytes())?)
    }

    /// Adds the key's stream to bytes; twice gives them back.
    fn apply(&self, bytes: &[u8]) -> Vec<u8> {
        let mut stream = vec![0; bytes.len()];
        ChaCha20Rng::from_seed(self.0).fill_bytes(&mut stream);
        bytes.iter().zip(stream).map(|(byte, key)| byte ^ key).collect()
    }
}

impl Default for Key {
    fn default() -> Self {
        Self::new()
    }
}

/// What is published with the recordings.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Commitment {
    /// SHA-256 of the answers, hexadecimal.
    pub answers_sha256: String,
    /// SHA-256 of `answers.sealed`, hexadecimal.
    pub sealed_sha256: String,
}

/// Answers as they are written.
///
/// # Panics
/// Never: answers hold only what TOML can say.
pub fn text(answers: &Answers) -> String {
    toml::to_string(answers).expect("numbers, texts and tables are TOML")
}

/// Seals a text: the sealed bytes, and the commitment to both.
pub fn seal(text: &str, key: &Key) -> (Vec<u8>, Commitment) {
    let sealed = key.apply(text.as_bytes());
    let commitment =
        Commitment { answers_sha256: sha256(text.as_bytes()), sealed_sha256: sha256(&sealed) };
    (sealed, commitment)
}

/// Opens sealed answers and checks that they are those that were committed to.
///
/// # Errors
/// [`Error::Broken`] where they are not, or the key is another one; [`Error::Document`].
pub fn open(sealed: &[u8], key: &Key, commitment: &Commitment) -> Result<Answers, Error> {
    let check = |what, bytes: &[u8], committed: &str, reason| {
        let found = sha256(bytes);
        let committed = committed.to_owned();
        if found == committed {
            Ok(())
        } else {
            Err(Error::Broken { what, found, committed, reason })
        }
    };
    let changed = "the file was changed after it was sealed";
    check("answers.sealed", sealed, &commitment.sealed_sha256, changed)?;
    let plain = key.apply(sealed);
    let other = "this is the key of another trial, or the commitment was changed";
    check("the opened answers", &plain, &commitment.answers_sha256, other)?;
    let text = String::from_utf8_lossy(&plain).into_owned();
    Ok(Document::new("answers.sealed (opened)", text).parse()?)
}

fn sha256(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::with_capacity(2 * bytes.len()), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::SCHEMA;

    fn answers() -> Answers {
        Answers {
            schema: SCHEMA.to_owned(),
            version: "1".to_owned(),
            seed: 77,
            run_time_s: None,
            cases: Vec::new(),
        }
    }

    #[test]
    fn sealed_answers_open_with_their_key_only() {
        let key = Key::new();
        let (sealed, commitment) = seal(&text(&answers()), &key);
        assert_eq!(open(&sealed, &key, &commitment).expect("opens"), answers());
        let other = open(&sealed, &Key::new(), &commitment).expect_err("another key");
        assert!(other.to_string().contains("key of another trial"), "{other}");
        let mut changed = sealed.clone();
        changed[3] ^= 1;
        let error = open(&changed, &key, &commitment).expect_err("changed");
        assert!(error.to_string().contains("changed after it was sealed"), "{error}");
        assert!(!sealed.windows(4).any(|part| part == b"seed"));
    }

    #[test]
    fn other_answers_do_not_fit_the_commitment_even_where_both_files_are_replaced() {
        let key = Key::new();
        let (_, commitment) = seal(&text(&answers()), &key);
        let (forged, forged_commitment) = seal(&text(&Answers { seed: 78, ..answers() }), &key);
        let half = Commitment { sealed_sha256: forged_commitment.sealed_sha256, ..commitment };
        assert!(open(&forged, &key, &half).is_err());
    }

    #[test]
    fn a_key_survives_its_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let (path, key) = (folder.path().join("x.key"), Key::new());
        key.write(&path).expect("written");
        assert!(Key::read(&path).expect("read") == key);
        std::fs::write(&path, "0123").expect("written");
        assert!(matches!(Key::read(&path), Err(Error::Key { .. })));
    }
}
