//! Names of frames, joints and links.

use crate::Error;
use std::fmt;
use std::str::FromStr;

/// A name that stands in YAML, XML and Python as it is: letters, digits, `_`, `-`, `.` and `/`,
/// with a letter or `_` first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name(String);

impl FromStr for Name {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let name = word(text, "-./").map(Self);
        name.ok_or_else(|| Error::Name { value: text.to_owned() })
    }
}

impl Name {
    /// Refuses names of which one stands twice among those of both sides.
    pub(crate) fn all_differ(
        option: &'static str,
        left: &[Self],
        right: &[Self],
    ) -> Result<(), Error> {
        let all: Vec<&Self> = left.iter().chain(right).collect();
        let twice = (0..all.len()).find(|&k| all[..k].contains(&all[k]));
        twice.map_or(Ok(()), |k| Err(Error::Repeated { option, name: all[k].to_string() }))
    }
}

/// A name of a ROS node: letters, digits and `_`, with a letter or `_` first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NodeName(String);

impl FromStr for NodeName {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let name = word(text, "").map(Self);
        name.ok_or_else(|| Error::NodeName { value: text.to_owned() })
    }
}

impl fmt::Display for NodeName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0)
    }
}

impl fmt::Display for Name {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0)
    }
}

/// A text of letters, digits, `_` and some signs `beside` these, with a letter or `_` first.
fn word(text: &str, beside: &str) -> Option<String> {
    let begins = text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '_' || beside.contains(c);
    (begins && text.chars().all(allowed)).then(|| text.to_owned())
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
        assert_eq!("diff_1".parse::<NodeName>().expect("a name").to_string(), "diff_1");
        for name in ["", "my-ctrl", "a.b", "a/b", "1st"] {
            assert!(name.parse::<NodeName>().is_err(), "{name}");
        }
    }

    #[test]
    fn no_part_is_driven_twice() {
        let names = |names: &[&str]| -> Vec<Name> {
            names.iter().map(|name| name.parse().expect("a name")).collect()
        };
        let differ = |left: &[&str], right: &[&str]| {
            Name::all_differ("left-wheel", &names(left), &names(right))
        };
        assert!(differ(&["a", "b"], &["c", "d"]).is_ok());
        assert!(differ(&["a"], &["a"]).is_err() && differ(&["a", "a"], &["b", "c"]).is_err());
    }
}
