//! Answers under seal.
//!
//! Commit first, open later: the answers exist before any diagnosis does, their SHA-256 is published
//! with the recordings, and whoever opens them afterwards shows that they are the same. The sealed file
//! can lie beside the recordings because without the key it is noise; the key lies elsewhere. The
//! hash is that of the answers themselves and not of the sealed file only, so that no second key can
//! open it to other answers.
//!
//! The cipher is the ChaCha20 stream under a key of 256 bits and the hash of the answers, so that a key that is used for two
//! trials opens neither by the other.

use crate::answer::Answers;
use crate::error::Error;
use crate::key::{Key, sha256};
use serde::{Deserialize, Serialize};
use trackdyn_core::document::Document;

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
    let answers_sha256 = sha256(text.as_bytes());
    let sealed = key.apply(&answers_sha256, text.as_bytes());
    let sealed_sha256 = sha256(&sealed);
    (sealed, Commitment { answers_sha256, sealed_sha256 })
}

/// Opens sealed answers and checks that they are those that were committed to. With them comes their text.
///
/// # Errors
/// [`Error::Broken`] where they are not, or the key is another one; [`Error::Document`].
pub fn open(sealed: &[u8], key: &Key, commitment: &Commitment) -> Result<(Answers, String), Error> {
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
    let committed = &commitment.answers_sha256;
    let plain = Some(key.apply(committed, sealed)).filter(|text| sha256(text) == *committed);
    let plain = plain.unwrap_or_else(|| key.apply_alone(sealed));
    let other = "this is the key of another trial, or the commitment was changed";
    check("the opened answers", &plain, committed, other)?;
    let text = String::from_utf8_lossy(&plain).into_owned();
    Ok((Document::new("answers.sealed (opened)", text.clone()).parse()?, text))
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
            root: None,
            run_time_s: None,
            cases: Vec::new(),
        }
    }

    #[test]
    fn sealed_answers_open_with_their_key_only() {
        let key = Key::new();
        let committed = format!("{}# as it was written then\n", text(&answers()));
        let (sealed, commitment) = seal(&committed, &key);
        let opened = open(&sealed, &key, &commitment).expect("opens");
        assert_eq!(opened, (answers(), committed));
        let other = open(&sealed, &Key::new(), &commitment).expect_err("another key");
        assert!(other.to_string().contains("key of another trial"), "{other}");
        let mut changed = sealed.clone();
        changed[3] ^= 1;
        let error = open(&changed, &key, &commitment).expect_err("changed");
        assert!(error.to_string().contains("changed after it was sealed"), "{error}");
        assert!(!sealed.windows(4).any(|part| part == b"seed"));
    }

    #[test]
    fn a_key_used_twice_opens_neither_trial_by_the_other() {
        let key = Key::new();
        let texts = [text(&answers()), text(&Answers { seed: 78, ..answers() })];
        let [first, second] = texts.each_ref().map(|text| seal(text, &key).0);
        let stream = first.iter().zip(texts[0].bytes()).map(|(sealed, plain)| sealed ^ plain);
        let opened: Vec<u8> = second.iter().zip(stream).map(|(byte, key)| byte ^ key).collect();
        assert_ne!(opened, texts[1].as_bytes());
    }

    #[test]
    fn answers_sealed_by_the_key_alone_still_open() {
        let (key, text) = (Key::new(), text(&answers()));
        let sealed = key.apply_alone(text.as_bytes());
        let commitment =
            Commitment { answers_sha256: sha256(text.as_bytes()), sealed_sha256: sha256(&sealed) };
        assert_eq!(open(&sealed, &key, &commitment).expect("opens"), (answers(), text));
    }

    #[test]
    fn other_answers_do_not_fit_the_commitment_even_where_both_files_are_replaced() {
        let key = Key::new();
        let (_, commitment) = seal(&text(&answers()), &key);
        let (forged, forged_commitment) = seal(&text(&Answers { seed: 78, ..answers() }), &key);
        let half = Commitment { sealed_sha256: forged_commitment.sealed_sha256, ..commitment };
        assert!(open(&forged, &key, &half).is_err());
    }
}
