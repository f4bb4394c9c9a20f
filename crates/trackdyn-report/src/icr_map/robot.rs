//! The robot from above.

use super::{Cloud, ROBOT, mean_of};
use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::colour::{INK, Rgb, WHITE};
use crate::panel::{Labels, Panel};
use crate::text::{Horizontal, Style, Vertical};
use trackdyn_core::{PerSide, Side};
use trackdyn_model::Model;
use trackdyn_model::map::Statistics;

/// Inside of the hull.
pub(super) const HULL: Rgb = [240, 241, 243];
/// Outline of hull and patches.
pub(super) const OUTLINE: Rgb = [110, 115, 122];
/// Contact patches.
pub(super) const PATCH: Rgb = [205, 209, 214];
/// Axes of the paper's frame.
const AXES: Rgb = [60, 60, 60];

/// Sizes of the robot within which ICRs are shown, from its middle.
const VIEW: f64 = 3.0;

/// Draws robot, axes, clouds and mean ICRs.
pub(super) fn draw(
    canvas: &mut Canvas,
    model: &Model,
    clouds: &PerSide<Cloud>,
    statistics: Option<&Statistics>,
) -> Result<(), Error> {
    let hull = hull(model);
    let panel = view(hull, clouds);
    let labels =
        Labels { title: "Robot from above and its ICRs", x: "x, right (m)", y: "y, forward (m)" };
    panel.frame(canvas, &labels, true)?;
    canvas.clip(panel.plot, |canvas| {
        let body = panel.area([hull[0][0], hull[1][0]], [hull[0][1], hull[1][1]]);
        canvas.fill(body, HULL);
        canvas.outline(body, 3, OUTLINE);
        for side in Side::BOTH {
            for patch in &model.patches()[side] {
                let area = panel.area([patch.x[0], patch.y[0]], [patch.x[1], patch.y[1]]);
                canvas.fill(area, PATCH);
                canvas.outline(area, 2, OUTLINE);
            }
        }
        axes(canvas, &panel);
        for side in Side::BOTH {
            clouds[side].draw(canvas, &panel);
        }
        centre_of_gravity(canvas, panel.pixel(model.vehicle().cog));
        if let Some(statistics) = statistics {
            for side in Side::BOTH {
                mean_icr(canvas, panel.pixel(mean_of(statistics, side)));
            }
        }
    });
    panel.border(canvas);
    let outside = Side::BOTH
        .iter()
        .flat_map(|&side| clouds[side].places())
        .filter(|&place| !panel.contains(place))
        .count();
    if outside > 0 {
        panel.remark(canvas, &format!("{outside} ICRs outside"));
    }
    Ok(())
}

/// Ranges of x and y of the contact.
fn hull(model: &Model) -> [[f64; 2]; 2] {
    let patches = || Side::BOTH.iter().flat_map(|&side| &model.patches()[side]);
    let range = |of: &dyn Fn(usize) -> Vec<f64>| {
        [
            of(0).into_iter().fold(f64::INFINITY, f64::min),
            of(1).into_iter().fold(f64::NEG_INFINITY, f64::max),
        ]
    };
    [
        range(&|end| patches().map(|patch| patch.x[end]).collect()),
        range(&|end| patches().map(|patch| patch.y[end]).collect()),
    ]
}

/// The panel that shows the hull and the ICRs, if these are not too far away.
fn view(hull: [[f64; 2]; 2], clouds: &PerSide<Cloud>) -> Panel {
    let size = (hull[0][1] - hull[0][0]).max(hull[1][1] - hull[1][0]);
    let middle = hull.map(|[low, high]| f64::midpoint(low, high));
    let mut ranges = hull;
    for place in Side::BOTH.iter().flat_map(|&side| clouds[side].places()) {
        for ((range, middle), value) in ranges.iter_mut().zip(middle).zip(place) {
            let value = value.clamp(middle - VIEW * size, middle + VIEW * size);
            *range = [range[0].min(value), range[1].max(value)];
        }
    }
    let room = 0.07 * (ranges[0][1] - ranges[0][0]).max(ranges[1][1] - ranges[1][0]);
    let [x, y] = ranges.map(|[low, high]| [low - room, high + room]);
    Panel::equal_scale(ROBOT, x, y)
}

/// The axes of the paper's frame at its origin.
fn axes(canvas: &mut Canvas, panel: &Panel) {
    const LENGTH: f64 = 92.0;
    let origin = panel.pixel([0.0, 0.0]);
    let style = Style::new(24.0).colour(AXES);
    for (name, [right, down]) in [("x", [1.0, 0.0]), ("y", [0.0, -1.0])] {
        let end = [origin[0] + LENGTH * right, origin[1] + LENGTH * down];
        canvas.arrow(origin, end, 3.0, AXES);
        let beyond = [end[0] + 16.0 * right, end[1] + 18.0 * down];
        #[expect(clippy::cast_possible_truncation, reason = "places on the canvas")]
        let at = beyond.map(|place| place.round() as i32);
        canvas.text(name, at, &style.anchor(Horizontal::Centre, Vertical::Middle));
    }
}

/// The marker of a centre of gravity: a disc with two black quarters.
pub(super) fn centre_of_gravity(canvas: &mut Canvas, centre: [f64; 2]) {
    const RADIUS: f64 = 13.0;
    canvas.disc(centre, RADIUS, WHITE);
    #[expect(clippy::cast_possible_truncation, reason = "places on the canvas")]
    let [column, row] = centre.map(|place| place.round() as i32);
    let quarter = 14;
    for (left, top) in [(column, row - quarter), (column - quarter, row)] {
        canvas.clip(Area::new(left, top, quarter, quarter), |canvas| {
            canvas.disc(centre, RADIUS, INK);
        });
    }
    canvas.ring(centre, RADIUS, 2.5, INK);
}

/// The marker of a mean ICR: sights that leave the middle free for the cloud.
pub(super) fn mean_icr(canvas: &mut Canvas, centre: [f64; 2]) {
    const RADIUS: f64 = 15.0;
    canvas.ring(centre, RADIUS, 3.0, INK);
    for [right, down] in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]] {
        let place = |radius: f64| [centre[0] + radius * right, centre[1] + radius * down];
        canvas.line(place(RADIUS), place(RADIUS + 9.0), 3.0, INK);
    }
}
