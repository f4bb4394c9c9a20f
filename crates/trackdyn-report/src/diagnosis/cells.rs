//! The ICR triple cell by cell of driving.

use super::Subject;
use super::sheet::{self, AFTER, BEFORE, Mark, label_left_of, px, quantile, rows};
use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::colour::{FRAME, GREY, GRID, INK};
use crate::look;
use crate::panel::ticks::{Ticks, number};
use crate::panel::{Panel, TICK_SIZE, TITLE_SIZE};
use crate::text::{Horizontal, Style, Vertical};
use trackdyn_core::real;
use trackdyn_diagnose::locate::Manoeuvre;
use trackdyn_diagnose::locate::cells::Cell;

const TOP: i32 = sheet::TOP + 110;
const ROW: i32 = 54;
const LABELS: i32 = 600;
const PANEL: i32 = 530;
const GAP: i32 = 60;
/// Half the width of a 95 % interval, in standard deviations.
const HALF: f64 = 1.96;
/// Names of the triple.
const NAMES: [&str; 3] =
    ["xₗ, ICR of the left track", "xᵣ, ICR of the right track", "y of both ICRs (forward)"];

/// Draws one row per cell, one panel per number of the triple.
pub(super) fn draw(subject: &Subject) -> Result<Vec<u8>, Error> {
    let [before, after] = subject.cells();
    let count = before.len().max(1);
    let height = TOP + rows(count) * ROW + 130 + sheet::FOOT;
    let explanation = "ICR: the point of each track about which the robot turns, to the right and forward of \
                       its centre. By the constancy theorem it stays put in slow driving on level ground.";
    let title = "How the centres of rotation move with the way of driving";
    let mut canvas = sheet::sheet(height, title, explanation, subject.caption)?;
    let entries = [
        (Mark::Entry(BEFORE), "before, against the constant ICRs fitted to all"),
        (Mark::Entry(AFTER), "after: what the corrected model leaves"),
        (Mark::Line(INK, 3.0), "bars: 95 % intervals"),
    ];
    sheet::legend(&mut canvas, [LABELS, sheet::TOP + 20], &entries);
    if before.is_empty() {
        let text = "No manoeuvre has enough turning samples for a cell of its own.";
        canvas.text(text, [LABELS, TOP + ROW / 2], &Style::new(TITLE_SIZE));
        return canvas.to_small_png();
    }
    let limit = limit(&[&before, &after]);
    for (row, cell) in before.iter().enumerate() {
        let middle = TOP + rows(row) * ROW + ROW / 2;
        label_left_of(&mut canvas, &name(cell), [LABELS - 104, middle], TICK_SIZE, INK);
        let count = format!("n = {}", cell.samples);
        label_left_of(&mut canvas, &count, [LABELS - 14, middle], 18.0, GREY);
    }
    for (k, name) in NAMES.into_iter().enumerate() {
        let left = LABELS + rows(k) * (PANEL + GAP);
        let plot = Area::new(left, TOP, PANEL, rows(count) * ROW);
        let panel = Panel { plot, x: [-limit, limit], y: [real(count), 0.0] };
        frame(&mut canvas, &panel, name, &before);
        canvas.clip(plot, |canvas| {
            for (entry, cells) in [(BEFORE, &before), (AFTER, &after)] {
                for (row, cell) in cells.iter().enumerate() {
                    let aside = if entry == BEFORE { 0.32 } else { 0.68 };
                    interval(canvas, &panel, entry, cell.departure[k], real(row) + aside);
                }
            }
        });
        panel.border(&mut canvas);
    }
    canvas.to_small_png()
}

fn name(cell: &Cell) -> String {
    let way = match (cell.manoeuvre, cell.forward) {
        (Manoeuvre::Spin, true) => "to the left",
        (Manoeuvre::Spin, false) => "to the right",
        (_, true) => "forward",
        (_, false) => "backward",
    };
    format!("{}, {way}, {} m/s", cell.manoeuvre.name(), number(cell.mean_speed, 2))
}

/// Half the range in mm: all estimates that are worth it, with intervals of usual length.
fn limit(all: &[&[Cell]; 2]) -> f64 {
    let departures = || all.iter().flat_map(|cells| cells.iter()).flat_map(|cell| cell.departure);
    let usual = quantile(departures().map(|(_, deviation)| deviation), 0.5).unwrap_or(0.0);
    let most = departures()
        .filter(|(_, deviation)| *deviation <= 4.0 * usual)
        .map(|(value, deviation)| value.abs() + HALF * deviation)
        .fold(0.0, f64::max);
    if most > 0.0 { 1.05e3 * most } else { 1.0 }
}

fn frame(canvas: &mut Canvas, panel: &Panel, name: &str, cells: &[Cell]) {
    let Area { left, top, width, .. } = panel.plot;
    for row in 1..cells.len() {
        let at = top + rows(row) * ROW;
        let changes = cells[row].manoeuvre != cells[row - 1].manoeuvre;
        let (thickness, colour) = if changes { (2, GREY) } else { (1, GRID) };
        canvas.fill(Area::new(left, at, width, thickness), colour);
    }
    let ticks = Ticks::along(panel.x, width, 90);
    let ticks: Vec<(f64, String)> =
        ticks.values.iter().map(|&value| (value, number(value, ticks.decimals))).collect();
    sheet::axis_below(canvas, panel, &ticks, "departure (mm)");
    let zero = px(panel.pixel([0.0, 0.0])[0]);
    canvas.fill(Area::new(zero - 1, top, 2, panel.plot.height), FRAME);
    let style = Style::new(TITLE_SIZE).anchor(Horizontal::Left, Vertical::Baseline);
    canvas.text(name, [left, top - 16], &style);
}

fn interval(canvas: &mut Canvas, panel: &Panel, entry: usize, of: (f64, f64), row: f64) {
    let (value, deviation) = (1e3 * of.0, 1e3 * of.1);
    if !(value.is_finite() && deviation.is_finite()) {
        return;
    }
    let column = |value: f64| panel.pixel([value, row])[0].clamp(-1e5, 1e5);
    let at = panel.pixel([value, row]);
    let [low, high] = panel.x;
    if !(low..=high).contains(&value) {
        return beyond(canvas, panel, entry, [value, HALF * deviation], at[1]);
    }
    let ends = [column(value - HALF * deviation), column(value + HALF * deviation)];
    sheet::whisker(canvas, ends, at[1], look::colour(entry));
    look::marker(canvas, entry, at);
}

/// An estimate beyond the frame, and half its interval, mm: in words at the edge.
fn beyond(canvas: &mut Canvas, panel: &Panel, entry: usize, [value, half]: [f64; 2], middle: f64) {
    let words = format!("{} ± {}", number(value, 0), number(half, 0));
    let (text, at, side) = if value < 0.0 {
        (format!("← {words}"), panel.plot.left + 8, Horizontal::Left)
    } else {
        (format!("{words} →"), panel.plot.right() - 8, Horizontal::Right)
    };
    let style = Style::new(18.0).colour(look::colour(entry)).anchor(side, Vertical::Middle);
    canvas.text(&text, [at, px(middle)], &style);
}
