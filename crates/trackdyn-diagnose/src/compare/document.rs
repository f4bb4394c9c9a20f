//! A comparison as a file, schema `trackdyn.comparison/1`.

use super::{Comparison, Difference, Estimate, Quantity, Subject, Which};
use crate::document::{DIGITS, DriftTable, SupportTable, by_keys};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use toml::Table;
use trackdyn_core::document::{Document, DocumentError};
use trackdyn_model::kinematics::Source;

const SCHEMA: &str = "trackdyn.comparison/1";

/// A comparison file.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct ComparisonFile {
    schema: String,
    /// `nothing-differs`, `explained`, `ambiguous` or `unexplained`.
    pub status: String,
    /// Where they differ.
    pub located: LocatedTable,
    /// What differs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub differs: Vec<DifferenceTable>,
    /// What was compared and is not claimed to differ.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub alike: Vec<DifferenceTable>,
    /// Encoders and pose sensor in each set.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub instruments: Vec<NumberTable>,
    /// Effects of one set that the other one cannot show.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub not_shown: BTreeMap<String, String>,
    /// How much closer the simulator comes.
    pub closer: CloserTable,
    /// Smallest difference of each size that would have shown.
    #[serde(default)]
    pub smallest: BTreeMap<String, BTreeMap<String, f64>>,
    /// What the simulator's recordings are, and how they were taken.
    pub sim: Table,
    /// What the robot's recordings are, and how they were taken.
    pub real: Table,
}

/// Where two sets differ.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct LocatedTable {
    /// Letters of the symmetries in which they differ.
    pub broken: Vec<String>,
    /// Letters of those that nothing named explains.
    pub left: Vec<String>,
    /// One sentence.
    #[serde(rename = "where")]
    pub place: String,
}

/// A difference, or what was found not to be one.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct DifferenceTable {
    /// Id of an effect, `constants`, `friction-level` or `centre-of-gravity`.
    pub what: String,
    /// `sim`, `real` or `both`: which has it.
    pub which: String,
    /// Effects of which each explains it.
    pub one_of: Vec<String>,
    /// Why it is not claimed; absent where it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refused: Option<String>,
    /// Statistical support.
    pub evidence: SupportTable,
    /// The numbers, in each set.
    pub numbers: Vec<NumberTable>,
    /// What each effect that explains constants would have to be more in the robot.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<MemberTable>,
}

/// A number in each set.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct NumberTable {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// In the simulator's recordings.
    pub sim: EstimateTable,
    /// In the robot's.
    pub real: EstimateTable,
    /// The robot's less the simulator's.
    pub difference: EstimateTable,
}

/// An estimate with its 95 % interval.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
pub struct EstimateTable {
    /// Estimate.
    pub value: f64,
    /// Lower end.
    pub low95: f64,
    /// Upper end.
    pub high95: f64,
}

/// An effect that explains a difference of constants.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct MemberTable {
    /// Its id.
    pub effect: String,
    /// Sizes by their keys; empty where it does so with others only.
    pub sizes: BTreeMap<String, EstimateTable>,
}

/// Predictions of the robot's runs.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct CloserTable {
    /// Whether the runs were held out.
    pub are_held_out: bool,
    /// Error of the simulator's model, in units of the noise.
    pub sim: f64,
    /// Error with what differs as in the robot.
    pub corrected: f64,
    /// Error of the robot's own model.
    pub real: f64,
    /// Twice the log-likelihood by which the robot's own model explains the runs of the fit better
    /// than the simulator's with what differs, beyond chance.
    #[serde(default)]
    pub left: f64,
    /// What is tolerated of it.
    #[serde(default)]
    pub tolerated: f64,
    /// Drift of dead reckoning with the simulator's model (`before`) and with what differs as in
    /// the robot (`after`).
    #[serde(default, skip_serializing_if = "DriftTable::is_empty")]
    pub drift: DriftTable,
}

impl ComparisonFile {
    /// The file of a comparison of these sources: the simulator's and the robot's.
    ///
    /// # Panics
    /// Never: a source serialises to a table.
    pub fn new(comparison: &Comparison, [sim, real]: [&Source; 2]) -> Self {
        let letters = |of: Vec<trackdyn_model::effect::Symmetry>| -> Vec<String> {
            of.into_iter().map(|symmetry| symmetry.letter().to_string()).collect()
        };
        let smallest = comparison.smallest.iter();
        let table = |source: &Source, set: usize| {
            let mut table = Table::try_from(source).expect("a source is a table");
            let seen = &comparison.diagnoses[set].evidence.seen;
            table.insert("evidence".to_owned(), seen.description().into());
            table
        };
        let [sim, real] = [table(sim, 0), table(real, 1)];
        let [first, corrected, second] = comparison.closer.errors.map(|value| DIGITS.round(value));
        let instruments = comparison.instruments.iter().flat_map(|group| &group.numbers);
        let not_shown = comparison.not_shown.iter();
        Self {
            schema: SCHEMA.to_owned(),
            status: comparison.status().name().to_owned(),
            located: LocatedTable {
                broken: letters(comparison.broken()),
                left: letters(comparison.left()),
                place: comparison.place(),
            },
            differs: comparison.differences.iter().map(difference).collect(),
            alike: comparison.alike.iter().map(difference).collect(),
            instruments: instruments.map(number).collect(),
            not_shown: not_shown
                .map(|(effect, set)| (effect.name().to_owned(), ["sim", "real"][*set].to_owned()))
                .collect(),
            closer: CloserTable {
                are_held_out: comparison.closer.are_held_out,
                sim: first,
                corrected,
                real: second,
                left: DIGITS.round(comparison.closer.left),
                tolerated: DIGITS.round(comparison.closer_tolerated()),
                drift: DriftTable::of(&comparison.closer.drift),
            },
            smallest: by_keys(smallest.map(|one| (one.effect, one.parameter, one.size))),
            sim,
            real,
        }
    }

    /// Reads a comparison file.
    ///
    /// # Errors
    /// A [`DocumentError`] that points at line and key.
    pub fn from_document(document: &Document) -> Result<Self, DocumentError> {
        document.parse_as(SCHEMA)
    }

    /// The file as TOML text.
    ///
    /// # Panics
    /// Never: all values can be written as TOML.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("numbers, texts and tables are TOML")
    }
}

impl Subject {
    /// Its name in files: the id of an effect, or a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Effect(effect) => effect.name(),
            Self::Constants => "constants",
            Self::FrictionLevel => "friction-level",
            Self::CentreOfGravity => "centre-of-gravity",
        }
    }
}

fn difference(one: &Difference) -> DifferenceTable {
    let which = match one.which {
        Which::First => "sim",
        Which::Second => "real",
        Which::Both => "both",
    };
    let members = one.members.iter().map(|member| MemberTable {
        effect: member.effect.name().to_owned(),
        sizes: member
            .sizes
            .iter()
            .map(|(place, size)| {
                (member.effect.card().parameters[*place].key.to_owned(), estimate(size))
            })
            .collect(),
    });
    DifferenceTable {
        what: one.group.subject.name().to_owned(),
        which: which.to_owned(),
        one_of: one.one_of.iter().map(|effect| effect.name().to_owned()).collect(),
        refused: one.refused.as_ref().map(ToString::to_string),
        evidence: SupportTable::of(&one.support),
        numbers: one.group.numbers.iter().map(number).collect(),
        members: members.collect(),
    }
}

fn number(quantity: &Quantity) -> NumberTable {
    let [sim, real] = quantity.each.each_ref().map(estimate);
    NumberTable {
        name: quantity.number.name().to_owned(),
        unit: quantity.number.unit().to_owned(),
        sim,
        real,
        difference: estimate(&quantity.difference),
    }
}

fn estimate(of: &Estimate) -> EstimateTable {
    let [value, low95, high95] = [of.value, of.low, of.high].map(|value| DIGITS.round(value));
    EstimateTable { value, low95, high95 }
}
