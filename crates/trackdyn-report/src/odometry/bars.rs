//! Errors over segments, as bars.

use super::Quantity;
use crate::colour::INK;
use crate::figure::{Area, Axis, Boxes, Estimates, Paint, Panel, entry_colour};
use crate::ticks::number;
use trackdyn_core::real;
use trackdyn_estimate::odometry::Comparison;

/// Share of its place that a group of bars fills.
const FILLED_SHARE: f64 = 0.8;

/// A group of bars, one per parameter set, for each quantity; these share their unit.
pub(super) fn panel(place: Area, result: &Comparison, quantities: &[Quantity]) -> Option<Panel> {
    let (segments, Quantity { unit, .. }) = (result.segments()?, quantities.first()?);
    let bars: Vec<Vec<(f64, f64)>> = quantities
        .iter()
        .map(|quantity| {
            let rms = segments.sets.iter().map(|set| (quantity.of)(set).rms);
            let scale = quantity.scale;
            rms.map(|rms| (scale * rms.value, scale * rms.half_width.unwrap_or(0.0))).collect()
        })
        .collect();
    let highest = bars.iter().flatten().map(|(value, half)| value + half).fold(0.0, f64::max);
    let highest = if highest > 0.0 { 1.08 * highest } else { 1.0 };
    let names = quantities.iter().enumerate();
    let names = names.map(|(k, quantity)| (real(k) + 0.5, quantity.name.to_owned())).collect();
    let x = Axis::unmarked([0.0, real(quantities.len())]).at(names).without_grid();
    let mut panel = Panel::new("", place, x, Axis::new("rms error", unit, [0.0, highest]));
    if quantities.len() > 1 {
        let duration = number(segments.mean_duration, 2);
        panel.title = format!("rms over {} segments of {duration} s", segments.count);
    }
    for (k, (quantity, bars)) in quantities.iter().zip(&bars).enumerate() {
        group(&mut panel, quantity.name, real(k) + 0.5 - FILLED_SHARE / 2.0, bars);
    }
    Some(panel)
}

/// The bars of one quantity from their left end on; values with half widths of their intervals.
fn group(panel: &mut Panel, name: &str, left: f64, bars: &[(f64, f64)]) {
    let width = FILLED_SHARE / real(bars.len());
    let at = |set: usize, share: f64| left + width * (real(set) + share);
    let boxes = bars.iter().enumerate();
    let boxes = boxes.map(|(set, (value, _))| [[at(set, 0.08), 0.0], [at(set, 0.92), *value]]);
    let colours = Paint::Each((0..bars.len()).map(entry_colour).collect());
    panel.show_as(name, Boxes::new(boxes.collect(), colours));
    let intervals = bars
        .iter()
        .map(|(value, half)| (*half > 0.0).then(|| [(value - half).max(0.0), value + half]));
    panel.show_as(
        name,
        Estimates {
            points: (0..bars.len()).map(|set| [at(set, 0.5), bars[set].0]).collect(),
            intervals: intervals.collect(),
            is_across: false,
            shape: None,
            colour: INK,
            joined: None,
            aside: 0.0,
        },
    );
}
