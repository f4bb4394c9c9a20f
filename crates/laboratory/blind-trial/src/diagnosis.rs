//! What a diagnosis says: the part of `diagnosis.toml` that is scored.
//!
//! Further keys and tables are passed over: a tool may say more than is asked.

pub use trackdyn_core::status::Status;

use crate::error::Error;
use serde::Deserialize;
use std::path::Path;
use trackdyn_core::document::Document;

/// Name of the file.
pub const FILE: &str = "diagnosis.toml";

/// A diagnosis, schema `trackdyn.diagnosis/1`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Diagnosis {
    /// Its conclusion.
    pub status: Status,
    /// Where the excess is, without a model of it.
    #[serde(default)]
    pub located: Located,
    /// What is named.
    #[serde(default)]
    pub missing: Vec<Missing>,
    /// How well the diagnosis predicts runs that it did not learn from.
    #[serde(default)]
    pub fit: Fit,
}

/// Where the excess is.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
pub struct Located {
    /// Root mean square of the whitened residual of the base model.
    #[serde(default)]
    pub excess_over_noise: Option<f64>,
    /// Letters of the invariances that are rejected.
    #[serde(default)]
    pub broken: Vec<String>,
}

/// One thing that is missing.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Missing {
    /// Id of the effect.
    pub effect: String,
    /// All effects that the recording cannot separate from it, itself among them.
    #[serde(default)]
    pub one_of: Vec<String>,
    /// Sizes with their intervals.
    #[serde(default)]
    pub parameters: Vec<Size>,
}

/// The size of a parameter.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Size {
    /// Key of the parameter.
    pub name: String,
    /// Estimate, in the unit of the key.
    pub value: f64,
    /// Low end of the interval of 95 %.
    #[serde(default)]
    pub low95: Option<f64>,
    /// High end of the interval of 95 %.
    #[serde(default)]
    pub high95: Option<f64>,
}

/// Whitened root mean squares on held-out runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
pub struct Fit {
    /// Of the base model.
    #[serde(default)]
    pub held_out_before: Option<f64>,
    /// With nothing but constants and instruments fitted.
    #[serde(default)]
    pub held_out_instruments: Option<f64>,
    /// With what is named.
    #[serde(default)]
    pub held_out_after: Option<f64>,
    /// Of noise alone.
    #[serde(default)]
    pub noise_floor: Option<f64>,
    /// Share of the excess over the noise that is explained.
    #[serde(default)]
    pub excess_explained: Option<f64>,
}

impl Diagnosis {
    /// Reads `diagnosis.toml` of a folder.
    ///
    /// # Errors
    /// [`Error::Document`]; [`Error::Option`] of a name that would break a table of scores.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let diagnosis: Self = Document::read(&folder.join(FILE))?.parse()?;
        let names = diagnosis.missing.iter().flat_map(Missing::members);
        let mut names = names.chain(diagnosis.located.broken.iter().map(String::as_str));
        let breaks = |letter: char| matches!(letter, ',' | '|' | '"') || letter.is_whitespace();
        match names.find(|name| name.contains(breaks)) {
            None => Ok(diagnosis),
            Some(name) => Err(Error::Option {
                name: FILE,
                value: name.to_owned(),
                expected: "names without spaces, commas, quotes and bars",
            }),
        }
    }
}

impl Missing {
    /// The effects that it may be, at least one.
    pub fn members(&self) -> Vec<&str> {
        let mut members: Vec<&str> = self.one_of.iter().map(String::as_str).collect();
        if !members.contains(&self.effect.as_str()) {
            members.push(&self.effect);
        }
        members.sort_unstable();
        members
    }
}
