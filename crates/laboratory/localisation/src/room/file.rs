//! The room file, schema `trackdyn.room/1`.

use super::{Outline, Room};
use crate::Error;
use serde::{Deserialize, Serialize};
use std::path::Path;
use toml::Spanned;
use trackdyn_core::document::{Document, DocumentError};
use trackdyn_core::output::write_file;

const SCHEMA: &str = "trackdyn.room/1";

impl Room {
    /// A laboratory of 10 m x 8 m with a corridor, desks and boxes, as in
    /// `configs/rooms/furnished.toml`.
    ///
    /// # Panics
    /// Never: the file is part of the program, and a test reads it.
    pub fn furnished() -> Self {
        embedded("furnished", include_str!("../../../../../configs/rooms/furnished.toml"))
    }

    /// A corridor of which a laser in its middle sees no end, as in `configs/rooms/corridor.toml`.
    ///
    /// # Panics
    /// Never: the file is part of the program, and a test reads it.
    pub fn corridor() -> Self {
        embedded("corridor", include_str!("../../../../../configs/rooms/corridor.toml"))
    }

    /// Reads and checks a room file.
    ///
    /// # Errors
    /// A [`DocumentError`] that points at the line and key.
    pub fn from_document(document: &Document) -> Result<Self, DocumentError> {
        let tables: Tables = document.parse_as(SCHEMA)?;
        let mut outlines = Vec::with_capacity(tables.outline.len());
        for (index, table) in tables.outline.into_iter().enumerate() {
            let span = table.corners_m.span();
            let outline = Outline {
                name: table.name,
                corners: table.corners_m.into_inner(),
                closed: table.closed,
            };
            if let Err(problem) = outline.check() {
                let expected = match problem {
                    Error::Outline { found, expected, .. } => format!("{expected}, not {found}"),
                    other => other.to_string(),
                };
                let key = format!("outline[{index}].corners_m");
                return Err(document.value_error(span, key, expected));
            }
            outlines.push(outline);
        }
        let segments = outlines.iter().flat_map(Outline::segments).collect();
        Ok(Self { name: tables.name, outlines, segments })
    }

    /// The file's text: equal rooms have equal texts.
    ///
    /// # Panics
    /// Never: the tables hold only what TOML can say.
    pub fn to_toml(&self) -> String {
        let outline = self.outlines.iter().map(|outline| OutlineTable {
            name: outline.name.clone(),
            corners_m: Spanned::new(0..0, outline.corners.clone()),
            closed: outline.closed,
        });
        let tables = Tables {
            schema: Spanned::new(0..0, SCHEMA.to_owned()),
            name: self.name.clone(),
            outline: outline.collect(),
        };
        toml::to_string(&tables).expect("numbers, texts and tables are TOML")
    }

    /// Reads a room file.
    ///
    /// # Errors
    /// [`Error::Document`], with the line and key.
    pub fn read(path: &Path) -> Result<Self, Error> {
        Ok(Self::from_document(&Document::read(path)?)?)
    }

    /// Writes a room file.
    ///
    /// # Errors
    /// [`Error::Output`].
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        Ok(write_file(path, self.to_toml().as_bytes())?)
    }
}

fn embedded(name: &str, text: &str) -> Room {
    let document = Document::new(format!("{name}.toml (embedded)"), text);
    match Room::from_document(&document) {
        Ok(room) => room,
        Err(error) => panic!("{error}"),
    }
}

#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Tables {
    schema: Spanned<String>,
    name: String,
    #[serde(default)]
    outline: Vec<OutlineTable>,
}

#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct OutlineTable {
    name: String,
    corners_m: Spanned<Vec<[f64; 2]>>,
    #[serde(default)]
    closed: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str) -> String {
        let document = Document::new("room.toml", text);
        Room::from_document(&document).expect_err("not accepted").to_string()
    }

    #[test]
    fn embedded_rooms_survive_writing() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        for room in [Room::furnished(), Room::corridor()] {
            let path = folder.path().join("room.toml");
            room.write(&path).expect("written");
            assert_eq!(Room::read(&path).expect("readable"), room);
        }
    }

    #[test]
    fn errors_point_at_line_and_key() {
        let head = "schema = \"trackdyn.room/1\"\nname = \"x\"\n";
        let found = error("schema = \"trackdyn.room/2\"\nname = \"x\"\n");
        assert!(found.contains("room.toml:1: schema = \"trackdyn.room/2\": expected"), "{found}");
        let found = error(&format!("{head}[[outline]]\nname = \"a\"\ncorners_m = [[0, 1]]\n"));
        assert!(
            found.contains("room.toml:5: outline[0].corners_m = [[0, 1]]: expected"),
            "{found}"
        );
        let twice = "[[outline]]\nname = \"a\"\ncorners_m = [[0, 1], [0, 1]]\n";
        assert!(error(&format!("{head}{twice}")).contains("twice in a row"));
        let nan = "[[outline]]\nname = \"a\"\ncorners_m = [[0, nan], [0, 1]]\n";
        assert!(error(&format!("{head}{nan}")).contains("finite"));
        let unknown = error(&format!("{head}walls = 3\n"));
        assert!(unknown.contains("room.toml:3:1") && unknown.contains("walls"), "{unknown}");
    }
}
