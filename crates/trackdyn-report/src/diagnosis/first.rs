//! The first screen: what the model lacks, how sure that is, what it costs, and what to do next.
//!
//! Its numbers are those of `diagnosis.toml`.

use super::Subject;
use super::words::{probability, significant, sized};
use crate::ticks::number;
use serde::Serialize;
use trackdyn_diagnose::Status;
use trackdyn_diagnose::diagnosis::{Kind, Missing};
use trackdyn_diagnose::document::{ComparedTable, DiagnosisFile, MissingTable, separate_by};
use trackdyn_diagnose::evidence::Origin;
use trackdyn_diagnose::hypothesis::Unknown;

/// What the top of the page shows.
#[derive(Serialize)]
pub(super) struct First {
    verdict: String,
    lacks: Vec<Lack>,
    sure: String,
    /// What held-out runs say against it; empty where they say nothing.
    warning: String,
    costs: Vec<Cost>,
    next: Vec<Step>,
}

/// A claim.
#[derive(Serialize)]
struct Lack {
    title: String,
    ids: String,
    sizes: Vec<Size>,
    chance: Shown,
}

/// A size with its interval.
#[derive(Serialize)]
struct Size {
    meaning: String,
    value: Shown,
    low: Shown,
    high: Shown,
    unit: String,
}

/// A number of the file, and how the page writes it.
#[derive(Serialize)]
struct Shown {
    data: f64,
    text: String,
}

/// What it costs before, and what remains after.
#[derive(Serialize)]
struct Cost {
    name: &'static str,
    unit: &'static str,
    note: String,
    /// What the noise of the poses makes of it; none where nothing is known.
    noise: Option<Shown>,
    rows: Vec<Row>,
}

/// A number with its interval and the length of its bar.
#[derive(Serialize)]
struct Row {
    when: &'static str,
    value: Shown,
    interval: Option<[Shown; 2]>,
    /// Per cent of the longest bar.
    length: f64,
}

/// Something to do, and what to type.
#[derive(Serialize)]
struct Step {
    text: String,
    command: &'static str,
}

impl First {
    /// The first screen of a diagnosis.
    pub(super) fn of(subject: &Subject) -> Self {
        let missing = subject.diagnosis.answer.missing.iter().zip(&subject.file.missing);
        let lacks: Vec<Lack> = missing.map(|(missing, table)| lack(missing, table)).collect();
        Self {
            verdict: verdict(subject),
            sure: sure(subject),
            lacks,
            warning: subject.diagnosis.contradiction().unwrap_or_default(),
            costs: costs(subject),
            next: next(subject),
        }
    }
}

/// The answer in a sentence.
fn verdict(subject: &Subject) -> String {
    let vehicle = &subject.vehicle.vehicle.name;
    let answer = &subject.diagnosis.answer;
    if answer.status == Status::NothingMissing {
        return format!("The model of {vehicle} explains this log");
    }
    let count = |kind: Kind| answer.missing.iter().filter(|missing| missing.kind == kind).count();
    let counted = |count: usize, one: &str, more: &str| match count {
        0 => None,
        1 => Some(one.to_owned()),
        _ => Some(format!("{} {more}", in_words(count))),
    };
    let nameless = (answer.status == Status::Unexplained).then(|| "a force without a name".into());
    let lacks = [
        counted(count(Kind::Physics), "one effect", "effects"),
        counted(
            count(Kind::Instrument),
            "one property of its sensors",
            "properties of its sensors",
        ),
        nameless,
    ];
    let lacks: Vec<String> = lacks.into_iter().flatten().collect();
    let lacks = lacks.split_last().map(|(last, others)| match others {
        [] => format!("lacks {last}"),
        _ => format!("lacks {} and {last}", others.join(", ")),
    });
    let wrong = counted(count(Kind::Constant), "a wrong number", "wrong numbers");
    let wrong = wrong.map(|wrong| format!("has {wrong}"));
    let parts: Vec<String> = lacks.into_iter().chain(wrong).collect();
    let which = match answer.status {
        Status::Ambiguous => "; this log leaves open which",
        _ => "",
    };
    format!("The model of {vehicle} {}{which}", parts.join(" and "))
}

fn in_words(count: usize) -> String {
    const WORDS: [&str; 10] =
        ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"];
    WORDS.get(count).map_or_else(|| count.to_string(), |word| (*word).to_owned())
}

fn lack(missing: &Missing, table: &MissingTable) -> Lack {
    let is_constant = missing.kind == Kind::Constant;
    let several = table.one_of.len() > 1;
    let title = if is_constant {
        "A number of the vehicle file is off, not its physics".to_owned()
    } else if several {
        let titles = missing.verdict.one_of.iter().map(|effect| effect.card().title);
        format!("One of: {}", titles.collect::<Vec<_>>().join("; "))
    } else {
        missing.verdict.effect.card().title.to_owned()
    };
    let unknowns = missing.parameters.iter().filter_map(|interval| {
        interval.unknown.parameter().map(|parameter| (interval.unknown, parameter))
    });
    let own = unknowns.zip(&table.parameters).filter(|((unknown, _), _)| {
        matches!(unknown, Unknown::Effect(effect, _) if *effect == missing.verdict.effect)
    });
    let sizes = own.map(|((_, parameter), of)| {
        let [value, low, high] = [of.value, of.low95, of.high95];
        let [value_text, low_text, high_text] = sized([value, low, high]);
        Size {
            meaning: parameter.meaning.to_owned(),
            value: Shown { data: value, text: value_text },
            low: Shown { data: low, text: low_text },
            high: Shown { data: high, text: high_text },
            unit: parameter.unit_behind(),
        }
    });
    let p = table.evidence.p;
    Lack {
        title,
        ids: table.one_of.join(" or "),
        sizes: sizes.collect(),
        chance: Shown { data: p, text: probability(p) },
    }
}

/// How sure the answer is, in words.
fn sure(subject: &Subject) -> String {
    let DiagnosisFile { fit, .. } = subject.file;
    let runs = subject.evidence().origin().runs();
    let on = if fit.are_held_out {
        format!("{runs} that nothing was fitted to")
    } else {
        format!("the {runs} of the fit, for none were held out")
    };
    let errors = format!("predicts {on}");
    match subject.diagnosis.answer.status {
        Status::NothingMissing => format!(
            "The model {errors} as well as their noise allows. An effect below its detection limit \
             may still be there."
        ),
        Status::Explained => format!(
            "Every claim has passed all tests of a claim, each against chance and against its \
             rivals, and the corrected model {errors}."
        ),
        Status::Ambiguous => "That the model is off is sure. Where several causes are named, this \
                              log cannot tell which it is: each would look the same in it."
            .to_owned(),
        Status::Unexplained if subject.file.missing.is_empty() => {
            "That something is missing is sure. What it is, is not: no effect of the catalogue, \
             nor two or three of them, leaves only noise."
                .to_owned()
        }
        Status::Unexplained => "What is named is surely part of it. The corrected model still \
                                departs from the log, so there is more."
            .to_owned(),
    }
}

/// What the model costs: drifts of dead reckoning, and how far it departs from the log.
fn costs(subject: &Subject) -> Vec<Cost> {
    let DiagnosisFile { fit, drift, .. } = subject.file;
    let turns = |turns: f64| match turns {
        turns if turns >= 1.0 => "turns",
        turns if turns >= 0.5 => "half turns",
        _ => "quarter turns",
    };
    let yaw = drift.yaw_deg_per_turn.as_ref().map(|of| {
        let note = format!("measured on {} {}", of.pieces, turns(of.piece));
        compared("Heading lost per full turn", "°", note, of)
    });
    let place = drift.place_m_per_100_m.as_ref().map(|of| {
        let note = format!("measured on {} pieces of {} m", of.pieces, number(of.piece, 0));
        compared("Place lost per 100 m", " m", note, of)
    });
    let fitted = if subject.diagnosis.blames_instruments() {
        "constant ICRs"
    } else {
        "constant ICRs, clock and sensor"
    };
    let rows = [("before", fit.held_out_before), ("after", fit.held_out_after)];
    let most = fit.held_out_before.max(fit.held_out_after);
    let row = |(when, value): (&'static str, f64)| Row {
        when,
        value: Shown { data: value, text: number(value, 3) },
        interval: None,
        length: share(value, most),
    };
    let departure = Cost {
        name: "Departure from the log",
        unit: " × noise",
        note: format!(
            "noise alone leaves {}; {fitted} fitted before, too",
            number(fit.noise_floor, 3)
        ),
        noise: None,
        rows: rows.map(row).into(),
    };
    yaw.into_iter().chain(place).chain([departure]).collect()
}

fn compared(name: &'static str, unit: &'static str, note: String, of: &ComparedTable) -> Cost {
    let rows = [("as filed", of.before, of.before95), ("corrected", of.after, of.after95)];
    let most = of.before.max(of.after);
    let row = |(when, value, interval): (&'static str, f64, Option<[f64; 2]>)| {
        let [low, high] = interval.unwrap_or([value, value]);
        let [value_text, low_text, high_text] = sized([value, low, high]);
        Row {
            when,
            value: Shown { data: value, text: value_text },
            interval: interval.map(|[low, high]| {
                [Shown { data: low, text: low_text }, Shown { data: high, text: high_text }]
            }),
            length: share(value, most),
        }
    };
    // a correction that changes nothing is none
    let count = if of.before == of.after { 1 } else { 2 };
    let noise = Shown { data: of.pose_noise, text: significant(of.pose_noise, 2) };
    Cost {
        name,
        unit,
        note,
        noise: Some(noise),
        rows: rows.into_iter().take(count).map(row).collect(),
    }
}

/// Per cent of the largest, to a tenth.
fn share(value: f64, most: f64) -> f64 {
    if most > 0.0 { (1000.0 * value / most).round() / 10.0 } else { 0.0 }
}

/// What to do next.
fn next(subject: &Subject) -> Vec<Step> {
    let step = |text: &str, command: &'static str| Step { text: text.to_owned(), command };
    let answer = &subject.diagnosis.answer;
    let is_table = matches!(subject.evidence().origin(), Origin::SteadyPoints(_));
    let again = "trackdyn diagnose NEW_LOG --vehicle vehicle.corrected.toml";
    let mut steps = Vec::new();
    if subject.diagnosis.contradiction().is_some() {
        steps.push(step(
            "Drive on without the correction: runs that nothing was fitted to \
                         contradict it.",
            "",
        ));
    }
    match answer.status {
        Status::NothingMissing => {
            steps.push(step("Keep the vehicle file as it is.", ""));
            steps.push(step(
                "Read the detection limits before you rule an effect out: what is smaller than its \
                 limit would not have shown.",
                "",
            ));
        }
        Status::Explained => {
            steps.push(step(
                "Take vehicle.corrected.toml in place of the vehicle file: to simulate, to map, to \
                 replay.",
                "trackdyn map --vehicle vehicle.corrected.toml",
            ));
            if answer.missing.iter().any(|missing| missing.kind == Kind::Instrument) {
                steps.push(step(
                    "Mend what concerns clock and sensors where it arises, if you can: then \
                     nothing has to be corrected.",
                    "",
                ));
            }
            steps.push(step("Check it on a new log: nothing should be missing any more.", again));
        }
        Status::Ambiguous => {
            let open = answer.missing.iter().filter(|missing| missing.verdict.one_of.len() > 1);
            let (constants, effects): (Vec<_>, Vec<_>) =
                open.partition(|missing| missing.kind == Kind::Constant);
            let is_open = !effects.is_empty();
            if is_open {
                steps.push(step(
                    "Drive what tells them apart.",
                    "trackdyn plan --diagnosis diagnosis.toml --out plan",
                ));
            }
            for missing in constants {
                steps.push(step(
                    &format!("What tells which number it is: {}.", separate_by(missing)),
                    "",
                ));
            }
            if is_open && !is_table {
                steps.push(step("Diagnose the old and the new log together.", BOTH));
            }
            steps.push(step(
                "Until then vehicle.corrected.toml takes the first of each: good to predict \
                 driving like this, not to reason about causes.",
                "",
            ));
        }
        Status::Unexplained => {
            let look = if is_table {
                "Look below at which track speeds the points depart."
            } else {
                "Look below where and when the robot departs: choose a dark cell to see its \
                 stretches of the log."
            };
            steps.push(step(look, ""));
            if !is_table {
                steps.push(step("Drive there again, and diagnose both logs together.", BOTH));
            }
            steps.push(step("Do not build on vehicle.corrected.toml beyond this log.", ""));
        }
    }
    steps
}

/// A diagnosis of two logs.
const BOTH: &str = "trackdyn diagnose LOG NEW_LOG --vehicle VEHICLE";
