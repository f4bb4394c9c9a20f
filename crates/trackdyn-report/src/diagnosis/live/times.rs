//! Lines over one axis of time.

use super::lines::{Lines, Named, head, line, named, names};
use super::steps::{RESIDUAL, SPEED, TIME, near, steps, whole};
use crate::figure::{Axis, Figure, Line, Panel};
use serde::Serialize;

/// Lines over one axis of time.
#[derive(Serialize)]
pub(super) struct Times {
    label: String,
    end: f64,
    step: f64,
    t: Vec<i64>,
    panels: Vec<Lines>,
}

/// The figure over time: one axis for all lines, with a time without values where lines break.
pub(super) fn times(figure: &Figure) -> Times {
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
