//! The file of sensors, schema `trackdyn.sensors/1`.

use super::{Encoder, Imu, PoseSensor, Sensors};
use crate::Error;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};
use trackdyn_core::document::Document;

const SCHEMA: &str = "trackdyn.sensors/1";

/// Keys that are absent have the values of [`Sensors::default`]; without a table `[imu]` there is
/// none.
#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Tables {
    schema: Spanned<String>,
    name: String,
    #[serde(default)]
    encoder: Encoder,
    #[serde(default)]
    pose: PoseSensor,
    #[serde(skip_serializing_if = "Option::is_none")]
    imu: Option<Imu>,
}

impl Sensors {
    /// Reads a file.
    ///
    /// # Errors
    /// As [`Sensors::from_document`].
    pub fn read(path: &Path) -> Result<Self, Error> {
        Self::from_document(&Document::read(path)?)
    }

    /// Reads and checks a file.
    ///
    /// # Errors
    /// [`Error::Document`], which points at the line and key.
    pub fn from_document(document: &Document) -> Result<Self, Error> {
        let Tables { name, encoder, pose, imu, .. } = document.parse_as(SCHEMA)?;
        let sensors = Self { name, encoder, pose, imu };
        sensors.check().map_err(|problem| {
            let span = span_of(document.text(), problem.key).unwrap_or_default();
            document.value_error(span, problem.key, problem.expected)
        })?;
        Ok(sensors)
    }

    /// The file's text.
    ///
    /// # Panics
    /// Never: the tables hold only what TOML can say.
    pub fn to_toml(&self) -> String {
        let Self { name, encoder, pose, imu } = self.clone();
        let schema = Spanned::new(0..0, SCHEMA.to_owned());
        toml::to_string(&Tables { schema, name, encoder, pose, imu })
            .expect("numbers, texts and tables are TOML")
    }
}

/// Where a value stands; where its key is absent, where the table does.
fn span_of(text: &str, key: &str) -> Option<Range<usize>> {
    let table = DeTable::parse(text).ok()?;
    let mut span = None;
    let mut inside: Option<&DeTable> = Some(table.get_ref());
    for word in key.split('.') {
        let Some(value) = inside.and_then(|table| table.get(word)) else { break };
        span = Some(value.span());
        inside = match value.get_ref() {
            DeValue::Table(table) => Some(table),
            _ => None,
        };
    }
    span
}
