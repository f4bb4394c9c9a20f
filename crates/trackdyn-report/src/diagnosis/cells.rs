//! The ICR triple cell by cell of driving.

use super::Subject;
use super::sheet::{self, AFTER_COLOUR, BEFORE_COLOUR, quantile, rows};
use crate::colour::{FRAME, GREY, GRID, INK};
use crate::figure::{
    Area, Axis, Estimates, Figure, Label, Legend, Panel, Rule, Swatch, entry_colour,
};
use crate::text::{Horizontal, Style, TITLE_SIZE, Vertical};
use crate::ticks::number;
use trackdyn_core::real;
use trackdyn_diagnose::locate::cells::Cell;
use trackdyn_estimate::interval::NORMAL_QUANTILE;

const TOP: i32 = sheet::TOP + 110;
const ROW: i32 = 54;
const LABELS: i32 = 600;
const PANEL: i32 = 530;
const GAP: i32 = 60;
/// Names of the triple.
const NAMES: [&str; 3] =
    ["xₗ, ICR of the left track", "xᵣ, ICR of the right track", "y of both ICRs (forward)"];

/// What a figure of cells is of.
pub(crate) struct Words<'a> {
    /// Title of the figure.
    pub title: &'a str,
    /// What the two entries are.
    pub entries: [&'a str; 2],
    /// Their short names.
    pub names: [&'a str; 2],
    /// Stands below.
    pub caption: &'a str,
}

/// One row per cell, one panel per number of the triple, before and after.
pub(super) fn figure(subject: &Subject) -> Figure {
    let words = Words {
        title: "How the centres of rotation move with the way of driving",
        entries: [
            "before, against the constant ICRs fitted to all",
            "after: what the corrected model leaves",
        ],
        names: ["before", "after"],
        caption: subject.caption,
    };
    drawn(&subject.cells(), &words)
}

/// One row per cell, one panel per number of the triple, with two entries for each cell.
pub(crate) fn drawn([before, after]: &[Vec<Cell>; 2], words: &Words) -> Figure {
    let height = TOP + rows(before.len().max(1)) * ROW + 130 + sheet::FOOT;
    let explanation = "ICR: the point of each track about which the robot turns, to the right and \
                       forward of its centre. By the constancy theorem it stays put in slow \
                       driving on level ground.";
    let mut figure = sheet::sheet("cells", height, words.title, explanation, words.caption);
    let entries = [
        (Swatch::entry(BEFORE_COLOUR), words.entries[0]),
        (Swatch::entry(AFTER_COLOUR), words.entries[1]),
        (Swatch::Line(INK, 3.0), "bars: 95 % intervals"),
    ];
    figure.legends.push(Legend::of_marks([LABELS, sheet::TOP + 20], sheet::RIGHT, entries));
    if before.is_empty() {
        let text = "No manoeuvre has enough turning samples for a cell of its own.";
        figure.write(text, [LABELS, TOP + ROW / 2], Style::new(TITLE_SIZE));
        return figure;
    }
    let limit = limit(&[before, after]);
    let panels = (0..3).map(|k| panel(&[before, after], k, limit, words.names));
    figure.panels.extend(panels);
    // Two sets of recordings have samples of their own.
    let are_alike = before.iter().zip(after).all(|(cell, other)| cell.samples == other.samples);
    let width = if are_alike { 104 } else { 150 };
    for (row, (cell, other)) in before.iter().zip(after).enumerate() {
        let at = [-limit, real(row) + 0.5];
        let count = match (cell.samples, other.samples) {
            (one, _) if are_alike => format!("n = {one}"),
            (one, two) => format!("n = {one}/{two}"),
        };
        figure.panels[0].name(&name(cell), at, width);
        figure.panels[0].labels.push(Label::left_of(&count, at, 14, (18.0, GREY)));
    }
    figure
}

/// One number of the triple, before and after.
fn panel(cells: &[&[Cell]; 2], k: usize, limit: f64, names: [&str; 2]) -> Panel {
    let count = cells[BEFORE_COLOUR].len();
    let left = LABELS + rows(k) * (PANEL + GAP);
    let place = Area::new(left, TOP, PANEL, rows(count) * ROW);
    let x = Axis::new("departure", "mm", [-limit, limit]);
    let mut panel = Panel::new(NAMES[k], place, x, Axis::rows(count));
    for (row, pair) in (1..).zip(cells[BEFORE_COLOUR].windows(2)) {
        let changes = pair[0].manoeuvre != pair[1].manoeuvre;
        let (thickness, colour) = if changes { (2.0, GREY) } else { (1.0, GRID) };
        panel.show(Rule::level(real(row), thickness, colour));
    }
    panel.show(Rule::upright(0.0, 2.0, FRAME));
    for (entry, aside) in [(BEFORE_COLOUR, 0.32), (AFTER_COLOUR, 0.68)] {
        let mut estimates = Vec::new();
        for (row, cell) in cells[entry].iter().enumerate() {
            let (value, deviation) = cell.departure[k];
            let (value, half) = (1e3 * value, 1e3 * NORMAL_QUANTILE * deviation);
            let row = real(row) + aside;
            if !(value.is_finite() && half.is_finite()) {
                continue;
            }
            if panel.x.contains(value) {
                estimates.push(([value, row], Some([value - half, value + half])));
            } else {
                panel.labels.push(beyond(entry, [value, half], row, limit));
            }
        }
        panel.show_as(names[entry], Estimates::of_entry(entry, estimates).across());
    }
    panel
}

/// An estimate beyond the frame, and half its interval, mm: in words at the edge.
fn beyond(entry: usize, [value, half]: [f64; 2], row: f64, limit: f64) -> Label {
    let words = format!("{} ± {}", number(value, 0), number(half, 0));
    let (text, at, shift, side) = if value < 0.0 {
        (format!("← {words}"), -limit, 8, Horizontal::Left)
    } else {
        (format!("{words} →"), limit, -8, Horizontal::Right)
    };
    let style = Style::new(18.0).colour(entry_colour(entry)).anchor(side, Vertical::Middle);
    Label::new(text, [at, row], style).shifted([shift, 0])
}

fn name(cell: &Cell) -> String {
    let Cell { manoeuvre, mean_speed, .. } = cell;
    format!("{}, {}, {} m/s", manoeuvre.name(), cell.way(), number(*mean_speed, 2))
}

/// Half the range in mm: all estimates that are worth it, with intervals of usual length.
fn limit(all: &[&[Cell]; 2]) -> f64 {
    let departures = || all.iter().flat_map(|cells| cells.iter()).flat_map(|cell| cell.departure);
    let usual = quantile(departures().map(|(_, deviation)| deviation), 0.5).unwrap_or(0.0);
    let most = departures()
        .filter(|(_, deviation)| *deviation <= 4.0 * usual)
        .map(|(value, deviation)| value.abs() + NORMAL_QUANTILE * deviation)
        .fold(0.0, f64::max);
    if most > 0.0 { 1.05e3 * most } else { 1.0 }
}
