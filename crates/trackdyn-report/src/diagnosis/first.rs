//! The first screen: what the model lacks, how sure that is, what it costs, and what to do next.
//!
//! Its numbers are those of `diagnosis.toml`.

mod costs;
mod lacks;
mod next;

use super::Subject;
use super::answer::waves;
use costs::Cost;
use lacks::Lack;
use next::Step;
use serde::Serialize;
use trackdyn_diagnose::Status;
use trackdyn_diagnose::diagnosis::Kind;

/// What the top of the page shows.
#[derive(Serialize)]
pub(super) struct First {
    verdict: String,
    lacks: Vec<Lack>,
    /// Waves of the ground or of a belt, a sentence each.
    waves: Vec<String>,
    sure: String,
    /// What held-out runs say against it; empty where they say nothing.
    warning: String,
    costs: Vec<Cost>,
    next: Vec<Step>,
}

/// A number of the file, and how the page writes it.
#[derive(Serialize)]
struct Shown {
    data: f64,
    text: String,
}

impl First {
    /// The first screen of a diagnosis.
    pub(super) fn of(subject: &Subject) -> Self {
        Self {
            verdict: verdict(subject),
            lacks: lacks::of(subject),
            waves: waves(subject),
            sure: sure(subject),
            warning: subject.diagnosis.contradiction().unwrap_or_default(),
            costs: costs::of(subject),
            next: next::of(subject),
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
    let nameless =
        (answer.status == Status::Unexplained).then(|| "something that has no name".into());
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
    let open = answer.missing.iter().filter(|missing| missing.verdict.one_of.len() > 1).count();
    let which = match (answer.status, open == answer.missing.len()) {
        (Status::Ambiguous, true) => "; this log leaves open which".to_owned(),
        (Status::Ambiguous, false) => format!("; of {} this log leaves open which", in_words(open)),
        _ => String::new(),
    };
    format!("The model of {vehicle} {}{which}", parts.join(" and "))
}

fn in_words(count: usize) -> String {
    const WORDS: [&str; 10] =
        ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"];
    WORDS.get(count).map_or_else(|| count.to_string(), |word| (*word).to_owned())
}

/// How sure the answer is, in words.
fn sure(subject: &Subject) -> String {
    let runs = subject.evidence().origin().runs();
    let judged = if subject.file.fit.are_held_out {
        format!("Costs are those of {runs} that nothing was fitted to.")
    } else {
        format!("Costs are those of the very {runs} of the fit, for none were held out.")
    };
    match subject.diagnosis.answer.status {
        Status::NothingMissing => {
            format!("No effect is missing that is larger than its detection limit. {judged}")
        }
        Status::Explained => format!(
            "Every claim has passed all tests of a claim, against chance and against its rivals. \
             {judged}"
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
