//! What was taken for what.

use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::colour::{BLUES, FRAME, GREY, GRID, INK, WHITE};
use crate::colour_bar;
use crate::look;
use crate::panel::LABEL_SIZE;
use crate::sheet::{self, Mark, label_left_of, px, rows};
use crate::text::{Horizontal, Style, Vertical};
use trackdyn_core::real;

/// Legend, and the matrix below it.
const LEGEND: [i32; 2] = [sheet::LEFT, sheet::TOP + 20];
const REMARKS: i32 = sheet::TOP + 66;
const TOP: i32 = sheet::TOP + 170;
/// Size of the remarks and distance of their lines.
const REMARK: f32 = 22.0;
const LINE: i32 = 30;
const LABELS: i32 = 545;
/// Longest name of a column, and room around it for the axis label.
const LONGEST: i32 = 310;
const BELOW: i32 = 90;
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

/// The matrix of what a program took for what. `caption` stands below, for what the figure was made from.
///
/// Returns the bytes of a PNG. They depend on the arguments only.
///
/// # Errors
/// [`Error`] where a part cannot be drawn; no matrix is the cause of one.
pub fn confusion(matrix: &Matrix, program: &str, caption: &str) -> Result<Vec<u8>, Error> {
    let [down, across] = [matrix.rows, matrix.columns].map(|names| rows(names.len().max(1)));
    let cell = CELL.min((sheet::RIGHT - LABELS - RIGHT) / across);
    let area = Area::new(LABELS, TOP, cell * across, cell * down);
    let room = Canvas::new(1, 1)?;
    let widths = matrix.columns.iter().map(|name| room.text_width(name, 22.0).min(LONGEST));
    let below = BELOW + widths.max().unwrap_or(0);
    let height = area.bottom().max(TOP + 300) + below + sheet::FOOT;
    let title = format!("What {program} took for what");
    let explanation = "Each row is what was concealed, each column what was said; the number is how often, the \
                       colour its share of the row. Errors of instruments and of the vehicle file do not count. A set counts as one \
                       answer, by whether the truth is in it.";
    let mut canvas = sheet::sheet(height, &title, explanation, caption)?;
    let right = look::colour(0);
    sheet::legend(&mut canvas, LEGEND, &[(Mark::Box(right), "framed: as it should be")]);
    let remarks = sheet::two_lines(&canvas, matrix.remarks, REMARK);
    for (line, remark) in remarks.iter().enumerate() {
        let at = [LEGEND[0], REMARKS + rows(line) * LINE];
        let remark = canvas.fitted(remark, REMARK, sheet::RIGHT - LEGEND[0]);
        canvas.text(&remark, at, &Style::new(REMARK).colour(GREY));
    }
    for (row, name) in matrix.rows.iter().enumerate() {
        let middle = TOP + rows(row) * cell + cell / 2;
        let name = canvas.fitted(name, 22.0, LABELS - 130);
        label_left_of(&mut canvas, &name, [LABELS - 16, middle], 22.0, INK);
        let counts = &matrix.counts[row];
        let all = counts.iter().sum::<usize>().max(1);
        for (column, count) in counts.iter().enumerate() {
            let at = Area::new(LABELS + rows(column) * cell, TOP + rows(row) * cell, cell, cell);
            let share = real(*count) / real(all);
            canvas.fill(at, BLUES.at(share));
            canvas.outline(Area::new(at.left, at.top, cell + 1, cell + 1), 1, GRID);
            if *count > 0 {
                let colour = if share > 0.6 { WHITE } else { INK };
                let style = Style::new(22.0).colour(colour);
                let style = style.anchor(Horizontal::Centre, Vertical::Middle);
                canvas.text(&count.to_string(), [at.left + cell / 2, at.top + cell / 2], &style);
            }
        }
    }
    for (column, name) in matrix.columns.iter().enumerate() {
        let at = [LABELS + rows(column) * cell + cell / 2, area.bottom() + 14];
        let name = canvas.fitted(name, 22.0, LONGEST);
        let style = Style { upwards: true, ..Style::new(22.0) };
        canvas.text(&name, at, &style.anchor(Horizontal::Right, Vertical::Middle));
    }
    for [row, column] in &matrix.right {
        let own = Area::new(LABELS + rows(*column) * cell, TOP + rows(*row) * cell, cell, cell);
        canvas.outline(own, 4, right);
    }
    canvas.outline(Area::new(LABELS - 1, TOP - 1, area.width + 2, area.height + 2), 2, FRAME);
    let bar = Area::new(area.right() + 40, TOP, 28, px(300.0).min(area.height.max(120)));
    colour_bar::draw(&mut canvas, bar, &BLUES, [0.0, 1.0], "share of the row");
    let style = Style { upwards: true, ..Style::new(LABEL_SIZE) }.colour(GREY);
    let middle = TOP + area.height / 2;
    canvas.text(
        "concealed",
        [sheet::LEFT, middle],
        &style.anchor(Horizontal::Centre, Vertical::Top),
    );
    let style = Style::new(LABEL_SIZE).colour(GREY).anchor(Horizontal::Centre, Vertical::Baseline);
    canvas.text("said", [LABELS + area.width / 2, area.bottom() + below - 20], &style);
    canvas.to_small_png()
}
