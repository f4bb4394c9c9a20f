//! All numbers that decide the answer of a diagnosis, in one tree: a group for each stage.
//!
//! Each number has a path such as `verdict.min_ln_bayes_factor`, a unit, a default, and in words
//! what it is, why it has that value and what happens when it is wrong.
//! [`page`] prints all of them: `docs/theory/diagnosis/settings.md` is that
//! text.
//!
//! Groups of what other uses of a recording share, such as its clock, stand beside their code in
//! [`trackdyn_estimate`].
//!
//! What stays a constant in the code is no choice: stand-ins for zero and infinity, the medians of
//! distributions, the number of nodes of a table. A test of the suite lists each with its reason.

mod answer;
mod base;
mod candidates;
mod comparison;
mod drift;
mod evidence;
mod fit;
mod held_out;
mod limits;
mod location;
mod mechanics;
mod menu;
mod noise;
mod page;
mod plan;
mod prior;
mod proposal;
mod search;
mod verdict;

pub use answer::Answer;
pub use base::Base;
pub use candidates::Candidates;
pub use comparison::Comparison;
pub use drift::Drift;
pub use evidence::Evidence;
pub use fit::Fit;
pub use held_out::HeldOut;
pub use limits::Limits;
pub use location::Location;
pub use mechanics::Mechanics;
pub use menu::Menu;
pub use noise::Noise;
pub use page::page;
pub use plan::Plan;
pub use prior::Prior;
pub use proposal::Proposal;
pub use search::Search;
pub use verdict::Verdict;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::collections::BTreeMap;
use std::path::Path;
use toml::{Spanned, Table, Value};
use trackdyn_core::document::{Document, DocumentError};
pub use trackdyn_core::settings::Entry;
use trackdyn_core::settings::Group;
use trackdyn_estimate as estimate;

/// Settings of accuracy that were there once. Files that have them are read; they decide nothing.
const FORMER_SETTINGS: [&str; 1] = ["noise.taken_difference"];

/// A setting that does not exist, or a value that it cannot have.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SettingError {
    /// No setting has this path.
    #[error("{path}: expected one of {known}")]
    Unknown {
        /// The path as given.
        path: String,
        /// What there is in its place.
        known: String,
    },
    /// A value of another kind, or outside the range.
    #[error("{path} = {value}: expected {expected}")]
    Value {
        /// Path of the setting.
        path: String,
        /// The value as given.
        value: String,
        /// Kind and range that it must have.
        expected: String,
    },
}

/// The groups of the tree: a field of [`Settings`] for each, in the order of the stages.
macro_rules! tree {
    ($($(#[doc = $about:literal])+ $group:ident: $kind:ty,)+) => {
        /// All numbers that decide the answer of a diagnosis.
        #[derive(Clone, Debug, Default, PartialEq)]
        #[non_exhaustive]
        pub struct Settings {
            $($(#[doc = $about])+ pub $group: $kind,)+
        }

        impl Settings {
            /// Name, description and settings of each group.
            fn groups() -> Vec<(&'static str, String, Vec<Entry>)> {
                vec![$((
                    stringify!($group),
                    concat!($($about),+).trim().to_owned(),
                    <$kind>::entries(stringify!($group)),
                ),)+]
            }

            fn group(&self, name: &str) -> Option<&dyn Group> {
                match name {
                    $(stringify!($group) => Some(&self.$group),)+
                    _ => None,
                }
            }

            fn group_mut(&mut self, name: &str) -> Option<&mut dyn Group> {
                match name {
                    $(stringify!($group) => Some(&mut self.$group),)+
                    _ => None,
                }
            }
        }
    };
}

tree! {
    /// What counts as evidence, and what its residuals weigh.
    evidence: Evidence,
    /// When poses are no reference: those computed from the tracks are refused.
    reference: estimate::contradiction::Settings,
    /// How the clock offset of the poses is found.
    clock: estimate::clock::Settings,
    /// How stamps that jitter are set right.
    stamps: estimate::regular::Settings,
    /// How noise is measured before any model: from there its search starts.
    measured_noise: estimate::noise::Settings,
    /// When a gyroscope corrects the yaw of poses, where that is asked for.
    gyroscope: estimate::gyroscope::Settings,
    /// Which driving tells the distance of the ICRs by itself: it weighs noise of the tracks.
    spin: estimate::spin_test::Settings,
    /// When runs have frames of their own, where the recording does not say.
    frames: estimate::frames::Settings,
    /// Which runs, or points of a table, the result is judged on, unless the caller says which.
    held_out: HeldOut,
    /// How noise is told from what driving could explain.
    noise: Noise,
    /// What is known of each number before the evidence.
    prior: Prior,
    /// What is free in every hypothesis.
    base: Base,
    /// How a hypothesis predicts motion.
    mechanics: Mechanics,
    /// How the numbers of a hypothesis are fitted.
    fit: Fit,
    /// Which symmetries the evidence breaks.
    location: Location,
    /// Which variants of each effect are tried.
    candidates: Candidates,
    /// Which hypotheses are refitted and kept.
    search: Search,
    /// What a claim must reach: each of these rules can refuse it.
    verdict: Verdict,
    /// Which effects are one answer together.
    answer: Answer,
    /// How far intervals and detection limits reach.
    limits: Limits,
    /// When a form is proposed for what no effect explains.
    proposal: Proposal,
    /// How drift of dead reckoning is measured.
    drift: Drift,
    /// How two sets of recordings are compared; most rules are those of claims.
    comparison: Comparison,
    /// What driving tells rivals apart.
    plan: Plan,
    /// Speeds of the manoeuvres from which a plan chooses, as shares of the fastest track speed,
    /// and ratios of the inner to the outer track.
    menu: Menu,
}

impl Settings {
    /// What is known of every setting, in the order of the groups.
    pub fn entries() -> Vec<Entry> {
        Self::groups().into_iter().flat_map(|(_, _, entries)| entries).collect()
    }

    /// Value of a setting by its path; none where there is no such setting.
    pub fn get(&self, path: &str) -> Option<Value> {
        let (group, name) = path.split_once('.')?;
        self.group(group)?.get(name)
    }

    /// Sets a value by its path.
    ///
    /// # Errors
    /// [`SettingError`] for a path that does not exist or a value outside the range.
    pub fn set(&mut self, path: &str, value: &Value) -> Result<(), SettingError> {
        let (group, name) = path.split_once('.').unwrap_or((path, ""));
        let Some(into) = self.group_mut(group) else { return Err(Self::no_group(path)) };
        match into.set(name, value) {
            Some(Ok(())) => Ok(()),
            Some(Err(expected)) => {
                let (path, value) = (path.to_owned(), value.to_string());
                Err(SettingError::Value { path, value, expected })
            }
            None if FORMER_SETTINGS.contains(&path) => Ok(()),
            None => {
                let known: Vec<String> =
                    into.names().iter().map(|name| format!("{group}.{name}")).collect();
                Err(SettingError::Unknown { path: path.to_owned(), known: known.join(", ") })
            }
        }
    }

    /// The error of a path into no group.
    fn no_group(path: &str) -> SettingError {
        let known: Vec<&str> = Self::groups().into_iter().map(|(name, ..)| name).collect();
        SettingError::Unknown { path: path.to_owned(), known: known.join(", ") }
    }

    /// Whether every value lies in its range.
    ///
    /// # Errors
    /// [`SettingError`] for the first one that does not.
    pub fn check(&self) -> Result<(), SettingError> {
        let mut read = Self::default();
        Self::entries().iter().try_for_each(|Entry { path, .. }| {
            let value = self.get(path);
            value.map_or(Ok(()), |value| read.set(path, &value))
        })
    }

    /// The settings of a table of groups; what it does not name keeps its default.
    ///
    /// # Errors
    /// [`SettingError`] for the first key that does not exist or value outside its range.
    pub fn from_table(table: &Table) -> Result<Self, SettingError> {
        let mut settings = Self::default();
        for (group, values) in table {
            if settings.group(group).is_none() {
                return Err(Self::no_group(group));
            }
            let Some(values) = values.as_table() else {
                let expected = "a table of settings".to_owned();
                let (path, value) = (group.clone(), values.to_string());
                return Err(SettingError::Value { path, value, expected });
            };
            for (name, value) in values {
                settings.set(&format!("{group}.{name}"), value)?;
            }
        }
        Ok(settings)
    }

    /// The settings of a file ([`Settings::from_document`]).
    ///
    /// # Errors
    /// A [`DocumentError`] that names the file.
    pub fn open(path: &Path) -> Result<Self, DocumentError> {
        Self::from_document(&Document::read(path)?)
    }

    /// The settings of a TOML file of groups; what it does not name keeps its default.
    ///
    /// # Errors
    /// A [`DocumentError`] that points at line and key.
    pub fn from_document(document: &Document) -> Result<Self, DocumentError> {
        let mut settings = Self::default();
        let refused = |span, error| {
            let (path, expected) = match error {
                SettingError::Unknown { path, known } => (path, format!("one of {known}")),
                SettingError::Value { path, expected, .. } => (path, expected),
            };
            document.value_error(span, path, expected)
        };
        let table: BTreeMap<String, Spanned<BTreeMap<String, Spanned<Value>>>> =
            document.parse()?;
        for (group, values) in table {
            if settings.group(&group).is_none() {
                return Err(refused(values.span(), Self::no_group(&group)));
            }
            for (name, value) in values.into_inner() {
                let set = settings.set(&format!("{group}.{name}"), value.get_ref());
                set.map_err(|error| refused(value.span(), error))?;
            }
        }
        Ok(settings)
    }

    /// Whether all of them are the defaults.
    pub fn are_defaults(&self) -> bool {
        *self == Self::default()
    }

    /// The settings that differ from their defaults, as a table of groups; empty where none does.
    pub fn differences(&self) -> Table {
        let (defaults, mut table) = (Self::default(), Table::new());
        for path in Self::entries().into_iter().map(|entry| entry.path) {
            let value = self.get(&path).filter(|value| Some(value) != defaults.get(&path).as_ref());
            let (Some(value), Some((group, name))) = (value, path.split_once('.')) else {
                continue;
            };
            let into = table.entry(group).or_insert_with(|| Value::Table(Table::new()));
            if let Value::Table(into) = into {
                into.insert(name.to_owned(), value);
            }
        }
        table
    }
}

impl Serialize for Settings {
    /// Writes the settings that differ from their defaults.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.differences().serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Settings {
    /// Reads the settings that a table of groups names; the others keep their defaults.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::from_table(&Table::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}
