//! The confusion matrix as a figure.

use crate::confusion::{Confusion, note};
use trackdyn_report::colour::{BLUES, GREY, GRID, INK};
use trackdyn_report::figure::{Area, Boxes, Figure, Matrix, Panel, Scale};
use trackdyn_report::text::{Style, fitted, two_lines};

const LEFT: i32 = 60;
/// Room for names beside the rows and below the columns.
const NAMES: i32 = 420;
const TOP: i32 = 200;
const CELL: i32 = 58;
const FOOT: i32 = 190;
const RIGHT: i32 = 60;
/// Share from which on its number is written.
const MIN_WRITTEN_SHARE: f64 = 0.005;

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
    let size = [place.right() + RIGHT, place.bottom() + NAMES + FOOT];
    let mut figure = Figure::new("confusion", size);
    figure.write("What was taken for what", [LEFT, 72], Style::new(TITLE));
    let explanation = "Each effect of the catalogue was concealed on the independent ground. \
    Numbers: \
                       per cent of its cases in which the answer came up.";
    figure.write(explanation, [LEFT, 120], Style::new(LABEL).colour(GREY));
    figure.write("concealed (cases) ↓", [LEFT, TOP - 20], Style::new(LABEL));
    figure.write("named →", [LEFT, place.bottom() + 60], Style::new(LABEL));
    for (line, row) in two_lines(&note(), NAME, width + NAMES).iter().zip([60, 100]) {
        let line = fitted(line, NAME, width + NAMES);
        figure.write(line, [LEFT, place.bottom() + NAMES + row], Style::new(NAME).colour(GREY));
    }
    figure.panels.push(panel(of, place));
    figure
}

fn panel(of: &Confusion, place: Area) -> Panel {
    let rows =
        of.rows.iter().zip(&of.cases).map(|(name, cases)| {
            (format!("{name} ({cases})"), if *cases == 0 { GREY } else { INK })
        });
    let shares = of.shares.iter().flatten();
    let text = |share: f64| (share >= MIN_WRITTEN_SHARE).then(|| format!("{:.0}", 100.0 * share));
    let matrix = Matrix {
        rows: rows.collect(),
        columns: of.columns.iter().map(|name| ((*name).to_owned(), INK)).collect(),
        sizes: [NAME, NUMBER],
        cells: shares.map(|&share| (share, text(share))).collect(),
        scale: Scale::new(BLUES, [0.0, 1.0], "share of the row"),
    };
    let mut panel = matrix.panel(place, Some((1, GRID)));
    let cells = (0..of.rows.len()).flat_map(|row| (0..of.columns.len()).map(move |c| (row, c)));
    let right = cells.filter(|&(row, column)| of.is_right(row, column));
    let right = right.map(|(row, column)| Matrix::cell(row, column)).collect();
    panel.show_as("right answers", Boxes::framed(right, 4, INK));
    panel
}
