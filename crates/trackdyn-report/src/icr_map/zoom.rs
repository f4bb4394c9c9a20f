//! The ICRs of one track, enlarged.

use super::{Clouds, mean_of};
use crate::colour::FRAME;
use crate::figure::{Area, Axis, Panel, Rule, equal_scale};
use trackdyn_core::Side;
use trackdyn_model::map::Statistics;

/// Smallest half extent, m: rounding must not look like a spread.
const MIN_HALF_EXTENT: f64 = 0.5e-3;
/// Largest half extent, m, that is shown in millimetres.
const MAX_IN_MILLIMETRES: f64 = 0.1;

/// Largest distance along x and y of an ICR from its mean, m, over both tracks: they share one
/// scale.
pub(super) fn half_extent(clouds: &Clouds, statistics: &Statistics) -> [f64; 2] {
    let mut half = [MIN_HALF_EXTENT; 2];
    for side in Side::BOTH {
        let mean = mean_of(statistics, side);
        for place in &clouds.places[side] {
            for k in 0..2 {
                half[k] = half[k].max((place[k] - mean[k]).abs());
            }
        }
    }
    half
}

/// The cloud about its mean, which lies in the middle.
pub(super) fn panel(
    place: Area,
    clouds: &Clouds,
    side: Side,
    statistics: &Statistics,
    half_extent: [f64; 2],
) -> Panel {
    let mean = mean_of(statistics, side);
    let largest = half_extent[0].max(half_extent[1]);
    let (unit, per_metre) = if largest < MAX_IN_MILLIMETRES { ("mm", 1e3) } else { ("m", 1.0) };
    let [x, y] = half_extent.map(|half| [-1.1 * half * per_metre, 1.1 * half * per_metre]);
    let [x, y] = equal_scale(place, x, y);
    let (title, name) = match side {
        Side::Left => ("Left ICRs, enlarged", "xₗ"),
        Side::Right => ("Right ICRs, enlarged", "xᵣ"),
    };
    let x = Axis::new(&format!("x − mean {name}"), unit, x);
    let mut panel = Panel::new(title, place, x, Axis::new("y − mean y", unit, y));
    panel.show(Rule::level(0.0, 2.0, FRAME));
    panel.show(Rule::upright(0.0, 2.0, FRAME));
    let from_mean = |at: [f64; 2]| [0, 1].map(|k| (at[k] - mean[k]) * per_metre);
    panel.show_as(title, clouds.cloud(side, from_mean));
    panel
}
