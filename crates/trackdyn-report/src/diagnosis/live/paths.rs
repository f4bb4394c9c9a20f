//! Pieces of the log, replayed.

use super::lines::{Lines, Named, head, line, named, names};
use super::steps::{ANGLE, PLACE, TIME, near, steps, whole};
use crate::diagnosis::log::Log;
use crate::diagnosis::path::Piece;
use crate::figure::{Line, Panel};
use serde::Serialize;

/// A piece of the log, replayed.
#[derive(Serialize)]
pub(super) struct Paths {
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

/// A replayed piece; none of a run that is not in the log.
pub(super) fn paths(log: &Log, piece: &Piece) -> Option<Paths> {
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
