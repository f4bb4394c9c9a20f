//! What the page lets a reader look at closely: values of figures, as compact JSON.
//!
//! Numbers are whole multiples of a step that stands beside them: short, and never more digits than
//! a figure shows.

use super::log::Log;
use super::path::{self, Piece};
use super::{Subject, timeline};
use crate::Error;
use crate::colour::hex;
use crate::figure::{Axis, Figure, Line, Paint, Panel, Scale, Series, Sign};
use serde::Serialize;

/// Poses of all paths at most, about.
const POSES: usize = 2400;

/// Steps of numbers: times (s), residuals (σ), speeds (m/s), places (m), errors of heading (°).
const TIME: f64 = 0.01;
const RESIDUAL: f64 = 0.01;
const SPEED: f64 = 0.001;
const PLACE: f64 = 0.001;
const ANGLE: f64 = 0.01;

/// Whole numbers of steps; none where there is no value.
type Steps = Vec<Option<i64>>;

/// All that is looked at closely.
#[derive(Serialize)]
struct All {
    runs: Vec<Run>,
    #[serde(skip_serializing_if = "Option::is_none")]
    time: Option<Times>,
    plane: Plane,
    paths: Vec<Paths>,
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

/// Lines over one axis of time.
#[derive(Serialize)]
struct Times {
    label: String,
    end: f64,
    step: f64,
    t: Vec<i64>,
    panels: Vec<Lines>,
}

/// Lines of a panel.
#[derive(Serialize)]
struct Lines {
    title: String,
    label: String,
    unit: String,
    range: [f64; 2],
    step: f64,
    lines: Vec<Named>,
}

#[derive(Serialize)]
struct Named {
    name: String,
    v: Steps,
}

/// Cells of the plane of track speeds, or points.
#[derive(Serialize)]
struct Plane {
    label: [String; 2],
    extent: f64,
    /// Half the side of a cell, m/s; none of points.
    #[serde(skip_serializing_if = "Option::is_none")]
    half: Option<f64>,
    step: f64,
    cells: Vec<[i64; 2]>,
    /// Stretches of the log of each cell: begin and end in turn.
    stretches: Vec<Vec<i64>>,
    panels: Vec<Values>,
}

#[derive(Serialize)]
struct Values {
    title: String,
    label: String,
    range: [f64; 2],
    colours: Vec<String>,
    step: f64,
    v: Steps,
}

/// A piece of the log, replayed.
#[derive(Serialize)]
struct Paths {
    /// Place of its run in the list of runs.
    run: usize,
    /// Where it begins on the axis of time, s.
    at: f64,
    /// What places are counted from, m.
    origin: [f64; 2],
    step: f64,
    t: Vec<i64>,
    lines: Vec<Way>,
    errors: Vec<Lines>,
}

#[derive(Serialize)]
struct Way {
    name: String,
    x: Vec<i64>,
    y: Vec<i64>,
}

/// Values for the page.
#[derive(Serialize)]
pub(super) struct Live {
    /// The JSON, safe inside an element of script.
    values: String,
    /// Whether there is a time to look at.
    has_time: bool,
    /// What is not shown of a long log; empty where all is.
    note: String,
}

impl Live {
    /// Values of these figures of a diagnosis, and all paths.
    pub(super) fn of(subject: &Subject, figures: &[Figure]) -> Result<Self, Error> {
        let named = |name: &str| figures.iter().find(|figure| figure.name == name);
        let log = Log::of(subject);
        let paths = path::pieces(subject, POSES);
        let paths = log.iter().flat_map(|log| paths.iter().filter_map(|piece| way(log, piece)));
        let all = All {
            runs: log.as_ref().map_or_else(Vec::new, |log| runs(log, subject.evidence().begin())),
            time: named("time").map(times),
            plane: named("plane").map(plane).unwrap_or_default(),
            paths: paths.collect(),
        };
        Ok(Self {
            // a name that holds the end of the element would end it
            values: serde_json::to_string(&all)?.replace('<', "\\u003c"),
            has_time: all.time.is_some(),
            note: log.and_then(|log| timeline::thinned(&log)).unwrap_or_default(),
        })
    }
}

/// The runs of a log whose times are counted from `begin`, s.
fn runs(log: &Log, begin: f64) -> Vec<Run> {
    let run = |run: &super::log::Run| Run {
        name: format!("run {}", run.name),
        held: run.is_held_out,
        at: near(run.at, TIME),
        start: near(begin + run.start, TIME),
        long: near(run.duration, TIME),
    };
    log.runs.iter().map(run).collect()
}

/// The figure over time: one axis for all lines, with a time without values where lines break.
fn times(figure: &Figure) -> Times {
    let lines = figure.panels.iter().flat_map(|panel| panel.series.iter().filter_map(line));
    let mut times: Vec<f64> = Vec::new();
    let mut breaks: Vec<f64> = Vec::new();
    for Line { points, .. } in lines {
        times.extend(points.iter().map(|point| point[0]));
        breaks.extend(points.first().map(|point| point[0]));
    }
    for all in [&mut times, &mut breaks] {
        all.sort_by(f64::total_cmp);
        all.dedup();
    }
    let before = |start: &f64| {
        let place = times.partition_point(|time| time < start);
        (place > 0).then(|| f64::midpoint(times[place - 1], *start))
    };
    let gaps: Vec<f64> = breaks.iter().filter_map(before).collect();
    times.extend(gaps);
    times.sort_by(f64::total_cmp);
    let axis = figure.panels.last().map(|panel| &panel.x);
    let panel = |panel: &Panel| {
        let step = if panel.y.unit == "σ" { RESIDUAL } else { SPEED };
        let of = |name: &str| {
            let mut values = vec![None; times.len()];
            for Line { points, .. } in named(panel, name) {
                for [time, value] in points {
                    values[times.partition_point(|other| other < time)] = Some(*value);
                }
            }
            Named { name: name.to_owned(), v: steps(values, step) }
        };
        Lines { lines: names(panel).into_iter().map(of).collect(), ..head(panel, step) }
    };
    Times {
        label: axis.map_or_else(String::new, Axis::label),
        end: near(axis.map_or(0.0, |axis| axis.range[1]), TIME),
        step: TIME,
        t: whole(times.iter().copied(), TIME),
        panels: figure.panels.iter().map(panel).collect(),
    }
}

/// The plane of track speeds: one list of cells, and the values of every panel.
fn plane(figure: &Figure) -> Plane {
    let mut cells: Vec<[i64; 2]> = Vec::new();
    let mut stretches = Vec::new();
    let mut half = None;
    let mut all = Vec::new();
    for panel in &figure.panels {
        for series in &panel.series {
            let Some((centres, side, values, scale)) = spots(series) else { continue };
            half = side;
            let mut places = Vec::with_capacity(centres.len());
            for (member, centre) in centres.iter().enumerate() {
                let cell = centre.map(|speed| step(speed, SPEED));
                // every steady point is a spot of its own
                let known = match side {
                    Some(_) => cells.iter().position(|other| *other == cell),
                    None => (member < cells.len() && cells[member] == cell).then_some(member),
                };
                places.push(known.unwrap_or_else(|| {
                    cells.push(cell);
                    let of = series.stretches.get(member).into_iter().flatten().flatten();
                    stretches.push(whole(of.copied(), TIME));
                    cells.len() - 1
                }));
            }
            all.push((panel, places, values, scale));
        }
    }
    let panel = |(panel, places, values, scale): &(&Panel, Vec<usize>, &Vec<f64>, &Scale)| {
        let mut all = vec![None; cells.len()];
        for (&place, value) in places.iter().zip(*values) {
            all[place] = Some(*value);
        }
        Values {
            title: panel.title.clone(),
            label: scale.label.clone(),
            range: scale.range.map(|end| near(end, RESIDUAL)),
            colours: scale.colours.anchors().iter().map(|colour| hex(*colour)).collect(),
            step: RESIDUAL,
            v: steps(all, RESIDUAL),
        }
    };
    let first = figure.panels.first();
    Plane {
        label: first.map_or_else(Default::default, |panel| [panel.x.label(), panel.y.label()]),
        extent: first.map_or(1.0, |panel| panel.x.range[1]),
        half,
        step: SPEED,
        panels: all.iter().map(panel).collect(),
        cells,
        stretches,
    }
}

impl Default for Plane {
    fn default() -> Self {
        plane(&Figure::new("plane", [0, 0]))
    }
}

/// Centres, half the side, values and their colours of cells or points.
type Spots<'a> = (Vec<[f64; 2]>, Option<f64>, &'a Vec<f64>, &'a Scale);

fn spots(series: &Series) -> Option<Spots<'_>> {
    match &series.sign {
        Sign::Boxes(of) => {
            let Some(Paint::Values { values, scale }) = &of.paint else { return None };
            let middle =
                |[a, b]: &[[f64; 2]; 2]| [f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1])];
            let half = of.boxes.first().map(|[a, b]| (b[0] - a[0]) / 2.0);
            Some((of.boxes.iter().map(middle).collect(), half, values, scale))
        }
        Sign::Points(of) => {
            let Paint::Values { values, scale } = &of.paint else { return None };
            Some((of.points.clone(), None, values, scale))
        }
        _ => None,
    }
}

/// A replayed piece of the log.
fn way(log: &Log, piece: &Piece) -> Option<Paths> {
    let run = log.runs.iter().position(|run| run.index == piece.run)?;
    let [paths, errors @ ..] = piece.figure.panels.as_slice() else { return None };
    let at = log.runs[run].at + piece.start - log.runs[run].start;
    let ways: Vec<(&str, &Line)> = names(paths)
        .into_iter()
        .filter_map(|name| Some((name, named(paths, name).next()?)))
        .collect();
    let origin = ways.first().and_then(|(_, line)| line.points.first())?.map(f64::round);
    let along =
        |line: &Line, k: usize| whole(line.points.iter().map(|point| point[k] - origin[k]), PLACE);
    let of_error = |panel: &Panel| {
        let step = if panel.y.unit == "m" { PLACE } else { ANGLE };
        let of = |name: &str| {
            let values = named(panel, name).flat_map(|line| &line.points);
            Named { name: name.to_owned(), v: steps(values.map(|point| Some(point[1])), step) }
        };
        Lines { lines: names(panel).into_iter().map(of).collect(), ..head(panel, step) }
    };
    let times = errors.first().and_then(|panel| panel.series.iter().find_map(line))?;
    Some(Paths {
        run,
        at: near(at, TIME),
        origin,
        step: PLACE,
        t: whole(times.points.iter().map(|point| point[0]), TIME),
        lines: ways
            .into_iter()
            .map(|(name, line)| Way { name: name.to_owned(), x: along(line, 0), y: along(line, 1) })
            .collect(),
        errors: errors.iter().map(of_error).collect(),
    })
}

fn head(panel: &Panel, step: f64) -> Lines {
    Lines {
        title: panel.title.clone(),
        label: panel.y.label(),
        unit: panel.y.unit.clone(),
        range: panel.y.range,
        step,
        lines: Vec::new(),
    }
}

fn line(series: &Series) -> Option<&Line> {
    match &series.sign {
        Sign::Line(line) => Some(line),
        _ => None,
    }
}

/// Lines of a name.
fn named<'p>(panel: &'p Panel, name: &'p str) -> impl Iterator<Item = &'p Line> {
    panel.series.iter().filter(move |series| series.name == name).filter_map(line)
}

/// Names of the lines of a panel, each once.
fn names(panel: &Panel) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for series in panel.series.iter().filter(|series| line(series).is_some()) {
        if !names.contains(&series.name.as_str()) {
            names.push(&series.name);
        }
    }
    names
}

/// The whole number of steps that is nearest.
#[expect(clippy::cast_possible_truncation, reason = "a float becomes the nearest whole number")]
fn step(value: f64, step: f64) -> i64 {
    (value / step).round() as i64
}

fn whole(values: impl Iterator<Item = f64>, by: f64) -> Vec<i64> {
    values.map(|value| step(value, by)).collect()
}

fn steps(values: impl IntoIterator<Item = Option<f64>>, by: f64) -> Steps {
    values.into_iter().map(|value| value.map(|value| step(value, by))).collect()
}

/// The nearest multiple of a step, with its digits only.
fn near(value: f64, by: f64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a few digits")]
    let steps = step(value, by) as f64;
    steps / by.recip().round()
}
