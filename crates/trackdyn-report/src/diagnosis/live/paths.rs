//! Pieces of the log, replayed.

use super::lines::{line, named, names};
use super::steps::{ANGLE, PLACE, TIME, near, whole};
use crate::diagnosis::log::Log;
use crate::diagnosis::path;
use crate::figure::{Line, Panel};
use serde::Serialize;

/// Paths of all pieces, and what their numbers are.
#[derive(Default, Serialize)]
pub(super) struct Paths {
    /// Names of the paths: the observed one first.
    names: Vec<String>,
    /// Step of places, m.
    step: f64,
    /// Errors of all paths but the first.
    errors: Vec<Errors>,
    pieces: Vec<Piece>,
}

/// What an error is of.
#[derive(Serialize)]
struct Errors {
    title: String,
    unit: String,
    step: f64,
}

/// A piece of the log, replayed.
#[derive(Serialize)]
struct Piece {
    /// Place of its run in the list of runs.
    run: usize,
    /// Where it begins on the axis of time, s.
    at: f64,
    /// What places are counted from, m.
    origin: [f64; 2],
    t: Vec<i64>,
    /// Places of each path.
    x: Vec<Vec<i64>>,
    y: Vec<Vec<i64>>,
    /// Of each error, its values for each path.
    errors: Vec<Vec<Vec<i64>>>,
}

/// All pieces.
pub(super) fn paths(log: &Log, pieces: &[path::Piece]) -> Paths {
    let first = pieces.first().map(|piece| piece.figure.panels.as_slice());
    let Some([paths, errors @ ..]) = first else { return Paths::default() };
    let head = |panel: &Panel| Errors {
        title: panel.title.clone(),
        unit: panel.y.unit.clone(),
        step: error_step(panel),
    };
    Paths {
        names: names(paths).into_iter().map(str::to_owned).collect(),
        step: PLACE,
        errors: errors.iter().map(head).collect(),
        pieces: pieces.iter().filter_map(|of| piece(log, of)).collect(),
    }
}

/// A piece; none of a run that is not in the log.
fn piece(log: &Log, piece: &path::Piece) -> Option<Piece> {
    let run = log.runs.iter().position(|run| run.index == piece.run)?;
    let [paths, errors @ ..] = piece.figure.panels.as_slice() else { return None };
    let at = log.runs[run].at + piece.start - log.runs[run].start;
    let ways = lines(paths);
    let origin = ways.first().and_then(|line| line.points.first())?.map(f64::round);
    let along = |k: usize| {
        let places =
            |line: &&Line| whole(line.points.iter().map(|point| point[k] - origin[k]), PLACE);
        ways.iter().map(places).collect()
    };
    let values = |panel: &Panel| {
        let step = error_step(panel);
        let values = |line: &Line| whole(line.points.iter().map(|point| point[1]), step);
        lines(panel).into_iter().map(values).collect()
    };
    let times = errors.first().and_then(|panel| panel.series.iter().find_map(line))?;
    Some(Piece {
        run,
        at: near(at, TIME),
        origin,
        t: whole(times.points.iter().map(|point| point[0]), TIME),
        x: along(0),
        y: along(1),
        errors: errors.iter().map(values).collect(),
    })
}

/// The line of each name.
fn lines(panel: &Panel) -> Vec<&Line> {
    let all = names(panel).into_iter();
    all.filter_map(|name| named(panel, name).next()).collect()
}

/// Step of an error of place or heading.
fn error_step(panel: &Panel) -> f64 {
    if panel.y.unit == "m" { PLACE } else { ANGLE }
}
