//! Keys of trials, and what comes of one.

use crate::error::Error;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fmt::Write;
use std::path::Path;
use trackdyn_core::input;
use trackdyn_core::output::write_private;

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
        let text = input::text(path).map_err(Error::file(path))?;
        let bytes = bytes(text.trim()).ok_or_else(|| Error::Key { path: path.to_owned() })?;
        Ok(Self(bytes))
    }

    /// Writes the key file, which nobody but its owner reads.
    ///
    /// # Errors
    /// [`Error::Output`].
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        Ok(write_private(path, format!("{}\n", hexadecimal(&self.0)).as_bytes())?)
    }

    /// What a trial with this seed and key is drawn from: SHA-256 of both.
    pub fn root(&self, seed: u64) -> Root {
        let digest = Sha256::new().chain_update("trackdyn trial").chain_update(seed.to_le_bytes());
        Root(digest.chain_update(self.0).finalize().into())
    }

    /// What the answers of a trial with this seed begin with, so that their hash cannot be guessed:
    /// SHA-256 of both, hexadecimal.
    pub fn salt(&self, seed: u64) -> String {
        let digest = Sha256::new().chain_update("trackdyn salt").chain_update(seed.to_le_bytes());
        hexadecimal(&digest.chain_update(self.0).finalize())
    }

    pub(crate) fn bytes(&self) -> &[u8; 32] {
        &self.0
    }
}

impl Default for Key {
    fn default() -> Self {
        Self::new()
    }
}

/// What all numbers of a trial are drawn from.
///
/// Recordings and vehicle files show some of them, the gauge for one. A seed is short enough to be
/// tried out, and all that is concealed would follow from it. The key is not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Root([u8; 32]);

impl Root {
    /// That of a seed alone: of trials whose answers name no other.
    pub fn of_seed(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed).get_seed())
    }

    /// Random numbers, in streams that are told apart by a number.
    pub(crate) fn stream(&self, number: u64) -> ChaCha8Rng {
        let mut random = ChaCha8Rng::from_seed(self.0);
        random.set_stream(number);
        random
    }
}

impl From<Root> for String {
    fn from(root: Root) -> Self {
        hexadecimal(&root.0)
    }
}

impl TryFrom<String> for Root {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        bytes(&text).map(Self).ok_or("expected 64 hexadecimal digits")
    }
}

/// SHA-256, hexadecimal.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::with_capacity(2 * bytes.len()), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

fn bytes(text: &str) -> Option<[u8; 32]> {
    let mut bytes = [0; 32];
    if text.len() != 64 || !text.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    for (place, byte) in bytes.iter_mut().enumerate() {
        *byte = u8::from_str_radix(&text[2 * place..2 * place + 2], 16).ok()?;
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::RngExt;

    #[test]
    fn a_key_survives_its_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let (path, key) = (folder.path().join("x.key"), Key::new());
        key.write(&path).expect("written");
        assert!(Key::read(&path).expect("read") == key);
        for other in ["0123", &"+f".repeat(32)] {
            std::fs::write(&path, other).expect("written");
            assert!(matches!(Key::read(&path), Err(Error::Key { .. })), "{other}");
        }
    }

    #[test]
    fn what_is_drawn_goes_by_seed_and_key() {
        let keys = [Key([1; 32]), Key([2; 32])];
        let draw = |root: Root| root.stream(3).random::<u64>();
        let drawn = |key: &Key, seed| draw(key.root(seed));
        assert_eq!(drawn(&keys[0], 5), drawn(&keys[0], 5));
        assert_ne!(drawn(&keys[0], 5), drawn(&keys[1], 5));
        assert_ne!(drawn(&keys[0], 5), drawn(&keys[0], 6));
        assert_ne!(drawn(&keys[0], 5), draw(Root::of_seed(5)));
        let text = String::from(keys[0].root(5));
        assert_eq!(Root::try_from(text), Ok(keys[0].root(5)));
        assert!(Root::try_from("12".to_owned()).is_err());
    }
}
