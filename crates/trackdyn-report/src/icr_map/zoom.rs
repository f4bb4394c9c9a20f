//! The ICRs of one track, enlarged.

use super::{Cloud, mean_of};
use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::colour::FRAME;
use crate::panel::{Labels, Panel};
use trackdyn_core::{PerSide, Side};
use trackdyn_model::map::Statistics;

/// Smallest half extent, m: rounding must not look like a spread.
const LEAST: f64 = 0.5e-3;
/// Largest half extent, m, that is shown in millimetres.
const MILLIMETRES: f64 = 0.1;

/// Largest distance along x and y of an ICR from its mean, m, over both tracks: they share one scale.
pub(super) fn half_extent(clouds: &PerSide<Cloud>, statistics: &Statistics) -> [f64; 2] {
    let mut half = [LEAST; 2];
    for side in Side::BOTH {
        let mean = mean_of(statistics, side);
        for place in clouds[side].places() {
            for k in 0..2 {
                half[k] = half[k].max((place[k] - mean[k]).abs());
            }
        }
    }
    half
}

/// Draws the cloud about its mean, which lies in the middle.
pub(super) fn draw(
    canvas: &mut Canvas,
    plot: Area,
    cloud: &Cloud,
    side: Side,
    statistics: &Statistics,
    half_extent: [f64; 2],
) -> Result<(), Error> {
    let mean = mean_of(statistics, side);
    let largest = half_extent[0].max(half_extent[1]);
    let (unit, per_metre) = if largest < MILLIMETRES { ("mm", 1e3) } else { ("m", 1.0) };
    let [x, y] = half_extent.map(|half| [-1.1 * half * per_metre, 1.1 * half * per_metre]);
    let axes = Panel::equal_scale(plot, x, y);
    let (title, name) = match side {
        Side::Left => ("Left ICRs, enlarged", "xₗ"),
        Side::Right => ("Right ICRs, enlarged", "xᵣ"),
    };
    let x = format!("x − mean {name} ({unit})");
    let y = format!("y − mean y ({unit})");
    axes.frame(canvas, &Labels { title, x: &x, y: &y }, true)?;
    let about = |range: [f64; 2], mean: f64| range.map(|value| mean + value / per_metre);
    let panel = Panel { plot, x: about(axes.x, mean[0]), y: about(axes.y, mean[1]) };
    let [column, row] = panel.pixel(mean);
    let [left, right] = [plot.left, plot.right()].map(f64::from);
    let [top, bottom] = [plot.top, plot.bottom()].map(f64::from);
    canvas.line([left, row], [right, row], 2.0, FRAME);
    canvas.line([column, top], [column, bottom], 2.0, FRAME);
    cloud.draw(canvas, &panel);
    axes.border(canvas);
    Ok(())
}
