//! Which answers depend on a setting: the ten most influential ones times and over 1.5, on twenty
//! short drives of the independent ground.
//!
//! `settings [--cases N] [--of PATH,PATH,...]` prints a table: how many answers change, and which.
//! `--of all` varies every setting that decides.

use rayon::prelude::*;
use std::collections::BTreeSet;
use std::error::Error;
use toml::Value;
use trackdyn_diagnose::Settings;
use trackdyn_diagnose::settings::Entry;
use trackdyn_drive::sensors::Preset;
use trackdyn_drive::{ScheduleKind, ScheduleOptions};
use trackdyn_model::VehicleFile;
use trackdyn_recording::Recording;
use trackdyn_tests::concealed::{Drive, diagnosed_by, named, owned, sensors};

const USAGE: &str = "usage: settings [--cases N] [--of PATH,PATH,...|all]";

/// Factor by which a setting is larger, and smaller.
const FACTOR: f64 = 1.5;

/// Runs of a case, and the time of each, s.
const RUNS: usize = 3;
const RUN_TIME: f64 = 30.0;

/// Settings that most answers depend on: what a claim must reach, what makes one answer of two,
/// what is searched, and what residuals weigh.
const MAIN_SETTINGS: [&str; 10] = [
    "verdict.max_p",
    "verdict.min_ln_bayes_factor",
    "verdict.min_held_out_gain",
    "verdict.max_form_error",
    "answer.max_ln_likelihood_gap",
    "answer.min_separation",
    "search.min_ln_evidence",
    "prior.size_deviation",
    "evidence.huber_threshold",
    "location.score_ridge",
];

/// What is concealed: nothing, one effect, two, and laws that no catalogue has.
const CONCEALED_EFFECTS: [&[&str]; 20] = [
    &[],
    &[],
    &[],
    &["load-transfer:cog_height_m=0.15"],
    &["load-transfer:cog_height_m=0.05"],
    &["motion-resistance"],
    &["hitch-drag"],
    &["slope:angle_deg=3"],
    &["tether"],
    &["viscous-friction"],
    &["stribeck-friction"],
    &["friction-drift"],
    &["friction-gradient"],
    &["terrain-patch"],
    &["belt-slip"],
    &["shear-displacement"],
    &["slope:angle_deg=2", "motion-resistance"],
    &["load-transfer:cog_height_m=0.1", "stribeck-friction"],
    &["brushed-ground"],
    &["steering-grip"],
];

/// A drive with something concealed.
struct Case {
    name: String,
    file: VehicleFile,
    recording: Recording,
}

impl Case {
    fn new(index: usize) -> Result<Self, String> {
        let concealed = CONCEALED_EFFECTS[index];
        let seed = u64::try_from(index).map_err(|error| error.to_string())?;
        let options = ScheduleOptions {
            runs: Some(RUNS),
            duration: Some(RUN_TIME),
            seed,
            ..ScheduleOptions::default()
        };
        let runs = ScheduleKind::Manual.generate(&options).map_err(|error| error.to_string())?;
        let file = owned(concealed);
        let drive = Drive::new(&file.vehicle, concealed, &runs, seed)?;
        let recording = drive.recording(&sensors(Preset::Laboratory), seed);
        let concealed = if concealed.is_empty() { "nothing".into() } else { concealed.join(", ") };
        Ok(Self { name: format!("{} {concealed}", index + 1), file, recording })
    }

    /// The status, and all that is named.
    fn answer(&self, settings: &Settings) -> Result<String, trackdyn_diagnose::Error> {
        let diagnosis = diagnosed_by(&self.recording, &self.file, settings)?;
        let named: BTreeSet<String> = named(&diagnosis)
            .into_iter()
            .map(|(_, members)| members.into_iter().collect::<Vec<_>>().join(" or "))
            .collect();
        let named: Vec<String> = named.into_iter().collect();
        Ok(format!("{}: {}", diagnosis.answer.status.name(), named.join(", ")))
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mut count, mut of) = (CONCEALED_EFFECTS.len(), MAIN_SETTINGS.map(str::to_owned).to_vec());
    let mut arguments = std::env::args().skip(1);
    while let Some(key) = arguments.next() {
        let value = arguments.next().ok_or(USAGE)?;
        match (&*key, &*value) {
            ("--cases", count_of) => {
                count = count_of.parse::<usize>()?.min(CONCEALED_EFFECTS.len());
            }
            ("--of", "all") => of = deciding(),
            ("--of", paths) => of = paths.split(',').map(str::to_owned).collect(),
            _ => return Err(USAGE.into()),
        }
    }
    let cases = (0..count).into_par_iter().map(Case::new).collect::<Result<Vec<Case>, _>>()?;
    let defaults = Settings::default();
    let answers = |settings: &Settings| -> Result<Vec<String>, trackdyn_diagnose::Error> {
        cases.par_iter().map(|case| case.answer(settings)).collect()
    };
    let usual = answers(&defaults)?;
    for (case, answer) in cases.iter().zip(&usual) {
        println!("- {}: {answer}", case.name);
    }
    println!("\n| setting | value | answers that change | which |\n|---|---|---|---|");
    for path in of {
        let entry = Settings::entries().into_iter().find(|entry| entry.path == path);
        let entry = entry.ok_or_else(|| format!("{path}: no such setting"))?;
        for factor in [FACTOR.recip(), FACTOR] {
            let value = scaled(&entry, factor);
            if value == entry.default {
                continue;
            }
            let mut settings = defaults.clone();
            settings.set(&path, &value)?;
            let changed: Vec<String> = (cases.iter().zip(&usual).zip(answers(&settings)?))
                .filter(|((_, before), after)| *before != after)
                .map(|((case, _), after)| format!("{} -> {after}", case.name))
                .collect();
            println!("| {path} | {value} | {} | {} |", changed.len(), changed.join("; "));
        }
    }
    Ok(())
}

/// Paths of the settings that are more than numerical accuracy.
fn deciding() -> Vec<String> {
    let entries = Settings::entries().into_iter().filter(|entry| entry.if_wrong.is_some());
    entries.map(|entry| entry.path).collect()
}

/// The default times a factor, within the range; counts change by one at least.
fn scaled(entry: &Entry, factor: f64) -> Value {
    let [low, high] = entry.range;
    let number = |value: &Value| value.as_float().unwrap_or_default();
    let within = |value: &Value| Value::Float((number(value) * factor).clamp(low, high));
    match &entry.default {
        Value::Integer(count) => {
            #[expect(clippy::cast_precision_loss, reason = "counts are small")]
            let times = *count as f64 * factor;
            let times = if factor > 1.0 { times.ceil() } else { times.floor() };
            #[expect(clippy::cast_possible_truncation, reason = "counts are small")]
            let times = times.clamp(low, high) as i64;
            Value::Integer(times)
        }
        Value::Array(values) => Value::Array(values.iter().map(within).collect()),
        value => within(value),
    }
}
