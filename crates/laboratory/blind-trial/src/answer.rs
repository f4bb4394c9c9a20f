//! What was concealed: the answers of a trial.

use crate::difficulty::Difficulty;
use crate::forms::Forms;
use crate::key::Root;
use crate::plan::Stratum;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use trackdyn_second_simulator::sheet::Trial;
use trackdyn_second_simulator::{ActiveMechanism, MECHANISMS, Origin, Sheet, sheet_of};

/// Schema of the answers.
pub const SCHEMA: &str = "trackdyn.answers/1";

/// The answers of all cases.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answers {
    /// A text that nobody guesses, so that the hash of the answers says nothing; it comes of the
    /// key. Answers that are sealed in `answers.sealed` have none.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub salt: String,
    /// [`SCHEMA`].
    pub schema: String,
    /// Version of the program that made them.
    pub version: String,
    /// Seed of the trial.
    pub seed: u64,
    /// What everything was drawn from; that of the seed alone where it is absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub root: Option<Root>,
    /// Time of a run where it is not the usual one, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub run_time_s: Option<f64>,
    /// Which forms laws have.
    #[serde(default, skip_serializing_if = "Forms::is_plain")]
    pub forms: Forms,
    /// The cases, in the order of their ids.
    #[serde(rename = "case")]
    pub cases: Vec<Answer>,
}

impl Answers {
    /// What everything was drawn from.
    pub fn drawn_from(&self) -> Root {
        self.root.unwrap_or_else(|| Root::of_seed(self.seed))
    }
}

/// The answer of one case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answer {
    /// Name of its folder.
    pub id: String,
    /// What kind of case it is.
    pub stratum: Stratum,
    /// What is wrong, in a hard null.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub difficulty: Option<Difficulty>,
    /// Style of the training runs.
    pub driving: String,
    /// Largest track speed, m/s.
    pub fastest_m_per_s: f64,
    /// Preset of the sensors.
    pub sensors: String,
    /// Standard deviation of a pose's x and y, m.
    pub pose_white_m: f64,
    /// Standard deviation of a pose's yaw, rad.
    pub pose_white_rad: f64,
    /// Effects that the vehicle file lists with their true sizes, as `id:key=value,...`.
    pub known: Vec<String>,
    /// Fingerprint of the recording.
    pub recording: String,
    /// Fingerprint of the files that a diagnosis gets, byte for byte; older answers have none.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub files: String,
    /// The vehicle as it is, before effects: the text of its file.
    pub vehicle: String,
    /// What is concealed.
    #[serde(default, rename = "concealed", skip_serializing_if = "Vec::is_empty")]
    pub concealed: Vec<Concealed>,
    /// Clock offset of the sensors as such, s: the delay of poses beside that of the encoders.
    #[serde(default)]
    pub clock_offset_s: f64,
    /// Errors of instruments that come to it, and that it is right to name.
    #[serde(default, rename = "instrument", skip_serializing_if = "Vec::is_empty")]
    pub instruments: Vec<Instrument>,
}

/// A concealed mechanism, and what could be found of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Concealed {
    /// Id of the mechanism.
    pub mechanism: String,
    /// Whether the catalogue has it.
    pub in_catalogue: bool,
    /// Values by key.
    pub parameters: BTreeMap<String, f64>,
    /// Number that its form was drawn by; absent where it has the plain one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub form: Option<u32>,
    /// Letters of the invariances that it breaks.
    pub breaks: Vec<String>,
    /// z that was aimed at; absent where the size was drawn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z_wanted: Option<f64>,
    /// Norm of the whitened difference that it makes, outside the nuisances.
    pub z_det: f64,
    /// Norm of the difference outside the nuisances and the alternative that comes closest.
    pub z_iso: f64,
    /// Norm of the difference outside the nuisances and the three alternatives together that take
    /// most of it; older answers have none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub z_beyond: Option<f64>,
    /// The alternative that comes closest.
    pub nearest: String,
    /// Alternatives from which the recording cannot tell it.
    pub class: Vec<String>,
}

/// The error of an instrument that a clock offset is.
fn clock_offset() -> Option<&'static Sheet> {
    MECHANISMS.iter().find(|sheet| match sheet.trial {
        Trial::Instrument(error) => error.is_clock_offset,
        Trial::Law(_) => false,
    })
}

impl Answer {
    /// Errors of instruments as a recording shows them: those that were put in, and the clock
    /// offset that the sensors have as such.
    pub fn shown_errors(&self) -> Vec<Instrument> {
        let mut shown = self.instruments.clone();
        let Some(clock) = clock_offset().filter(|_| self.clock_offset_s != 0.0) else {
            return shown;
        };
        if !shown.iter().any(|error| error.mechanism == clock.id) {
            let (mechanism, parameters) = (clock.id.to_owned(), BTreeMap::new());
            shown.push(Instrument { mechanism, parameters });
        }
        for error in shown.iter_mut().filter(|error| error.mechanism == clock.id) {
            for parameter in clock.parameters {
                *error.parameters.entry(parameter.key.to_owned()).or_default() +=
                    self.clock_offset_s;
            }
        }
        shown
    }
}

/// An error of an instrument.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Instrument {
    /// Id of the mechanism.
    pub mechanism: String,
    /// Values by key.
    pub parameters: BTreeMap<String, f64>,
}

impl Concealed {
    /// Whether the recording shows it at all.
    pub fn is_detectable(&self) -> bool {
        self.z_det >= crate::oracle::MIN_DETECTABLE_Z
    }

    /// Whether it is a member of the class of constants: a recording shows nothing of it beside
    /// constant ICRs.
    pub fn is_constant(&self) -> bool {
        is_constant(&self.mechanism)
    }

    /// Whether the recording can tell it from everything else in the catalogue. No member of the
    /// class of constants can be: its z_iso compares it with effects outside that class.
    pub fn is_isolable(&self) -> bool {
        self.is_detectable() && self.z_iso >= crate::oracle::MIN_DISTINCT_Z && !self.is_constant()
    }

    /// Whether the recording is known to show it beside what three effects of the catalogue
    /// together may take of it.
    pub fn is_beyond_others(&self) -> bool {
        self.z_beyond.is_some_and(|z| z >= crate::oracle::MIN_DETECTABLE_Z)
    }

    /// Members of the smallest set that the recording allows: it, and all that cannot be told from
    /// it.
    pub fn smallest_set(&self) -> usize {
        let class = self.class.iter().map(String::as_str).chain([self.mechanism.as_str()]);
        let constants = MECHANISMS.iter().filter(|sheet| self.is_constant() && sheet.is_constant());
        let constants = constants.map(|sheet| sheet.id);
        class.chain(constants).collect::<BTreeSet<_>>().len()
    }
}

/// Whether the mechanism of an id belongs to the class of constants.
pub(crate) fn is_constant(id: &str) -> bool {
    sheet_of(id).is_some_and(Sheet::is_constant)
}

impl Instrument {
    pub(crate) fn of(active: &ActiveMechanism) -> Self {
        Self { mechanism: active.sheet().id.to_owned(), parameters: parameters(active) }
    }
}

pub(crate) fn parameters(active: &ActiveMechanism) -> BTreeMap<String, f64> {
    let keys = active.sheet().parameters.iter().map(|parameter| parameter.key.to_owned());
    keys.zip(active.values().iter().copied()).collect()
}

pub(crate) fn letters(active: &ActiveMechanism) -> Vec<String> {
    active.sheet().breaks.iter().map(|broken| broken.letter().to_string()).collect()
}

pub(crate) fn is_in_catalogue(active: &ActiveMechanism) -> bool {
    active.sheet().origin == Origin::Catalogue
}
