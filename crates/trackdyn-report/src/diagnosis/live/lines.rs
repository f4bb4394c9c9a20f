//! Lines of panels.

use super::steps::Steps;
use crate::figure::{Line, Panel, Series, Sign};
use serde::Serialize;

/// Lines of a panel.
#[derive(Serialize)]
pub(super) struct Lines {
    pub title: String,
    pub unit: String,
    pub range: [f64; 2],
    pub step: f64,
    pub lines: Vec<Named>,
}

/// A line, by its name.
#[derive(Serialize)]
pub(super) struct Named {
    pub name: String,
    pub v: Steps,
}

/// A panel without its lines.
pub(super) fn head(panel: &Panel, step: f64) -> Lines {
    Lines {
        title: panel.title.clone(),
        unit: panel.y.unit.clone(),
        range: panel.y.range,
        step,
        lines: Vec::new(),
    }
}

/// The line of a series that is one.
pub(super) fn line(series: &Series) -> Option<&Line> {
    match &series.sign {
        Sign::Line(line) => Some(line),
        _ => None,
    }
}

/// Lines of a name.
pub(super) fn named<'p>(panel: &'p Panel, name: &'p str) -> impl Iterator<Item = &'p Line> {
    panel.series.iter().filter(move |series| series.name == name).filter_map(line)
}

/// Names of the lines of a panel, each once.
pub(super) fn names(panel: &Panel) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for series in panel.series.iter().filter(|series| line(series).is_some()) {
        if !names.contains(&series.name.as_str()) {
            names.push(&series.name);
        }
    }
    names
}
