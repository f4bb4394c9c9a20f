//! What the page lets a reader look at closely: values of figures, as compact JSON.
//!
//! Numbers are whole multiples of a step that stands beside them: short, and never more digits than
//! a figure shows.

mod lines;
mod paths;
mod plane;
mod steps;
mod times;

use super::log::{self, Log};
use super::{Subject, path, timeline};
use crate::Error;
use crate::figure::Figure;
use paths::{Paths, paths};
use plane::{Plane, plane};
use serde::Serialize;
use steps::{TIME, near};
use times::{Times, times};

/// Poses of all paths at most, about.
const POSES: usize = 2400;

/// All that is looked at closely.
#[derive(Serialize)]
struct All {
    runs: Vec<Run>,
    #[serde(skip_serializing_if = "Option::is_none")]
    time: Option<Times>,
    plane: Plane,
    paths: Paths,
}

/// A run on the axis of time.
#[derive(Serialize)]
struct Run {
    name: String,
    held: bool,
    /// Where it begins on the axis, the stamp of that moment, and how long it lasts, s.
    at: f64,
    start: f64,
    long: f64,
}

/// Values for the page.
#[derive(Serialize)]
pub(super) struct Live {
    /// The JSON, safe inside an element of script.
    values: String,
    /// Whether there is a time to look at.
    has_time: bool,
    /// What grey is, and what is not shown of a long log.
    note: String,
}

impl Live {
    /// Values of these figures of a diagnosis, and all paths.
    pub(super) fn of(subject: &Subject, figures: &[Figure]) -> Result<Self, Error> {
        let named = |name: &str| figures.iter().find(|figure| figure.name == name);
        let log = Log::of(subject);
        let samples = log.as_ref().map_or(0, |log| log.entries.len());
        let each = samples.div_ceil(POSES).max(1);
        let pieces = path::pieces(subject, each);
        let all = All {
            runs: log.as_ref().map_or_else(Vec::new, |log| runs(log, subject.evidence().begin())),
            time: named("time").map(times),
            plane: named("plane").map(plane).unwrap_or_default(),
            paths: log.as_ref().map_or_else(Paths::default, |log| paths(log, &pieces)),
        };
        Ok(Self {
            // a name that holds the end of the element would end it
            values: serde_json::to_string(&all)?.replace('<', "\\u003c"),
            has_time: all.time.is_some(),
            note: note(log.as_ref(), each),
        })
    }
}

/// What grey is, and what is left out of a long log.
fn note(log: Option<&Log>, each: usize) -> String {
    let is_held_out = log.is_some_and(|log| log.runs.iter().any(|run| run.is_held_out));
    let grey = is_held_out.then(|| "Held-out runs lie on grey.".to_owned());
    let thinned = log.and_then(timeline::thinned);
    let poses = (each > 1).then(|| format!("Paths show one pose in {each}."));
    [grey, thinned, poses].into_iter().flatten().collect::<Vec<_>>().join(" ")
}

/// The runs of a log whose times are counted from `begin`, s.
fn runs(log: &Log, begin: f64) -> Vec<Run> {
    let run = |run: &log::Run| Run {
        name: format!("run {}", run.name),
        held: run.is_held_out,
        at: near(run.at, TIME),
        start: near(begin + run.start, TIME),
        long: near(run.duration, TIME),
    };
    log.runs.iter().map(run).collect()
}
