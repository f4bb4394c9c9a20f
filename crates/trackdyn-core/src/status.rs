//! What a diagnosis says in a word: the diagnosis writes it, and who judges diagnoses reads it.

use serde::{Deserialize, Serialize};

/// What a diagnosis says in a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// What was left out is named.
    Explained,
    /// Nothing that the evidence could show was left out.
    NothingMissing,
    /// Something is missing that several effects explain alike.
    Ambiguous,
    /// Something is there that the catalogue does not explain.
    Unexplained,
}

impl Status {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::Explained, Self::NothingMissing, Self::Ambiguous, Self::Unexplained];

    /// Its word in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Explained => "explained",
            Self::NothingMissing => "nothing-missing",
            Self::Ambiguous => "ambiguous",
            Self::Unexplained => "unexplained",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Status;

    #[test]
    fn its_word_reads_back() {
        #[derive(serde::Serialize, serde::Deserialize)]
        struct File {
            status: Status,
        }
        for status in Status::ALL {
            let text = toml::to_string(&File { status }).expect("a table");
            assert_eq!(text, format!("status = \"{}\"\n", status.name()));
            assert_eq!(toml::from_str::<File>(&text).expect("reads").status, status);
        }
    }
}
