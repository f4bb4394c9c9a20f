//! How errors grow with distance or time.

use super::Quantity;
use crate::figure::{Area, Axis, Estimates, Panel};
use trackdyn_core::real;
use trackdyn_estimate::odometry::comparison::SpanErrors;
use trackdyn_estimate::odometry::{Comparison, Span};

/// Distance between neighbouring parameter sets at one length, pixels, where there are few:
/// whiskers that lie on each other cannot be read.
const SET_DISTANCE: f64 = 9.0;

/// Distance between the first and the last of many, pixels.
const WIDTH: f64 = 36.0;

/// The root mean square of a quantity over pieces of several lengths.
pub(super) fn panel(place: Area, result: &Comparison, quantity: &Quantity) -> Panel {
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
    let (x, unit) = if by_time { ("time", "s") } else { ("distance travelled", "m") };
    let x = Axis::new(x, unit, [0.0, end(longest)]);
    let y = Axis::new("rms error", quantity.unit, [0.0, end(highest)]);
    let mut panel = Panel::new(quantity.name, place, x, y);
    if spans.is_empty() {
        panel.explain_emptiness("runs too short");
    }
    for (set, of) in result.sets.iter().enumerate() {
        let estimates = spans.iter().map(|errors| {
            let rms = (quantity.of)(&errors.sets[set]).rms;
            let value = quantity.scale * rms.value;
            let half = rms.half_width.map(|half| quantity.scale * half);
            let ends = half.map(|half| [value - half, value + half].map(|end| end.max(0.0)));
            ([length(errors), value], ends)
        });
        let estimates = Estimates::of_entry(set, estimates).joined(4.0);
        let aside = aside(set, result.sets.len());
        panel.show_as(of.name(), Estimates { aside, ..estimates });
    }
    panel
}

/// How far aside of its length a parameter set stands, pixels.
fn aside(set: usize, sets: usize) -> f64 {
    let last = real(sets - 1);
    (real(set) - last / 2.0) * SET_DISTANCE.min(WIDTH / last.max(1.0))
}
