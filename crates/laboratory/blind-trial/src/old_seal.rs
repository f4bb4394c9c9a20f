//! Answers that were sealed until November 2026: read, and never written again.
//!
//! They lie in `answers.sealed` beside the recordings, combined with a ChaCha20 stream. Its seed is
//! the SHA-256 of the key and the hash of the answers; of the first forty trials it is the key
//! alone. The commitment holds the hashes of the answers and of the sealed file.

use crate::error::Error;
use crate::key::{Key, sha256};
use crate::seal::{Commitment, check};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha20Rng;
use sha2::{Digest, Sha256};

/// The text of sealed answers, which is the one that was committed to.
///
/// # Errors
/// [`Error::Broken`] where it is not, or the key is another one.
pub(crate) fn unseal(sealed: &[u8], key: &Key, commitment: &Commitment) -> Result<String, Error> {
    let changed = "the file was changed after it was sealed";
    let of_file = commitment.sealed_sha256.as_deref().unwrap_or_default();
    check("answers.sealed", sealed, of_file, changed)?;
    let committed = &commitment.answers_sha256;
    let digest = Sha256::new().chain_update("trackdyn seal").chain_update(key.bytes());
    let seed = digest.chain_update(committed).finalize().into();
    let text = Some(add_stream(seed, sealed)).filter(|text| sha256(text) == *committed);
    let text = text.unwrap_or_else(|| add_stream(*key.bytes(), sealed));
    let other = "this is the key of another trial, or the commitment was changed";
    check("the opened answers", &text, committed, other)?;
    Ok(String::from_utf8_lossy(&text).into_owned())
}

/// Adds a ChaCha20 stream to bytes; twice gives them back.
fn add_stream(seed: [u8; 32], bytes: &[u8]) -> Vec<u8> {
    let mut stream = vec![0; bytes.len()];
    ChaCha20Rng::from_seed(seed).fill_bytes(&mut stream);
    bytes.iter().zip(stream).map(|(byte, key)| byte ^ key).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Stratum;
    use std::path::Path;

    /// A trial of one case that the program of November 2026 made, with its key.
    const SEALED_TRIAL: &[u8] = include_bytes!("../fixtures/old-seal/answers.sealed");
    const COMMITMENT: &str = include_str!("../fixtures/old-seal/commitment.txt");
    const KEY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/old-seal/answers.key");

    fn commitment() -> Commitment {
        toml::from_str(COMMITMENT).expect("a commitment")
    }

    fn key() -> Key {
        Key::read(Path::new(KEY)).expect("a key")
    }

    #[test]
    fn answers_that_were_sealed_then_open_with_their_key_only() {
        let text = unseal(SEALED_TRIAL, &key(), &commitment()).expect("opens");
        let answers = commitment().open(&text).expect("answers");
        assert_eq!((answers.seed, answers.cases.len()), (6, 1));
        assert_eq!(answers.cases[0].stratum, Stratum::PlainNull);
        assert!(answers.salt.is_empty());
        let other = unseal(SEALED_TRIAL, &Key::new(), &commitment()).expect_err("another key");
        assert!(other.to_string().contains("key of another trial"), "{other}");
        let mut changed = SEALED_TRIAL.to_vec();
        changed[3] ^= 1;
        let error = unseal(&changed, &key(), &commitment()).expect_err("changed");
        assert!(error.to_string().contains("changed after it was sealed"), "{error}");
    }

    #[test]
    fn answers_that_were_sealed_by_the_key_alone_open() {
        let text = unseal(SEALED_TRIAL, &key(), &commitment()).expect("opens");
        let sealed = add_stream(*key().bytes(), text.as_bytes());
        let of_file = Commitment { sealed_sha256: Some(sha256(&sealed)), ..commitment() };
        assert_eq!(unseal(&sealed, &key(), &of_file).expect("opens"), text);
    }
}
