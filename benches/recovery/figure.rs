//! The confusion matrix as a picture.

use crate::confusion::{Confusion, note};
use trackdyn_report::Error;
use trackdyn_report::canvas::{Area, Canvas};
use trackdyn_report::colour::{BLUES, FRAME, GREY, GRID, INK, WHITE};
use trackdyn_report::text::{Horizontal, Style, Vertical};

const LEFT: i32 = 60;
/// Room for names beside the rows and above the columns.
const NAMES: i32 = 420;
const TOP: i32 = 500;
const CELL: i32 = 58;
const FOOT: i32 = 190;
const RIGHT: i32 = 60;

/// Sizes of text, pixels; pictures are read at half their size.
const TITLE: f32 = 44.0;
const LABEL: f32 = 28.0;
const NAME: f32 = 25.0;
const NUMBER: f32 = 21.0;

/// Draws it: white is never, dark blue is always; a frame marks the right answer.
pub fn draw(of: &Confusion) -> Result<Vec<u8>, Error> {
    let rows = |count: usize| i32::try_from(count).unwrap_or(i32::MAX / 64) * CELL;
    let (width, height) = (rows(of.columns.len()), rows(of.rows.len()));
    let first = LEFT + NAMES;
    let pixels = |size: i32| u16::try_from(size).unwrap_or(u16::MAX);
    let mut canvas = Canvas::new(pixels(first + width + RIGHT), pixels(TOP + height + FOOT))?;
    canvas.text("What was taken for what", [LEFT, 72], &Style::new(TITLE));
    let explanation = "Each effect of the catalogue was concealed on the independent ground. Numbers: per cent of \
                       its cases in which the answer came up.";
    canvas.text(explanation, [LEFT, 120], &Style::new(LABEL).colour(GREY));
    let upwards =
        Style { upwards: true, ..Style::new(NAME).anchor(Horizontal::Left, Vertical::Middle) };
    for (column, name) in of.columns.iter().enumerate() {
        let at = [first + rows(column) + CELL / 2, TOP - 14];
        canvas.text(name, at, &upwards);
    }
    let beside = Style::new(NAME).anchor(Horizontal::Right, Vertical::Middle);
    for (row, name) in of.rows.iter().enumerate() {
        let top = TOP + rows(row);
        let colour = if of.cases[row] == 0 { GREY } else { INK };
        let text = format!("{name} ({})", of.cases[row]);
        canvas.text(&text, [first - 14, top + CELL / 2], &beside.colour(colour));
        for (column, share) in of.shares[row].iter().enumerate() {
            let cell = Area::new(first + rows(column), top, CELL, CELL);
            fill(&mut canvas, cell, *share);
            if of.is_right(row, column) {
                let inside = Area::new(cell.left + 2, cell.top + 2, CELL - 4, CELL - 4);
                canvas.outline(inside, 4, INK);
            }
        }
    }
    canvas.outline(Area::new(first - 1, TOP - 1, width + 2, height + 2), 2, FRAME);
    let axis = Style::new(LABEL).anchor(Horizontal::Left, Vertical::Baseline);
    canvas.text("concealed (cases) ↓", [LEFT, TOP - 20], &axis);
    canvas.text("named →", [LEFT, TOP - 70], &axis);
    let text = note();
    let (line, rest) = text.split_at(text.find(": ").map_or(0, |_| text.len() / 2));
    let at = line.rfind(' ').unwrap_or(0);
    let lines = [&line[..at], &format!("{}{rest}", &line[at..])].map(|line| line.trim().to_owned());
    for (line, row) in lines.iter().zip([60, 100]) {
        let line = canvas.fitted(line, NAME, width + NAMES);
        canvas.text(&line, [LEFT, TOP + height + row], &Style::new(NAME).colour(GREY));
    }
    canvas.to_small_png()
}

fn fill(canvas: &mut Canvas, cell: Area, share: f64) {
    canvas.fill(cell, BLUES.at(share));
    canvas.outline(cell, 1, GRID);
    if share >= 0.005 {
        let colour = if share > 0.55 { WHITE } else { INK };
        let style = Style::new(NUMBER).anchor(Horizontal::Centre, Vertical::Middle).colour(colour);
        let middle = [cell.left + CELL / 2, cell.top + CELL / 2];
        canvas.text(&format!("{:.0}", 100.0 * share), middle, &style);
    }
}
