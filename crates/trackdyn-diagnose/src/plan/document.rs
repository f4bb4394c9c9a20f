//! The plan as a file, schema `trackdyn.plan/1`.

use super::{Answer, DIGITS, Options, Plan, measurement};
use crate::document::NoiseTable;
use serde::Serialize;
use trackdyn_estimate::weighting::SegmentNoise;
use trackdyn_model::EffectId;
use trackdyn_model::kinematics::Source;

/// A plan file.
#[derive(Clone, Debug, Serialize)]
pub struct PlanFile {
    schema: &'static str,
    duration_s: f64,
    fastest_m_s: f64,
    /// Assumed noise of a pose.
    noise: PlannedNoise,
    manoeuvre: Vec<ManoeuvreTable>,
    pair: Vec<PairTable>,
    source: Source,
}

/// Noise of a pose, and of each axis.
#[derive(Clone, Debug, Serialize)]
struct PlannedNoise {
    /// Root mean square of both axes.
    pose_xy_m: f64,
    #[serde(flatten)]
    of_axes: NoiseTable,
}

impl PlannedNoise {
    fn of(noise: &SegmentNoise) -> Self {
        let [forward, left, _] = noise.pose;
        Self {
            pose_xy_m: DIGITS.round(f64::midpoint(forward, left).sqrt()),
            of_axes: NoiseTable::of(noise),
        }
    }
}

#[derive(Clone, Debug, Serialize)]
struct ManoeuvreTable {
    name: String,
    start_s: f64,
    duration_s: f64,
    separates: Vec<SeparationTable>,
}

#[derive(Clone, Debug, Serialize)]
struct SeparationTable {
    members: [&'static str; 2],
    z: f64,
    z_per_second: f64,
}

/// Separation of two members by the whole plan.
#[derive(Clone, Debug, Serialize)]
struct PairTable {
    members: [&'static str; 2],
    z: f64,
    z_per_second: f64,
    /// z over the whole menu.
    z_of_menu: f64,
    decides: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    needed_s: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    measure: Vec<&'static str>,
}

impl PlanFile {
    /// The file of a plan.
    pub fn new(plan: &Plan, options: &Options, source: Source) -> Self {
        let ids = |effects: [EffectId; 2]| effects.map(EffectId::name);
        let duration = plan.duration();
        let manoeuvre = plan.steps.iter().map(|step| ManoeuvreTable {
            name: step.manoeuvre.name.clone(),
            start_s: DIGITS.round(step.start),
            duration_s: DIGITS.round(step.manoeuvre.duration()),
            separates: plan
                .pairs
                .iter()
                .zip(&step.z)
                .map(|(pair, &z)| SeparationTable {
                    members: ids(pair.effects),
                    z: DIGITS.round(z),
                    z_per_second: DIGITS.round(z / step.manoeuvre.duration()),
                })
                .collect(),
        });
        let pair = plan.pairs.iter().map(|pair| PairTable {
            members: ids(pair.effects),
            z: DIGITS.round(pair.z),
            z_per_second: if duration > 0.0 { DIGITS.round(pair.z / duration) } else { 0.0 },
            z_of_menu: DIGITS.round(pair.menu),
            decides: pair.answer == Answer::Plan,
            needed_s: match pair.answer {
                Answer::Longer(time) => Some(DIGITS.round(time)),
                Answer::Plan | Answer::Never => None,
            },
            measure: match pair.answer {
                Answer::Plan => Vec::new(),
                Answer::Longer(_) | Answer::Never => measurements(pair.effects),
            },
        });
        Self {
            schema: "trackdyn.plan/1",
            duration_s: DIGITS.round(duration),
            fastest_m_s: options.fastest,
            noise: PlannedNoise::of(&options.noise),
            manoeuvre: manoeuvre.collect(),
            pair: pair.collect(),
            source,
        }
    }

    /// The file as TOML text.
    ///
    /// # Panics
    /// Never: all values can be written as TOML.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("numbers, texts and tables are TOML")
    }
}

/// Measurements at rest that separate the effects.
pub fn measurements(effects: impl IntoIterator<Item = EffectId>) -> Vec<&'static str> {
    let mut all = Vec::new();
    for measurement in effects.into_iter().map(measurement) {
        if !all.contains(&measurement) {
            all.push(measurement);
        }
    }
    all
}
