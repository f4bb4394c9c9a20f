//! What the signs mean, and the numbers behind the picture.

use super::{heat_map, robot};
use crate::canvas::{Area, Canvas};
use crate::colour::{FRAME, GREY, INK, VIRIDIS};
use crate::panel::ticks::number;
use crate::text::{Horizontal, Style, Vertical};
use trackdyn_core::Side;
use trackdyn_model::map::Statistics;
use trackdyn_model::{IcrMap, Status};

const SIZE: f32 = 25.0;
/// Distance between lines, pixels.
const LINE: i32 = 35;
/// Distance between tables beyond that, pixels.
const BETWEEN: i32 = 12;
/// Width and height of a sample of colour, pixels.
const SWATCH: [i32; 2] = [46, 26];
/// Distance from the beginning of a line to its text, pixels.
const INDENT: i32 = 64;

/// Draws signs, counts and statistics.
pub(super) fn draw(canvas: &mut Canvas, area: Area, map: &IcrMap, statistics: Option<&Statistics>) {
    let mut row = signs(canvas, area);
    row = counts(canvas, area, row + LINE / 2, map);
    if let Some(statistics) = statistics {
        table(canvas, area, row + LINE / 2, statistics);
    }
}

fn entry(canvas: &mut Canvas, text: &str, [column, row]: [i32; 2]) {
    let style = Style::new(SIZE).anchor(Horizontal::Left, Vertical::Middle);
    canvas.text(text, [column + INDENT, row], &style);
}

/// The box of a sample at the beginning of a line, framed.
fn swatch(canvas: &mut Canvas, [column, row]: [i32; 2], paint: impl FnOnce(&mut Canvas, Area)) {
    let [width, height] = SWATCH;
    let area = Area::new(column, row - height / 2, width, height);
    paint(canvas, area);
    canvas.outline(area, 2, FRAME);
}

/// Signs of the picture of the robot; returns the next row.
fn signs(canvas: &mut Canvas, area: Area) -> i32 {
    let (first, second) = (area.top, area.top + LINE + 6);
    let right = area.left + area.width / 2 - 20;
    let middle = |column: i32, row: i32| [f64::from(column + SWATCH[0] / 2), f64::from(row)];
    swatch(canvas, [area.left, first], |canvas, area| canvas.fill(area, robot::PATCH));
    entry(canvas, "contact", [area.left, first]);
    swatch(canvas, [area.left, second], |canvas, area| canvas.fill(area, robot::HULL));
    entry(canvas, "hull", [area.left, second]);
    robot::centre_of_gravity(canvas, middle(right, first));
    entry(canvas, "centre of gravity", [right, first]);
    robot::mean_icr(canvas, middle(right, second));
    entry(canvas, "mean ICR of a track", [right, second]);
    second + LINE
}

/// Kinds of motion with their numbers; returns the next row.
fn counts(canvas: &mut Canvas, area: Area, first: i32, map: &IcrMap) -> i32 {
    const MEANINGS: [(Status, &str); 5] = [
        (Status::Turning, "turning"),
        (Status::Straight, "straight: both tracks stick"),
        (Status::Holds(Side::Left), "held straight by one track"),
        (Status::Lifts, "lifts: part of the contact would pull"),
        (Status::NotConverged, "no balance found"),
    ];
    let counts = map.counts();
    let mut row = first;
    for (status, meaning) in MEANINGS {
        swatch(canvas, [area.left, row], |canvas, area| {
            canvas.paint(area, |column, row| match status {
                Status::Turning => {
                    VIRIDIS.at(f64::from(column - area.left) / f64::from(area.width))
                }
                gap => heat_map::gap(gap, column, row),
            });
        });
        entry(canvas, meaning, [area.left, row]);
        let style = Style::new(SIZE).anchor(Horizontal::Right, Vertical::Middle);
        canvas.text(&counts[status.index()].to_string(), [area.right(), row], &style);
        row += LINE;
    }
    row
}

/// Means and spreads.
fn table(canvas: &mut Canvas, area: Area, first: i32, statistics: &Statistics) {
    let columns = [area.left + INDENT + 200, area.right()];
    let mut line = |row: i32, name: &str, values: [String; 2], colour| {
        let style = Style::new(SIZE).colour(colour);
        canvas.text(name, [area.left, row], &style.anchor(Horizontal::Left, Vertical::Middle));
        for (value, column) in values.into_iter().zip(columns) {
            let style = style.anchor(Horizontal::Right, Vertical::Middle);
            canvas.text(&value, [column, row], &style);
        }
    };
    let mut row = first;
    let mut rows_under = |heads: [&str; 2], rows: &[(&str, [String; 2])]| {
        line(row, "", heads.map(str::to_owned), GREY);
        for (name, values) in rows {
            row += LINE;
            line(row, name, values.clone(), INK);
        }
        row += LINE + BETWEEN;
    };
    let (mean, spread) = (statistics.mean.to_array(), statistics.spread.to_array());
    let of_icr = |k: usize| {
        [format!("{} m", number(mean[k], 4)), format!("{} mm", number(1e3 * spread[k], 2))]
    };
    rows_under(
        ["mean", "standard deviation"],
        &[("xₗ", of_icr(0)), ("xᵣ", of_icr(1)), ("y", of_icr(2))],
    );
    let of_ratio = |of_map: f64, of_means: f64| [of_map, of_means].map(|value| number(value, 4));
    let Statistics {
        steering_efficiency,
        mean_steering_efficiency,
        eccentricity,
        mean_eccentricity,
        ..
    } = *statistics;
    rows_under(
        ["mean over map", "of the mean ICRs"],
        &[
            ("χ", of_ratio(mean_steering_efficiency, steering_efficiency)),
            ("e", of_ratio(mean_eccentricity, eccentricity)),
        ],
    );
}
