//! Which forms the laws of a trial have.

use crate::random::whole;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};
use trackdyn_second_simulator::{Form, Sheet};

/// Which forms the laws of a trial have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Forms {
    /// One for each law, as in trials until November 2026. Answers that state none have these.
    #[default]
    Plain,
    /// One for each case, drawn from the family of the law.
    Drawn,
}

impl Forms {
    /// Whether each law has one form.
    pub fn is_plain(&self) -> bool {
        *self == Self::Plain
    }

    /// A form of a law.
    pub(crate) fn draw(self, sheet: &Sheet, random: &mut ChaCha8Rng) -> Form {
        match self {
            Self::Drawn if sheet.family.is_some() => Form::Drawn(whole(random)),
            Self::Plain | Self::Drawn => Form::Plain,
        }
    }
}

/// As in options and files.
impl std::fmt::Display for Forms {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Plain => "plain",
            Self::Drawn => "drawn",
        })
    }
}
