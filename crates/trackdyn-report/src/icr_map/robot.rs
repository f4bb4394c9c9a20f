//! The robot from above.

use super::{Clouds, ROBOT, mean_of};
use crate::colour::{INK, Rgb};
use crate::figure::{Arrow, Axis, Boxes, Label, Marker, Paint, Panel, Points, Shape, equal_scale};
use crate::text::{Horizontal, Style, Vertical};
use trackdyn_core::Side;
use trackdyn_model::Model;
use trackdyn_model::map::Statistics;

/// Inside of the hull.
pub(super) const HULL: Rgb = [240, 241, 243];
/// Outline of hull and patches.
const OUTLINE: Rgb = [110, 115, 122];
/// Contact patches.
pub(super) const PATCH: Rgb = [205, 209, 214];
/// Axes of the paper's frame.
const AXES: Rgb = [60, 60, 60];
/// The marker of a centre of gravity.
pub(super) const CENTRE_OF_GRAVITY: Marker = Marker { shape: Shape::CentreOfGravity, colour: INK };
/// The marker of a mean ICR: it leaves the middle free for the cloud.
pub(super) const MEAN_ICR: Marker = Marker { shape: Shape::Sights, colour: INK };

/// Sizes of the robot within which ICRs are shown, from its middle.
const MAX_SIZES: f64 = 3.0;

/// Robot, axes, clouds and mean ICRs.
pub(super) fn panel(model: &Model, clouds: &Clouds, statistics: Option<&Statistics>) -> Panel {
    let hull = hull(model);
    let [x, y] = ranges(hull, clouds);
    let (x, y) = (Axis::new("x, right", "m", x), Axis::new("y, forward", "m", y));
    let mut panel = Panel::new("Robot from above and its ICRs", ROBOT, x, y);
    let corners = |x: [f64; 2], y: [f64; 2]| [[x[0], y[0]], [x[1], y[1]]];
    let body = Boxes::new(vec![corners(hull[0], hull[1])], Paint::One(HULL));
    panel.show_as("hull", body.edged(3, OUTLINE));
    let patches = Side::BOTH.iter().flat_map(|&side| &model.patches()[side]);
    let patches = patches.map(|patch| corners(patch.x, patch.y)).collect();
    panel.show_as("contact", Boxes::new(patches, Paint::One(PATCH)).edged(2, OUTLINE));
    axes(&mut panel);
    for (side, name) in Side::BOTH.into_iter().zip(["left ICRs", "right ICRs"]) {
        panel.show_as(name, clouds.cloud(side, |place| place));
    }
    let cog = Points::new(vec![model.vehicle().cog], CENTRE_OF_GRAVITY);
    panel.show_as("centre of gravity", cog);
    if let Some(statistics) = statistics {
        let means = Side::BOTH.iter().map(|&side| mean_of(statistics, side)).collect();
        panel.show_as("mean ICRs", Points::new(means, MEAN_ICR));
    }
    let places = Side::BOTH.iter().flat_map(|&side| &clouds.places[side]);
    let outside = places.filter(|&&place| !panel.contains(place)).count();
    if outside > 0 {
        panel.remark = format!("{outside} ICRs outside");
    }
    panel
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

/// Ranges that show the hull and the ICRs, if these are not too far away.
fn ranges(hull: [[f64; 2]; 2], clouds: &Clouds) -> [[f64; 2]; 2] {
    let size = (hull[0][1] - hull[0][0]).max(hull[1][1] - hull[1][0]);
    let middle = hull.map(|[low, high]| f64::midpoint(low, high));
    let mut ranges = hull;
    for place in Side::BOTH.iter().flat_map(|&side| &clouds.places[side]) {
        for ((range, middle), value) in ranges.iter_mut().zip(middle).zip(place) {
            let value = value.clamp(middle - MAX_SIZES * size, middle + MAX_SIZES * size);
            *range = [range[0].min(value), range[1].max(value)];
        }
    }
    let room = 0.07 * (ranges[0][1] - ranges[0][0]).max(ranges[1][1] - ranges[1][0]);
    let [x, y] = ranges.map(|[low, high]| [low - room, high + room]);
    equal_scale(ROBOT, x, y)
}

/// The axes of the paper's frame at its origin.
fn axes(panel: &mut Panel) {
    const LENGTH: f64 = 92.0;
    let style = Style::new(24.0).colour(AXES).anchor(Horizontal::Centre, Vertical::Middle);
    let origin = [0.0, 0.0];
    for (name, by, beyond) in [("x", [LENGTH, 0.0], [108, 0]), ("y", [0.0, -LENGTH], [0, -110])] {
        panel.show(Arrow { from: origin, by, thickness: 3.0, colour: AXES });
        panel.labels.push(Label::new(name, origin, style).shifted(beyond));
    }
}
