//! How errors grow with distance or time.

use super::Quantity;
use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::look;
use crate::panel::{Labels, Panel};
use trackdyn_estimate::odometry::comparison::SpanErrors;
use trackdyn_estimate::odometry::{Comparison, Span};

/// Distance between neighbouring parameter sets at one length, pixels, where there are few: whiskers that lie
/// on each other cannot be read.
const APART: f64 = 9.0;

/// Distance between the first and the last of many, pixels.
const WIDTH: f64 = 36.0;

/// Draws the root mean square of a quantity over pieces of several lengths.
pub(super) fn draw(
    canvas: &mut Canvas,
    area: Area,
    result: &Comparison,
    quantity: &Quantity,
) -> Result<(), Error> {
    let spans = result.growth();
    let by_time = matches!(spans.last().map(|errors| errors.span), Some(Span::Duration(_)));
    let length = |errors: &SpanErrors| {
        if by_time { errors.mean_duration } else { errors.mean_distance }
    };
    let longest = spans.iter().map(|errors| length(errors)).fold(0.0, f64::max);
    let highest = spans
        .iter()
        .flat_map(|errors| &errors.sets)
        .map(|set| {
            let rms = (quantity.of)(set).rms;
            quantity.scale * (rms.value + rms.half_width.unwrap_or(0.0).min(rms.value))
        })
        .fold(0.0, f64::max);
    let end = |value: f64| if value > 0.0 { 1.08 * value } else { 1.0 };
    let panel = Panel { plot: area, x: [0.0, end(longest)], y: [0.0, end(highest)] };
    let y = format!("rms error ({})", quantity.unit);
    let x = if by_time { "time (s)" } else { "distance travelled (m)" };
    panel.frame(canvas, &Labels { title: quantity.name, x, y: &y }, true)?;
    if spans.is_empty() {
        panel.explain_emptiness(canvas, "runs too short");
    }
    canvas.clip(area, |canvas| {
        for set in 0..result.sets.len() {
            let mut before = None;
            let aside = aside(set, result.sets.len());
            for errors in &spans {
                let rms = (quantity.of)(&errors.sets[set]).rms;
                let value = quantity.scale * rms.value;
                let [column, row] = panel.pixel([length(errors), value]);
                let at = [column + aside, row];
                let colour = look::colour(set);
                if let Some(half) = rms.half_width.map(|half| quantity.scale * half) {
                    let ends = [value - half, value + half];
                    let rows = ends.map(|value| panel.pixel([0.0, value.max(0.0)])[1]);
                    look::whisker(canvas, at[0], rows, colour);
                }
                if let Some(before) = before.replace(at) {
                    canvas.line(before, at, 4.0, colour);
                }
                look::marker(canvas, set, at);
            }
        }
    });
    panel.border(canvas);
    Ok(())
}

/// How far aside of its length a parameter set stands, pixels.
#[expect(clippy::cast_precision_loss, reason = "a few sets")]
fn aside(set: usize, sets: usize) -> f64 {
    let last = (sets - 1) as f64;
    (set as f64 - last / 2.0) * APART.min(WIDTH / last.max(1.0))
}
