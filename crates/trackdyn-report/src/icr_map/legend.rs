//! What the signs mean, and the numbers behind the picture.

use super::{heat_map, metres, robot};
use crate::colour::{FRAME, GREY, INK, Rgb, VIRIDIS};
use crate::figure::{Area, Axis, Boxes, Cell, Cells, Label, Marker, Paint, Panel, Points};
use crate::ticks::number;
use trackdyn_core::Side;
use trackdyn_model::map::Statistics;
use trackdyn_model::{IcrMap, Status};

const SIZE: f32 = 25.0;
/// Distance between lines, pixels.
const LINE: i32 = 35;
/// Distance between tables beyond that, pixels.
const TABLE_DISTANCE: i32 = 12;
/// Width and height of a sample of colour, pixels.
const SWATCH: [i32; 2] = [46, 26];
/// Distance from the beginning of a line to its text, pixels.
const INDENT: i32 = 64;

/// Signs, counts and statistics: patterns of gaps in panels of their own, below all else.
pub(super) fn panels(area: Area, map: &IcrMap, statistics: Option<&Statistics>) -> Vec<Panel> {
    let mut panel = Panel::of_sheet(area.grown(SWATCH[1]));
    let row = signs(&mut panel, area);
    let (mut panels, row) = counts(&mut panel, area, row + LINE / 2, map);
    if let Some(statistics) = statistics {
        table(&mut panel, area, row + LINE / 2, statistics);
    }
    panels.push(panel);
    panels
}

fn entry(panel: &mut Panel, text: &str, at: [i32; 2]) {
    panel.labels.push(Label::right_of(text, at.map(f64::from), INDENT, (SIZE, INK)));
}

/// The place of a sample at the beginning of a line.
fn swatch([column, row]: [i32; 2]) -> Area {
    Area::new(column, row - SWATCH[1] / 2, SWATCH[0], SWATCH[1])
}

fn corners(area: Area) -> [[f64; 2]; 2] {
    [[area.left, area.bottom()], [area.right(), area.top]].map(|corner| corner.map(f64::from))
}

/// Signs of the picture of the robot; returns the next row.
fn signs(panel: &mut Panel, area: Area) -> i32 {
    let (first, second) = (area.top, area.top + LINE + 6);
    let right = area.left + area.width / 2 - 20;
    for (row, text, colour) in [(first, "contact", robot::PATCH), (second, "hull", robot::HULL)] {
        let boxes = vec![corners(swatch([area.left, row]))];
        panel.show(Boxes::new(boxes, Paint::One(colour)).edged(2, FRAME));
        entry(panel, text, [area.left, row]);
    }
    let markers: [(i32, &str, Marker); 2] = [
        (first, "centre of gravity", robot::CENTRE_OF_GRAVITY),
        (second, "mean ICR of a track", robot::MEAN_ICR),
    ];
    for (row, text, marker) in markers {
        let at = [right + SWATCH[0] / 2, row].map(f64::from);
        panel.show(Points::new(vec![at], marker));
        entry(panel, text, [right, row]);
    }
    second + LINE
}

/// Kinds of motion with their numbers; returns samples of their patterns and the next row.
fn counts(panel: &mut Panel, area: Area, first: i32, map: &IcrMap) -> (Vec<Panel>, i32) {
    const MEANINGS: [(Status, &str); 5] = [
        (Status::Turning, "turning"),
        (Status::Straight, "straight: both tracks stick"),
        (Status::Holds(Side::Left), "held straight by one track"),
        (Status::Tips, "tips over"),
        (Status::NotConverged, "no balance found"),
    ];
    let counts = map.counts();
    let (mut samples, mut row) = (Vec::new(), first);
    for (status, meaning) in MEANINGS {
        let place = swatch([area.left, row]);
        if status == Status::Turning {
            let columns = place.left..place.right();
            let column = |left| corners(Area::new(left, place.top, 1, place.height));
            let colour = |column| VIRIDIS.at(f64::from(column - place.left) / f64::from(SWATCH[0]));
            let paint = Paint::Each(columns.clone().map(colour).collect());
            panel.show(Boxes::new(columns.map(column).collect(), paint));
        } else {
            let axis = || Axis::unmarked([0.0, 1.0]);
            let mut sample = Panel::new("", place, axis(), axis());
            sample.is_framed = false;
            let cells = vec![Cell::Gap(heat_map::gap(status))];
            sample.show_as(meaning, Cells { count: 1, cells, scale: metres(VIRIDIS, [0.0, 1.0]) });
            samples.push(sample);
        }
        panel.show(Boxes::framed(vec![corners(place)], 2, FRAME));
        entry(panel, meaning, [area.left, row]);
        write(panel, &counts[status.index()].to_string(), [area.right(), row], INK);
        row += LINE;
    }
    let lifted = map.lifted().count();
    if lifted > 0 {
        let at = [area.left + SWATCH[0] / 2, row].map(f64::from);
        panel.show(Points::new(vec![at], heat_map::lifted_sign(f64::from(SWATCH[1]))));
        entry(panel, heat_map::LIFTED_MEANING, [area.left, row]);
        write(panel, &lifted.to_string(), [area.right(), row], INK);
        row += LINE;
    }
    (samples, row)
}

/// Writes a number that ends at a column.
fn write(panel: &mut Panel, text: &str, at: [i32; 2], colour: Rgb) {
    panel.labels.push(Label::left_of(text, at.map(f64::from), 0, (SIZE, colour)));
}

/// Means and spreads.
fn table(panel: &mut Panel, area: Area, first: i32, statistics: &Statistics) {
    let columns = [area.left + INDENT + 200, area.right()];
    let mut line = |row: i32, name: &str, values: [String; 2], colour| {
        let at = [area.left, row].map(f64::from);
        panel.labels.push(Label::right_of(name, at, 0, (SIZE, colour)));
        for (value, column) in values.into_iter().zip(columns) {
            write(panel, &value, [column, row], colour);
        }
    };
    let mut row = first;
    let mut rows_under = |heads: [&str; 2], rows: &[(&str, [String; 2])]| {
        line(row, "", heads.map(str::to_owned), GREY);
        for (name, values) in rows {
            row += LINE;
            line(row, name, values.clone(), INK);
        }
        row += LINE + TABLE_DISTANCE;
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
