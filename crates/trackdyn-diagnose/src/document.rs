//! The diagnosis as a file, schema `trackdyn.diagnosis/1`.

mod drift;
mod noise;
mod proposed;

pub use drift::{ComparedTable, DriftTable};
pub use noise::NoiseTable;
pub use proposed::{ProposalTable, ProposedTable};

use crate::diagnosis::{Diagnosis, Kind};
use crate::settings::Settings;
use crate::uncertainty::Interval;
use crate::verdict::Support;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use toml::Table;
use trackdyn_core::document::{Document, DocumentError};
use trackdyn_core::rounding::Digits;
use trackdyn_model::EffectId;
use trackdyn_model::effect::{Card, Symmetry};
use trackdyn_model::kinematics::Source;

const SCHEMA: &str = "trackdyn.diagnosis/1";

/// Digits of the numbers of diagnosis and comparison files.
pub(crate) const DIGITS: Digits = Digits::Significant(9);

/// A diagnosis file.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct DiagnosisFile {
    schema: String,
    /// `explained`, `nothing-missing`, `ambiguous` or `unexplained`.
    pub status: String,
    /// Where evidence and model differ.
    pub located: LocatedTable,
    /// Missing parts of the model.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub missing: Vec<MissingTable>,
    /// Terms of a law proposed for what no effect explains.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub proposed: Vec<ProposedTable>,
    /// Quality of that law.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub proposal: Option<ProposalTable>,
    /// Friction by which the robot slides; absent where it is that of the vehicle file, and in
    /// older files.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction_by_inertia: Option<FactorTable>,
    /// Errors on held-out runs.
    pub fit: FitTable,
    /// Drift of dead reckoning on the same runs; absent in older files.
    #[serde(default, skip_serializing_if = "DriftTable::is_empty")]
    pub drift: DriftTable,
    /// Noise of the poses; absent in older files, and of tables of steady points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub noise: Option<NoiseTable>,
    /// What the gyroscope tells of the yaw of the poses; absent where it was not asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gyroscope: Option<Table>,
    /// Smallest detectable size of each effect, by the keys of its sizes.
    #[serde(default)]
    pub detectable: BTreeMap<String, BTreeMap<String, f64>>,
    /// Settings that differ from their defaults.
    #[serde(default, skip_serializing_if = "Settings::are_defaults")]
    pub settings: Settings,
    /// Source of the evidence.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<Table>,
}

/// Where evidence and model differ.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct LocatedTable {
    /// Root mean square of the whitened residual of the base model.
    pub excess_over_noise: f64,
    /// Shares of the chi-squared above noise.
    pub channels: Channels,
    /// Letters of the broken symmetries.
    pub broken: Vec<String>,
    /// One sentence.
    #[serde(rename = "where")]
    pub place: String,
}

/// Shares of the chi-squared above noise, by channel.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Channels {
    /// Across.
    pub lateral: f64,
    /// Along.
    pub longitudinal: f64,
    /// Heading.
    pub yaw: f64,
}

/// A missing part of the model.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct MissingTable {
    /// Effect id; the first of several that explain it equally well.
    pub effect: String,
    /// Ids of all effects that explain it equally well.
    pub one_of: Vec<String>,
    /// Parameters; empty where it stands for a class.
    pub parameters: Vec<ParameterTable>,
    /// Statistical support.
    pub evidence: SupportTable,
    /// How to decide between several; absent where one is named.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub separate_by: Option<String>,
}

/// A parameter with its 95 % interval.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct ParameterTable {
    /// Its key in vehicle files.
    pub name: String,
    /// Estimate.
    pub value: f64,
    /// Lower end of the interval.
    pub low95: f64,
    /// Upper end of the interval.
    pub high95: f64,
    /// Unit.
    pub unit: String,
}

/// A factor on what the vehicle file says, with its 95 % interval.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct FactorTable {
    /// Estimate.
    pub factor: f64,
    /// Lower end of the interval.
    pub low95: f64,
    /// Upper end of the interval.
    pub high95: f64,
}

/// Statistical support of a claim, or of a difference.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct SupportTable {
    /// Family-wise p value.
    pub p: f64,
    /// ln Bayes factor against the best alternative, or against no difference.
    pub ln_bayes_factor: f64,
    /// Cross-validated gain of log-likelihood, on blocks left out of the fit.
    pub held_out_gain: f64,
}

/// Errors on held-out runs, in units of the noise; on the fitted runs where none were held out.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct FitTable {
    /// Whether runs were held out; absent in older files.
    #[serde(default)]
    pub are_held_out: bool,
    /// Error of the model before.
    pub held_out_before: f64,
    /// Error of the base, with constants, encoders and pose sensor fitted; absent in older files.
    #[serde(default)]
    pub held_out_instruments: f64,
    /// Error of the corrected model.
    pub held_out_after: f64,
    /// Noise floor, which no model can go below.
    pub noise_floor: f64,
    /// Share of the excess that is explained; one where there is no excess.
    pub excess_explained: f64,
}

impl DiagnosisFile {
    /// The file of a diagnosis.
    ///
    /// # Panics
    /// Never: a source serialises to a table.
    pub fn new(diagnosis: &Diagnosis, source: &Source) -> Self {
        let located = &diagnosis.evidence.before;
        let detectable = diagnosis.limits.detectable.iter();
        let held_out = &diagnosis.evidence.errors;
        Self {
            schema: SCHEMA.to_owned(),
            status: diagnosis.answer.status.name().to_owned(),
            located: LocatedTable {
                excess_over_noise: DIGITS.round(located.excess_over_noise),
                channels: Channels {
                    longitudinal: DIGITS.round(located.channels[0]),
                    lateral: DIGITS.round(located.channels[1]),
                    yaw: DIGITS.round(located.channels[2]),
                },
                broken: diagnosis.answer.broken.iter().map(|s| s.letter().to_string()).collect(),
                place: diagnosis.answer.place.clone(),
            },
            missing: diagnosis.answer.missing.iter().map(missing).collect(),
            proposed: diagnosis.answer.proposed.as_ref().map_or_else(Vec::new, proposed::terms),
            proposal: diagnosis.answer.proposed.as_ref().map(proposed::law),
            friction_by_inertia: diagnosis.friction_by_inertia().map(|factors| {
                let [factor, low95, high95] = factors.map(|value| DIGITS.round(value));
                FactorTable { factor, low95, high95 }
            }),
            fit: FitTable {
                are_held_out: held_out.are_held_out,
                held_out_before: DIGITS.round(held_out.before),
                held_out_instruments: DIGITS.round(held_out.instruments),
                held_out_after: DIGITS.round(held_out.after),
                noise_floor: DIGITS.round(held_out.noise_floor),
                excess_explained: DIGITS.round(held_out.excess_explained().unwrap_or(1.0)),
            },
            drift: DriftTable::of(&diagnosis.evidence.drift),
            noise: diagnosis.evidence.seen.noise().map(NoiseTable::of),
            gyroscope: None,
            detectable: by_keys(detectable.map(|one| (one.effect, one.parameter, one.size))),
            settings: diagnosis.evidence.seen.settings().clone(),
            source: Some(Table::try_from(source).expect("a source is a table")),
        }
    }

    /// The file with what the gyroscope tells, as a table.
    pub fn with_gyroscope(self, gyroscope: Option<Table>) -> Self {
        Self { gyroscope, ..self }
    }

    /// Reads a diagnosis file.
    ///
    /// # Errors
    /// A [`DocumentError`] that points at line and key.
    pub fn from_document(document: &Document) -> Result<Self, DocumentError> {
        let file = document.parse_as(SCHEMA)?;
        NoiseTable::check(document)?;
        Ok(file)
    }

    /// The file as TOML text.
    ///
    /// # Panics
    /// Never: all values can be written as TOML.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("numbers, texts and tables are TOML")
    }
}

impl SupportTable {
    /// Table of a support.
    pub(crate) fn of(support: &Support) -> Self {
        let Support { p, ln_bayes_factor, held_out_gain, .. } = *support;
        let [p, ln_bayes_factor, held_out_gain] =
            [p, ln_bayes_factor, held_out_gain].map(|value| DIGITS.round(value));
        Self { p, ln_bayes_factor, held_out_gain }
    }
}

/// Sizes of effects that are known, by ids of effects and keys of parameters.
pub(crate) fn by_keys(
    sizes: impl IntoIterator<Item = (EffectId, usize, Option<f64>)>,
) -> BTreeMap<String, BTreeMap<String, f64>> {
    let mut by_keys: BTreeMap<_, BTreeMap<_, _>> = BTreeMap::new();
    for (effect, parameter, size) in sizes {
        if let Some(size) = size {
            let card = effect.card();
            let of = by_keys.entry(card.id.to_owned()).or_default();
            of.insert(card.parameters[parameter].key.to_owned(), DIGITS.round(size));
        }
    }
    by_keys
}

impl ParameterTable {
    /// Table of an effect's parameter; none for other unknowns.
    fn of(interval: &Interval) -> Option<Self> {
        let parameter = interval.unknown.parameter()?;
        Some(Self {
            name: parameter.key.to_owned(),
            value: DIGITS.round(interval.value),
            low95: DIGITS.round(interval.low),
            high95: DIGITS.round(interval.high),
            unit: parameter.unit.to_owned(),
        })
    }
}

fn missing(missing: &crate::diagnosis::Missing) -> MissingTable {
    let verdict = &missing.verdict;
    let ids: Vec<String> = verdict.one_of.iter().map(|&effect| effect.name().to_owned()).collect();
    let parameters = missing.parameters.iter().filter_map(ParameterTable::of);
    MissingTable {
        effect: verdict.effect.name().to_owned(),
        parameters: parameters.collect(),
        evidence: SupportTable::of(&verdict.support),
        separate_by: (ids.len() > 1).then(|| separate_by(missing)),
        one_of: ids,
    }
}

/// How to decide between the members of a class.
pub fn separate_by(missing: &crate::diagnosis::Missing) -> String {
    match missing.kind {
        Kind::Constant => {
            let members = missing.verdict.one_of.iter().map(|&effect| effect.card());
            let mut text = String::new();
            for (card, driving) in members.filter_map(|card| Some((card, told_by(card)?))) {
                let _ = write!(text, "driving {driving} tells whether it is {}; ", card.id);
            }
            if !text.is_empty() {
                text += "among the others ";
            }
            text + "no manoeuvre does: weigh each track (centre of gravity), measure the mount of \
            the pose \
                    sensor, pull the robot along and across (friction), and give what was \
                    measured in the \
                    vehicle file with its *_sd"
        }
        Kind::Physics | Kind::Instrument => {
            "the manoeuvres that `trackdyn plan` proposes for this diagnosis".to_owned()
        }
    }
}

/// Driving in which an effect does not act as constant ICRs; none where there is none.
fn told_by(card: &Card) -> Option<&'static str> {
    card.breaks.iter().find_map(|symmetry| match symmetry {
        Symmetry::SpeedScale => Some("slowly and fast"),
        Symmetry::Reversal => Some("forward and backward"),
        Symmetry::Manoeuvre => Some("arcs, spins and counter-rotation"),
        Symmetry::Mirror => None,
        Symmetry::Heading => Some("in several headings"),
        Symmetry::Place => Some("in several places"),
        Symmetry::Time => Some("again and again"),
        Symmetry::Transient => Some("with changes of speed"),
        Symmetry::Straight => Some("straight ahead"),
    })
}
