//! Residuals over the plane of track speeds.

use super::steps::{RESIDUAL, SPEED, Steps, TIME, near, step, steps, whole};
use crate::colour::hex;
use crate::figure::{Figure, Paint, Panel, Scale, Series, Sign};
use serde::Serialize;

/// Cells of the plane of track speeds, or points.
#[derive(Serialize)]
pub(super) struct Plane {
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

/// The plane of track speeds: one list of cells, and the values of every panel.
pub(super) fn plane(figure: &Figure) -> Plane {
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
