//! Errors over segments, as bars.

use super::Quantity;
use crate::canvas::{Area, Canvas};
use crate::colour::{GREY, GRID, INK};
use crate::look;
use crate::panel::ticks::{Ticks, number};
use crate::panel::{LABEL_SIZE, Panel, TICK_SIZE, TITLE_SIZE};
use crate::text::{Horizontal, Style, Vertical};
use trackdyn_estimate::odometry::Comparison;

/// Share of its place that a group of bars fills.
const FILLED: f64 = 0.8;

/// Draws a group of bars, one per parameter set, for each quantity; these share their unit.
pub(super) fn draw(canvas: &mut Canvas, area: Area, result: &Comparison, quantities: &[Quantity]) {
    let (Some(segments), Some(Quantity { unit, .. })) = (result.segments(), quantities.first())
    else {
        return;
    };
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
    #[expect(clippy::cast_precision_loss, reason = "a few groups")]
    let panel = Panel { plot: area, x: [0.0, quantities.len() as f64], y: [0.0, highest] };
    values(canvas, &panel, unit);
    let mut middle = 0.5;
    for (quantity, bars) in quantities.iter().zip(&bars) {
        #[expect(clippy::cast_possible_truncation, reason = "places on the canvas")]
        let column = panel.pixel([middle, 0.0])[0].round() as i32;
        let style = Style::new(LABEL_SIZE).anchor(Horizontal::Centre, Vertical::Top);
        canvas.text(quantity.name, [column, area.bottom() + 18], &style);
        group(canvas, &panel, middle, bars);
        middle += 1.0;
    }
    panel.border(canvas);
    let title = if quantities.len() > 1 {
        format!("rms over {} segments of {} s", segments.count, number(segments.mean_duration, 2))
    } else {
        String::new()
    };
    let style = Style::new(TITLE_SIZE).anchor(Horizontal::Left, Vertical::Baseline);
    canvas.text(&title, [area.left, area.top - 16], &style);
}

/// The bars of one quantity about a middle; values with half widths of their intervals.
fn group(canvas: &mut Canvas, panel: &Panel, middle: f64, bars: &[(f64, f64)]) {
    #[expect(clippy::cast_precision_loss, reason = "a few sets")]
    let width = FILLED / bars.len() as f64;
    let mut left = middle - FILLED / 2.0;
    for (set, (value, half)) in bars.iter().enumerate() {
        let bar = panel.area([left + 0.08 * width, 0.0], [left + 0.92 * width, *value]);
        canvas.fill(bar, look::colour(set));
        if *half > 0.0 {
            let ends = [(value - half).max(0.0), value + half];
            let rows = ends.map(|value| panel.pixel([0.0, value])[1]);
            look::whisker(canvas, panel.pixel([left + width / 2.0, 0.0])[0], rows, INK);
        }
        left += width;
    }
}

/// Grid lines, numbers and unit of the values.
fn values(canvas: &mut Canvas, panel: &Panel, unit: &str) {
    let Area { left, width, height, top } = panel.plot;
    let ticks = Ticks::along(panel.y, height, 60);
    let style = Style::new(TICK_SIZE).colour(GREY).anchor(Horizontal::Right, Vertical::Middle);
    for value in &ticks.values {
        #[expect(clippy::cast_possible_truncation, reason = "places on the canvas")]
        let row = panel.pixel([0.0, *value])[1].round() as i32;
        canvas.fill(Area::new(left, row, width, 1), GRID);
        canvas.text(&number(*value, ticks.decimals), [left - 14, row], &style);
    }
    let style = Style { upwards: true, ..Style::new(LABEL_SIZE) };
    let style = style.anchor(Horizontal::Centre, Vertical::Top);
    canvas.text(&format!("rms error ({unit})"), [left - 118, top + height / 2], &style);
}
