//! A case: something concealed, and what the diagnosis says of it.

use std::time::Instant;
use trackdyn_core::PerSide;
use trackdyn_diagnose::Diagnosis;
use trackdyn_diagnose::diagnosis::{Kind, Missing};
use trackdyn_diagnose::hypothesis::neutral;
use trackdyn_drive::ScheduleKind;
use trackdyn_drive::sensors::{Preset, Sensors};
use trackdyn_model::effect::{Card, Role};
use trackdyn_model::{ActiveEffect, CATALOGUE, Circumstance, Model, Vehicle};
use trackdyn_model::{Stationary, Status};
use trackdyn_second_simulator::sheet_of;
use trackdyn_tests::concealed::{Drive, diagnosed, members, owned, runs, sensors};

/// The effect that all these sensors have: their poses come late.
pub const CLOCK: &str = "time-offset";

/// Name of a case in which nothing is concealed, and of an answer that names nothing.
pub const NOTHING_NAME: &str = "nothing";

/// What the class of constants is called among the answers.
pub const CONSTANTS: &str = "constants";

/// Sizes that stop the robot, or with which one track holds and it goes straight on, are taken
/// smaller by this factor, so many times at most.
const SHRINK_FACTOR: f64 = 0.6;
const SHRINKS: usize = 6;

/// Speeds of a slow spin, m/s.
const SPIN: PerSide<f64> = PerSide { left: -0.1, right: 0.1 };

/// Directions are this far from the typical one, degrees: between those that the diagnosis tries.
const DIRECTION_OFFSET: f64 = 20.0;

/// Size of what is concealed, against the typical one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// A third of it.
    Third,
    /// As typical.
    Typical,
    /// Three times of it, or what the ranges allow.
    Triple,
}

impl Size {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Third, Self::Typical, Self::Triple];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Third => "third",
            Self::Typical => "typical",
            Self::Triple => "triple",
        }
    }

    fn factor(self) -> f64 {
        match self {
            Self::Third => 1.0 / 3.0,
            Self::Typical => 1.0,
            Self::Triple => 3.0,
        }
    }
}

/// What is concealed, and how the robot is driven.
pub struct Setting {
    /// The effect; none where nothing is concealed.
    pub card: Option<&'static Card>,
    /// Its size.
    pub size: Size,
    /// The driving.
    pub driving: ScheduleKind,
}

impl Setting {
    /// All of them, drives with nothing concealed first.
    pub fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for driving in [ScheduleKind::Manual, ScheduleKind::Designed] {
            all.push(Self { card: None, size: Size::Typical, driving });
        }
        for card in CATALOGUE.iter().filter(|card| !card.is_form()) {
            for size in Size::ALL {
                for driving in [ScheduleKind::Manual, ScheduleKind::Designed] {
                    all.push(Self { card: Some(card), size, driving });
                }
            }
        }
        all
    }

    /// Name of what is concealed.
    pub fn id(&self) -> &'static str {
        self.card.map_or(NOTHING_NAME, |card| card.id)
    }

    /// Key and value of the parameters that the ground knows, sizes at this part of the setting's.
    fn values(&self, part: f64) -> Vec<(&'static str, f64)> {
        let Some(card) = self.card else { return Vec::new() };
        let sheet = sheet_of(card.id);
        let parameters = card.parameters.iter().filter_map(|parameter| {
            let known = sheet?.parameters.iter().find(|other| other.key == parameter.key)?;
            let none = neutral(parameter);
            let value = match parameter.role {
                Role::Size { .. } => none + part * self.size.factor() * (parameter.typical - none),
                Role::Direction => parameter.typical + DIRECTION_OFFSET,
                _ => parameter.typical,
            };
            let low = known.range[0].max(parameter.range[0]);
            Some((parameter.key, value.clamp(low, known.range[1].min(parameter.range[1]))))
        });
        parameters.collect()
    }

    /// Whether the robot turns on the spot with these values.
    fn turns(&self, vehicle: &Vehicle, values: &[(&'static str, f64)]) -> bool {
        let effect = self.card.map(|card| ActiveEffect::new(card.id, values).expect("in range"));
        let model = Model::new(vehicle.clone(), effect.into_iter().collect());
        let spin = Stationary::new(&model, &Circumstance::default()).solve(SPIN);
        spin.status == Status::Turning
    }
}

/// A size that was found, against what it is.
pub struct Found {
    /// Estimate over truth, both as distances from no effect.
    pub ratio: f64,
    /// Whether the interval of 95 % holds the truth.
    pub covered: bool,
}

/// What came of a setting.
pub struct Case {
    /// What was concealed, as `key=value`.
    pub truth: String,
    /// The status, or why there is no diagnosis.
    pub status: String,
    /// Answers beside the clock; members of one answer are joined by `|`.
    pub named: Vec<String>,
    /// p and ln Bayes factor of the answer with the truth in it.
    pub support: Option<(f64, f64)>,
    /// Its sizes where it stands alone.
    pub found: Vec<Found>,
    /// Share of the excess on held-out runs that the corrected model explains.
    pub explained: Option<f64>,
    /// Time of the diagnosis, s.
    pub seconds: f64,
}

impl Case {
    /// Simulates and diagnoses.
    pub fn of(setting: &Setting, count: usize) -> Self {
        let schedules = runs(setting.driving, count, 1);
        let vehicle = owned(&[]).vehicle;
        let sensors = sensors(Preset::Laboratory);
        let mut reason = String::new();
        for shrinks in 0..SHRINKS {
            let values = setting.values(SHRINK_FACTOR.powi(i32::try_from(shrinks).unwrap_or(0)));
            let truth: Vec<String> =
                values.iter().map(|(key, value)| format!("{key}={value:.6}")).collect();
            let concealed = format!("{}:{}", setting.id(), truth.join(","));
            let concealed: Vec<&str> =
                setting.card.map(|_| concealed.as_str()).into_iter().collect();
            if !setting.turns(&vehicle, &values) {
                "does not turn".clone_into(&mut reason);
                continue;
            }
            match Drive::new(&vehicle, &concealed, &schedules, 1) {
                Ok(drive) => {
                    let recording = drive.recording(&sensors, 1);
                    let begun = Instant::now();
                    let diagnosis = diagnosed(&recording, &owned(&concealed));
                    let seconds = begun.elapsed().as_secs_f64();
                    return match diagnosis {
                        Ok(diagnosis) => Self {
                            truth: truth.join(" "),
                            seconds,
                            ..Self::answered(&diagnosis, setting, &values, &sensors)
                        },
                        Err(error) => Self { seconds, ..Self::without(&error.to_string()) },
                    };
                }
                Err(why) => reason = why,
            }
        }
        Self::without(&reason)
    }

    fn without(reason: &str) -> Self {
        Self {
            truth: String::new(),
            status: reason.replace(',', ";"),
            named: Vec::new(),
            support: None,
            found: Vec::new(),
            explained: None,
            seconds: 0.0,
        }
    }

    fn answered(
        diagnosis: &Diagnosis,
        setting: &Setting,
        values: &[(&'static str, f64)],
        sensors: &Sensors,
    ) -> Self {
        let truth = setting.id();
        let alone = |missing: &&Missing| missing.verdict.one_of.len() == 1;
        let answers = diagnosis.answer.missing.iter();
        let answers = answers.filter(|missing| {
            truth == CLOCK
                || !(missing.kind == Kind::Instrument && members(missing).contains(CLOCK))
        });
        let named = answers.map(|missing| {
            let ids: Vec<&str> = members(missing).into_iter().collect();
            let constants = if missing.kind == Kind::Constant { CONSTANTS } else { "" };
            let colon = if constants.is_empty() { "" } else { ":" };
            format!("{constants}{colon}{}", ids.join("|"))
        });
        let own = diagnosis.answer.missing.iter().find(|missing| members(missing).contains(truth));
        let found = own.filter(alone).map(|missing| sizes(missing, values, sensors));
        Self {
            truth: String::new(),
            status: diagnosis.answer.status.name().to_owned(),
            named: named.collect(),
            support: own.map(|own| (own.verdict.support.p, own.verdict.support.ln_bayes_factor)),
            found: found.unwrap_or_default(),
            explained: diagnosis.evidence.errors.excess_explained(),
            seconds: 0.0,
        }
    }

    /// In a few words.
    pub fn in_short(&self) -> String {
        let named =
            if self.named.is_empty() { NOTHING_NAME.to_owned() } else { self.named.join("; ") };
        format!("{}, {named}, {:.1} s", self.status, self.seconds)
    }
}

/// The sizes of an answer against the truth.
fn sizes(missing: &Missing, values: &[(&'static str, f64)], sensors: &Sensors) -> Vec<Found> {
    let sizes = missing.parameters.iter().filter_map(|interval| {
        let parameter = interval.unknown.parameter()?;
        let Role::Size { .. } = parameter.role else { return None };
        let (key, truth) = values.iter().find(|(key, _)| *key == parameter.key)?;
        // Beside what is concealed, the stamps of these sensors are late by themselves.
        let late = if *key == "delay_s" { sensors.clock_offset() } else { 0.0 };
        let (truth, none) = (truth + late, neutral(parameter));
        Some(Found {
            ratio: (interval.value - none) / (truth - none),
            covered: (interval.low..=interval.high).contains(&truth),
        })
    });
    sizes.collect()
}
