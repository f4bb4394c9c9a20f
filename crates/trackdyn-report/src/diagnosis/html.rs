//! The report: one page that needs nothing beside itself.

use super::candidates::{Outcome, candidates};
use super::first::First;
use super::live::Live;
use super::words::{id, ids, probability, significant, with_interval};
use super::{Subject, answer};
use crate::Error;
use crate::figure::Figure;
use crate::ticks::number;
use minijinja::Environment;
use minijinja::value::Serde;
use serde::Serialize;
use std::collections::BTreeSet;
use trackdyn_diagnose::Settings;
use trackdyn_diagnose::diagnosis::Kind;
use trackdyn_diagnose::document::separate_by;
use trackdyn_diagnose::evidence::Origin;
use trackdyn_diagnose::verdict::{Refusal, Rule};

const NAME: &str = "page.html";

/// How the page looks.
const STYLE: &str = concat!(
    include_str!("../../assets/uPlot/uPlot.min.css"),
    "\n",
    include_str!("report/page.css")
);

/// What lets a reader look closely: uPlot with its licence, and what uses it.
const SCRIPT: &str = concat!(
    "/*\n",
    include_str!("../../assets/uPlot/LICENSE"),
    "*/\n",
    include_str!("../../assets/uPlot/uPlot.iife.min.js"),
    "\n",
    include_str!("report/page.js")
);

/// What the template is given.
#[derive(Serialize)]
struct Page<'a> {
    name: &'a str,
    vehicle: &'a str,
    status: &'a str,
    status_id: &'a str,
    tone: &'a str,
    first: First,
    answer: Vec<[String; 2]>,
    missing: Vec<Missing>,
    classes: Vec<Class>,
    refused: Vec<Row>,
    figures: Vec<Picture<'a>>,
    candidates: Vec<Candidate>,
    limits: Vec<Limit>,
    rules: Vec<String>,
    evidence: String,
    noise: String,
    source: Option<&'a toml::Table>,
    caption: &'a str,
    style: &'static str,
    script: &'static str,
    live: Live,
}

#[derive(Serialize)]
struct Missing {
    name: String,
    title: String,
    law: String,
    shows: String,
    resembling: String,
    parameters: Vec<Parameter>,
    support: Vec<Row>,
}

#[derive(Serialize)]
struct Parameter {
    key: String,
    meaning: String,
    value: String,
    low: String,
    high: String,
    unit: String,
}

#[derive(Serialize)]
struct Row {
    name: String,
    text: String,
}

#[derive(Serialize)]
struct Class {
    question: &'static str,
    members: Vec<Row>,
    decides: String,
}

#[derive(Serialize)]
struct Picture<'a> {
    name: &'a str,
    file: String,
    title: &'a str,
    reading: &'a str,
    svg: String,
}

#[derive(Serialize)]
struct Candidate {
    id: String,
    title: String,
    gain: String,
    z: String,
    sizes: String,
    reason: String,
    tone: &'static str,
}

#[derive(Serialize)]
struct Limit {
    id: String,
    meaning: String,
    size: String,
    typical: String,
}

/// The report as HTML with all figures inside.
///
/// The text depends on the arguments only.
///
/// # Errors
/// [`Error`] where a figure cannot be drawn or the page cannot be filled in.
pub fn diagnosis_html(subject: &Subject, figures: &[Figure]) -> Result<String, Error> {
    let mut environment = Environment::new();
    environment.add_template(NAME, include_str!("report/page.html"))?;
    Ok(environment.get_template(NAME)?.render(Serde(page(subject, figures)?))?)
}

fn page<'a>(subject: &Subject<'a>, figures: &'a [Figure]) -> Result<Page<'a>, Error> {
    let (diagnosis, evidence) = (subject.diagnosis, subject.evidence());
    let [status, tone] = answer::status(subject);
    let refused = diagnosis.answer.refused.iter().map(|verdict| Row {
        name: ids(&verdict.one_of, " or "),
        text: verdict.refused.as_ref().map_or_else(String::new, Refusal::to_string),
    });
    let live = Live::of(subject, figures)?;
    let figures = figures.iter().map(|figure| {
        let svg = figure.to_svg_element()?;
        Ok(Picture {
            name: &figure.name,
            file: figure.file(),
            title: &figure.title,
            reading: &figure.reading,
            svg,
        })
    });
    let unit = match evidence.origin() {
        Origin::Drive(_) => "segments of driving",
        Origin::SteadyPoints(_) => "points of steady motion",
    };
    let samples: usize = subject.views().iter().map(|view| view.evidence.samples().len()).sum();
    let held_out =
        diagnosis.evidence.unseen.as_ref().map_or("none were held out".to_owned(), |unseen| {
            let samples = unseen.evidence.samples().iter();
            let held_out = samples.map(|sample| sample.run).collect::<BTreeSet<usize>>().len();
            let what = evidence.origin().runs();
            format!("{held_out} of {} {what} were held out", evidence.runs().len())
        });
    Ok(Page {
        name: subject.name,
        vehicle: &subject.vehicle.vehicle.name,
        status,
        status_id: diagnosis.answer.status.name(),
        tone,
        first: First::of(subject),
        answer: answer::parts(subject),
        missing: missing(subject),
        classes: classes(subject),
        refused: refused.collect(),
        figures: figures.collect::<Result<_, Error>>()?,
        candidates: rows(subject),
        limits: limits(subject),
        rules: rules(diagnosis.evidence.seen.settings()),
        evidence: format!("{samples} {unit}; {held_out}"),
        noise: noise(subject),
        source: subject.file.source.as_ref(),
        caption: subject.caption,
        style: STYLE,
        script: SCRIPT,
        live,
    })
}

fn missing(subject: &Subject) -> Vec<Missing> {
    let missing = subject.diagnosis.answer.missing.iter();
    missing
        .map(|missing| {
            let card = missing.verdict.effect.card();
            let support = &missing.verdict.support;
            let parameters = missing.parameters.iter().filter_map(|interval| {
                let parameter = interval.unknown.parameter()?;
                let [value, low, high] = with_interval(interval);
                Some(Parameter {
                    key: parameter.key.to_owned(),
                    meaning: parameter.meaning.to_owned(),
                    value,
                    low,
                    high,
                    unit: if parameter.unit == "1" { "–" } else { parameter.unit }.to_owned(),
                })
            });
            let row = |name: &str, text: String| Row { name: name.to_owned(), text };
            let constant = missing.kind == Kind::Constant;
            Missing {
                name: answer::some(&missing.verdict.one_of),
                title: if constant {
                    "A wrong number: constant ICRs other than those of the vehicle file".to_owned()
                } else {
                    card.title.to_owned()
                },
                law: if constant { String::new() } else { card.law.to_owned() },
                shows: if constant { String::new() } else { card.shows.to_owned() },
                resembling: missing.resembling(),
                parameters: parameters.collect(),
                support: vec![
                    row("probability of chance", probability(support.p)),
                    row(
                        "ln Bayes factor against the best answer without it",
                        number(support.ln_bayes_factor, 1),
                    ),
                    row(
                        "gain of log-likelihood on blocks left out of the fit",
                        format!(
                            "{} ± {}",
                            number(support.held_out_gain, 1),
                            number(support.held_out_error, 1)
                        ),
                    ),
                    row(
                        "resampled recordings that name the same",
                        format!("{} %", number(100.0 * support.stable, 0)),
                    ),
                ],
            }
        })
        .collect()
}

fn classes(subject: &Subject) -> Vec<Class> {
    let missing = subject.diagnosis.answer.missing.iter();
    missing
        .filter(|missing| missing.verdict.one_of.len() > 1)
        .map(|missing| Class {
            question: if missing.kind == Kind::Constant {
                "Which number is it?"
            } else {
                "Which of them is it?"
            },
            members: missing
                .verdict
                .one_of
                .iter()
                .map(|&effect| Row {
                    name: id(effect).to_owned(),
                    text: effect.card().title.to_owned(),
                })
                .collect(),
            decides: separate_by(missing),
        })
        .collect()
}

fn rows(subject: &Subject) -> Vec<Candidate> {
    candidates(subject)
        .into_iter()
        .map(|one| Candidate {
            id: id(one.effect).to_owned(),
            title: one.effect.card().title.to_owned(),
            gain: one.gain.map_or("–".to_owned(), |gain| number(gain, 1)),
            z: one.z.map_or("–".to_owned(), |z| number(z, 1)),
            sizes: one.sizes,
            reason: one.reason,
            tone: match one.outcome {
                Outcome::Claimed => "claimed",
                Outcome::Twin => "twin",
                _ => "lost",
            },
        })
        .collect()
}

fn limits(subject: &Subject) -> Vec<Limit> {
    let mut detectable = subject.diagnosis.limits.detectable.clone();
    detectable.sort_by_key(|one| (one.effect, one.parameter));
    detectable
        .iter()
        .map(|one| {
            let parameter = &one.effect.card().parameters[one.parameter];
            let typical = trackdyn_diagnose::hypothesis::typical_size(parameter);
            Limit {
                id: id(one.effect).to_owned(),
                meaning: format!("{}: {}", parameter.key, parameter.meaning),
                size: one.size.map_or_else(
                    || "no physical size would show".to_owned(),
                    |size| format!("{}{}", significant(size, 3), parameter.unit_behind()),
                ),
                typical: format!("{}{}", significant(typical, 3), parameter.unit_behind()),
            }
        })
        .collect()
}

/// Every rule by which a claim can be refused.
fn rules(settings: &Settings) -> Vec<String> {
    Rule::ALL.iter().map(|rule| rule.sentence(settings)).collect()
}

fn noise(subject: &Subject) -> String {
    let scale = subject.diagnosis.evidence.seen.scale();
    let taken = subject.evidence().description();
    let taken = subject.diagnosis.evidence.seen.noise().map_or_else(
        || taken.to_owned(),
        |noise| format!("{taken}: {}", trackdyn_diagnose::noise::sentence(noise)),
    );
    if scale == [1.0; 3] {
        return format!(
            "{taken}. It was left as it is: what no effect explains is no larger than it."
        );
    }
    let [forward, left, yaw] = scale.map(|scale| number(scale, 2));
    format!(
        "{taken}. What no effect explains is larger than it, so the noise was taken to be \
         {forward} (forward), {left} (left) and {yaw} (yaw) times as large, which makes every \
         claim less sure."
    )
}
