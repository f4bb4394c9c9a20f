//! What was taken for what.

use crate::colour::{BLUES, GREY, GRID, INK, Rgb};
use crate::figure::{
    self, Area, Boxes, ColourBar, Figure, Legend, Panel, Scale, Swatch, entry_colour,
};
use crate::sheet::{self, rows};
use crate::text::{Horizontal, LABEL_SIZE, Style, Vertical, fitted, two_lines, width};
use trackdyn_core::real;

/// Legend, and the matrix below it.
const LEGEND: [i32; 2] = [sheet::LEFT, sheet::TOP + 20];
const REMARKS: i32 = sheet::TOP + 66;
const TOP: i32 = sheet::TOP + 170;
/// Size of the remarks and distance of their lines.
const REMARK: f32 = 22.0;
const LINE: i32 = 30;
const LABELS: i32 = 545;
/// Size and longest name of a row or column, and room around names of columns for the axis label.
const NAME: f32 = 22.0;
const MAX_NAME: i32 = 310;
const ROOM_BELOW: i32 = 90;
/// Largest side of a cell, and room right of the cells.
const CELL: i32 = 64;
const RIGHT: i32 = 260;

/// Counts by what is there (rows) and what was said (columns).
#[derive(Clone, Debug)]
pub struct Matrix<'a> {
    /// What there is.
    pub rows: &'a [String],
    /// What was said.
    pub columns: &'a [String],
    /// Counts, row by row.
    pub counts: Vec<Vec<usize>>,
    /// Places, row and column, where what was said is right.
    pub right: Vec<[usize; 2]>,
    /// What the names of columns mean that do not speak for themselves.
    pub remarks: &'a str,
}

/// The matrix of what a program took for what. `caption` stands below, for what the figure was made
/// from.
pub fn confusion(matrix: &Matrix, program: &str, caption: &str) -> Figure {
    let [down, across] = [matrix.rows, matrix.columns].map(|names| rows(names.len().max(1)));
    let cell = CELL.min((sheet::RIGHT - LABELS - RIGHT) / across);
    let area = Area::new(LABELS, TOP, cell * across, cell * down);
    let widths = matrix.columns.iter().map(|name| width(name, NAME).min(MAX_NAME));
    let below = ROOM_BELOW + widths.max().unwrap_or(0);
    let height = area.bottom().max(TOP + 300) + below + sheet::FOOT;
    let title = format!("What {program} took for what");
    let explanation = "Each row is what was concealed, each column what was said; the number is \
                       how often, the colour its share of the row. Errors of instruments and of \
                       the vehicle file do not count. A set counts as one answer, by whether the \
                       truth is in it.";
    let mut figure = sheet::sheet("confusion", height, &title, explanation, caption);
    let right = entry_colour(0);
    let entry = (Swatch::Box(right), "framed: as it should be");
    figure.legends.push(Legend::of_marks(LEGEND, sheet::RIGHT, [entry]));
    let remarks = two_lines(matrix.remarks, REMARK, sheet::RIGHT - sheet::LEFT);
    for (line, remark) in remarks.iter().enumerate() {
        let style = Style::new(REMARK).colour(GREY);
        sheet::line(&mut figure, remark, REMARKS + rows(line) * LINE, style);
    }
    figure.panels.push(panel(matrix, area, right));
    let style = Style { upwards: true, ..Style::new(LABEL_SIZE) }.colour(GREY);
    let style = style.anchor(Horizontal::Centre, Vertical::Top);
    figure.write("concealed", [sheet::LEFT, TOP + area.height / 2], style);
    let style = Style::new(LABEL_SIZE).colour(GREY).anchor(Horizontal::Centre, Vertical::Baseline);
    figure.write("said", [LABELS + area.width / 2, area.bottom() + below - 20], style);
    figure
}

/// The cells with their numbers and names.
fn panel(matrix: &Matrix, area: Area, right: Rgb) -> Panel {
    let names = |names: &[String], room| -> Vec<(String, Rgb)> {
        names.iter().map(|name| (fitted(name, NAME, room), INK)).collect()
    };
    let cells = matrix.counts.iter().flat_map(|counts| {
        let all = counts.iter().sum::<usize>().max(1);
        let text = |count: usize| (count > 0).then(|| count.to_string());
        counts.iter().map(move |&count| (real(count) / real(all), text(count)))
    });
    let scale = Scale::new(BLUES, [0.0, 1.0], "share of the row");
    let bar = Area::new(area.right() + 40, TOP, 28, 300.min(area.height.max(120)));
    let bar = ColourBar { place: bar, scale: scale.clone() };
    let cells = figure::Matrix {
        rows: names(matrix.rows, LABELS - 130),
        columns: names(matrix.columns, MAX_NAME),
        sizes: [NAME; 2],
        cells: cells.collect(),
        scale,
    };
    let mut panel = cells.panel(area, Some((1, GRID)));
    let framed = matrix.right.iter().map(|&[row, column]| figure::Matrix::cell(row, column));
    panel.show_as("as it should be", Boxes::framed(framed.collect(), 4, right));
    panel.colour_bars.push(bar);
    panel
}
