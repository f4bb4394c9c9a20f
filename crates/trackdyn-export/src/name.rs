//! Names of frames, joints and links.

use crate::Error;
use std::fmt;
use std::str::FromStr;

/// A name that stands in YAML, XML and Python as it is: letters, digits, `_`, `-`, `.` and `/`, with a
/// letter or `_` first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name(String);

impl FromStr for Name {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let begins = text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
        let allowed = |c: char| c.is_ascii_alphanumeric() || "_-./".contains(c);
        if begins && text.chars().all(allowed) {
            Ok(Self(text.to_owned()))
        } else {
            Err(Error::Name { value: text.to_owned() })
        }
    }
}

impl fmt::Display for Name {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_need_no_quotes_anywhere() {
        for name in ["base_link", "robot-1/base.link", "_a"] {
            assert_eq!(name.parse::<Name>().expect("a name").to_string(), name);
        }
        for name in ["", "/base_link", "1st", "a b", "a\"b", "a:", "a<b", "ä"] {
            assert!(name.parse::<Name>().is_err(), "{name}");
        }
    }
}
