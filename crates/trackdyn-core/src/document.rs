//! TOML files that users write, and errors that point into them.

use crate::input;
use crate::lines::shortened;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::ops::Range;
use std::path::Path;
use toml::Spanned;

/// Most characters of a key, a value, a line of a file or a message about them in an error.
const MAX_SHOWN_CHARACTERS: usize = 1000;

/// A TOML text and the name under which errors mention it.
#[derive(Clone, Debug)]
pub struct Document {
    name: String,
    text: String,
}

/// A file that cannot be read, is not TOML, or holds a value that is not accepted.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DocumentError {
    /// The file cannot be read.
    #[error("{path}: cannot be read: {cause}")]
    Unreadable {
        /// Path as given.
        path: String,
        /// What the system says.
        cause: std::io::Error,
    },
    /// Not TOML, an unknown or missing key, or a value of the wrong type.
    #[error("{name}:{line}:{column}: {message}\n{excerpt}")]
    Syntax {
        /// Name of the document.
        name: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What was expected.
        message: String,
        /// The line itself.
        excerpt: String,
    },
    /// A value that is not accepted.
    #[error("{name}:{line}: {key} = {value}: expected {expected}\n{excerpt}")]
    Value {
        /// Name of the document.
        name: String,
        /// Line, from 1.
        line: usize,
        /// Key with the tables it stands in.
        key: String,
        /// The value as written.
        value: String,
        /// What was expected.
        expected: String,
        /// The line itself.
        excerpt: String,
    },
}

impl Document {
    /// Reads a file.
    ///
    /// # Errors
    /// [`DocumentError::Unreadable`].
    pub fn read(path: &Path) -> Result<Self, DocumentError> {
        let text = input::text(path).map_err(|cause| DocumentError::Unreadable {
            path: path.display().to_string(),
            cause,
        })?;
        Ok(Self::new(path.display().to_string(), text))
    }

    /// A text that is at hand.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self { name: name.into(), text: text.into() }
    }

    /// The name under which errors mention it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The text itself.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The contents as a `T`.
    ///
    /// # Errors
    /// [`DocumentError::Syntax`] with the place that does not fit.
    pub fn parse<T: DeserializeOwned>(&self) -> Result<T, DocumentError> {
        toml::from_str(&self.text).map_err(|error| {
            let start = error.span().map_or(0, |span| span.start);
            let (line, column) = self.position(start);
            DocumentError::Syntax {
                name: self.name.clone(),
                line,
                column,
                message: shortened(error.message(), MAX_SHOWN_CHARACTERS),
                excerpt: self.excerpt(line),
            }
        })
    }

    /// The contents as a `T`, if the file says that it has this schema. A file of another kind is
    /// refused by its schema, and not by the keys that it lacks.
    ///
    /// # Errors
    /// [`DocumentError::Value`] where it says otherwise; those of [`Document::parse`].
    pub fn parse_as<T: DeserializeOwned>(&self, schema: &str) -> Result<T, DocumentError> {
        let Head { schema: found } = self.parse()?;
        if found.get_ref() != schema {
            return Err(self.value_error(found.span(), "schema", format!("\"{schema}\"")));
        }
        self.parse()
    }

    /// A list of a file as so many numbers, no more and no fewer.
    ///
    /// # Errors
    /// [`DocumentError::Value`].
    pub fn numbers<const N: usize>(
        &self,
        key: &str,
        list: &Spanned<Vec<f64>>,
    ) -> Result<[f64; N], DocumentError> {
        let numbers = list.get_ref().as_slice().try_into();
        numbers.map_err(|_| self.value_error(list.span(), key, format!("{N} numbers")))
    }

    /// The error of a value that was read and is not accepted; `span` is where it stands.
    pub fn value_error(
        &self,
        span: Range<usize>,
        key: impl Into<String>,
        expected: impl Into<String>,
    ) -> DocumentError {
        let (line, _) = self.position(span.start);
        DocumentError::Value {
            name: self.name.clone(),
            line,
            key: shortened(&key.into(), MAX_SHOWN_CHARACTERS),
            value: shortened(self.text.get(span).unwrap_or_default(), MAX_SHOWN_CHARACTERS),
            expected: expected.into(),
            excerpt: self.excerpt(line),
        }
    }

    /// Line and column, from 1, of a byte offset.
    fn position(&self, offset: usize) -> (usize, usize) {
        let before = self.text.get(..offset).unwrap_or(&self.text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line = before.matches('\n').count() + 1;
        (line, before[line_start..].chars().count() + 1)
    }

    fn excerpt(&self, line: usize) -> String {
        let text =
            shortened(self.text.lines().nth(line - 1).unwrap_or_default(), MAX_SHOWN_CHARACTERS);
        format!("  |\n{line} | {text}\n  |")
    }
}

/// What the file says that it is.
#[derive(Deserialize)]
struct Head {
    schema: Spanned<String>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_from_one() {
        let document = Document::new("x.toml", "a = 1\nb = \"ü\"\nc = 3\n");
        assert_eq!(document.position(0), (1, 1));
        assert_eq!(document.position(6), (2, 1));
        // Columns count characters, not bytes.
        assert_eq!(document.position(13), (2, 7));
        assert_eq!(document.position(15), (3, 1));
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Place {
        #[serde(rename = "schema")]
        _schema: String,
        at: Spanned<Vec<f64>>,
    }

    /// Of another kind of file the first key that this one lacks says nothing.
    #[test]
    fn a_file_of_another_kind_is_called_so() {
        let read = |text: &str| Document::new("x.toml", text).parse_as::<Place>("place/1");
        let error = |text: &str| read(text).expect_err("not accepted").to_string();
        let found = error("other = 1\nschema = \"vehicle/1\"\n");
        assert!(
            found.contains("x.toml:2: schema = \"vehicle/1\": expected \"place/1\""),
            "{found}"
        );
        assert!(error("at = [1, 2]\n").contains("missing field `schema`"));
        assert!(error("schema = 1\n").contains("x.toml:1:10"));
        assert!(read("schema = \"place/1\"\nat = [1, 2]\n").is_ok());
    }

    /// A third number would be dropped, and a user would take it for known.
    #[test]
    fn a_pair_is_two_numbers() {
        let document = Document::new("x.toml", "schema = \"place/1\"\nat = [1.0, 2.0, 3.0]\n");
        let place: Place = document.parse().expect("a place");
        assert!(document.numbers::<3>("at", &place.at).is_ok());
        let error = document.numbers::<2>("at", &place.at).expect_err("three").to_string();
        assert!(error.contains("x.toml:2: at = [1.0, 2.0, 3.0]: expected 2 numbers"), "{error}");
    }
}
