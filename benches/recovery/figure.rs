//! The confusion matrix as a figure.

use crate::confusion::{Confusion, note};
use trackdyn_core::real;
use trackdyn_report::colour::{BLUES, GREY, GRID, INK, WHITE};
use trackdyn_report::figure::{Area, Boxes, Figure, Label, Paint, Panel, Scale};
use trackdyn_report::text::{Horizontal, Style, Vertical, fitted, two_lines};

const LEFT: i32 = 60;
/// Room for names beside the rows and above the columns.
const NAMES: i32 = 420;
const TOP: i32 = 500;
const CELL: i32 = 58;
const FOOT: i32 = 190;
const RIGHT: i32 = 60;
/// Share above which the number in a cell is white.
const MIN_DARK: f64 = 0.55;

/// Sizes of text, pixels; pictures are read at half their size.
const TITLE: f32 = 44.0;
const LABEL: f32 = 28.0;
const NAME: f32 = 25.0;
const NUMBER: f32 = 21.0;

/// White is never, dark blue is always; a frame marks the right answer.
pub fn of(of: &Confusion) -> Figure {
    let side = |count: usize| i32::try_from(count).unwrap_or(i32::MAX / 64) * CELL;
    let (width, height) = (side(of.columns.len()), side(of.rows.len()));
    let place = Area::new(LEFT + NAMES, TOP, width, height);
    let size = [place.right() + RIGHT, place.bottom() + FOOT];
    let mut figure = Figure::new("confusion", size);
    figure.write("What was taken for what", [LEFT, 72], Style::new(TITLE));
    let explanation = "Each effect of the catalogue was concealed on the independent ground. Numbers: \
                       per cent of its cases in which the answer came up.";
    figure.write(explanation, [LEFT, 120], Style::new(LABEL).colour(GREY));
    figure.write("concealed (cases) ↓", [LEFT, TOP - 20], Style::new(LABEL));
    figure.write("named →", [LEFT, TOP - 70], Style::new(LABEL));
    for (line, row) in two_lines(&note(), NAME, width + NAMES).iter().zip([60, 100]) {
        let line = fitted(line, NAME, width + NAMES);
        figure.write(line, [LEFT, place.bottom() + row], Style::new(NAME).colour(GREY));
    }
    figure.panels.push(panel(of, place));
    figure
}

fn panel(of: &Confusion, place: Area) -> Panel {
    let mut panel = Panel::matrix(place, of.columns.len(), of.rows.len());
    let upwards =
        Style { upwards: true, ..Style::new(NAME).anchor(Horizontal::Left, Vertical::Middle) };
    for (column, name) in of.columns.iter().enumerate() {
        let above = Label::new(*name, [real(column) + 0.5, 0.0], upwards);
        panel.labels.push(above.shifted([0, -14]));
    }
    let cell =
        |row: usize, column: usize| [[real(column), real(row + 1)], [real(column + 1), real(row)]];
    let (mut boxes, mut values, mut right) = (Vec::new(), Vec::new(), Vec::new());
    for (row, name) in of.rows.iter().enumerate() {
        let colour = if of.cases[row] == 0 { GREY } else { INK };
        let text = format!("{name} ({})", of.cases[row]);
        let beside = [0.0, real(row) + 0.5];
        panel.labels.push(Label::left_of(&text, beside, 14, (NAME, colour)));
        for (column, &share) in of.shares[row].iter().enumerate() {
            boxes.push(cell(row, column));
            values.push(share);
            if of.is_right(row, column) {
                right.push(cell(row, column));
            }
            if share >= 0.005 {
                let colour = if share > MIN_DARK { WHITE } else { INK };
                let middle = [real(column) + 0.5, real(row) + 0.5];
                let text = format!("{:.0}", 100.0 * share);
                panel.labels.push(Label::on(&text, middle, (NUMBER, colour)));
            }
        }
    }
    let scale = Scale::new(BLUES, [0.0, 1.0], "share of the row");
    panel.show_as("shares", Boxes::new(boxes, Paint::Values { values, scale }).edged(1, GRID));
    panel.show_as("right answers", Boxes::framed(right, 4, INK));
    panel
}
