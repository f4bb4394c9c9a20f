//! What figures with a heading share: paper, colours of before and after, axes of rows.

use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::colour::{FRAME, GREY, GRID, INK, Rgb};
use crate::look;
use crate::panel::ticks::{Ticks, number};
use crate::panel::{LABEL_SIZE, Panel, TICK_SIZE};
use crate::text::{Horizontal, Style, Vertical};

/// Columns of every figure.
pub(crate) const WIDTH: u16 = 2400;
/// Left end of all lines of text.
pub(crate) const LEFT: i32 = 40;
/// Right end.
pub(crate) const RIGHT: i32 = 2360;
/// First row below the heading.
pub(crate) const TOP: i32 = 180;
/// Rows that the caption takes.
pub(crate) const FOOT: i32 = 70;

/// Places of the entries among the colours of figures.
pub(crate) const BEFORE: usize = 0;
pub(crate) const AFTER: usize = 1;

/// A picture whose pixels have these texts around them.
pub(crate) fn sheet(
    height: i32,
    title: &str,
    explanation: &str,
    caption: &str,
) -> Result<Canvas, Error> {
    let mut canvas = Canvas::new(WIDTH, u16::try_from(height).unwrap_or(u16::MAX))?;
    let [first, second] = two_lines(&canvas, explanation, EXPLANATION);
    let lines = [
        (title, 40.0, INK, 68),
        (first.as_str(), EXPLANATION, GREY, 112),
        (second.as_str(), EXPLANATION, GREY, 146),
        (caption, 22.0, GREY, height - 26),
    ];
    for (text, size, colour, row) in lines {
        let text = canvas.fitted(text, size, RIGHT - LEFT);
        canvas.text(&text, [LEFT, row], &Style::new(size).colour(colour));
    }
    Ok(canvas)
}

/// Size of the explanation below the title, pixels.
const EXPLANATION: f32 = 25.0;

/// A text broken where the first line is full.
pub(crate) fn two_lines(canvas: &Canvas, text: &str, size: f32) -> [String; 2] {
    let (mut first, mut second) = (String::new(), String::new());
    for word in text.split_whitespace() {
        let longer = if first.is_empty() { word.to_owned() } else { format!("{first} {word}") };
        if second.is_empty() && canvas.text_width(&longer, size) <= RIGHT - LEFT {
            first = longer;
        } else {
            if !second.is_empty() {
                second.push(' ');
            }
            second.push_str(word);
        }
    }
    [first, second]
}

/// A pixel.
#[expect(clippy::cast_possible_truncation, reason = "places on the canvas")]
pub(crate) fn px(place: f64) -> i32 {
    place.clamp(-1e6, 1e6).round() as i32
}

/// A count as pixels or rows.
pub(crate) fn rows(count: usize) -> i32 {
    i32::try_from(count).unwrap_or(i32::MAX / 64)
}

/// What a mark of a legend looks like.
#[derive(Clone, Copy)]
pub(crate) enum Mark {
    Line(Rgb, f64),
    Disc(Rgb),
    Ring(Rgb),
    Box(Rgb),
    Entry(usize),
}

impl Mark {
    pub(crate) fn draw(self, canvas: &mut Canvas, at: [f64; 2]) {
        match self {
            Self::Line(colour, thickness) => {
                canvas.line([at[0] - 24.0, at[1]], [at[0] + 24.0, at[1]], thickness, colour);
            }
            Self::Disc(colour) => canvas.disc(at, 9.0, colour),
            Self::Ring(colour) => canvas.ring(at, 8.0, 3.5, colour),
            Self::Box(colour) => {
                canvas.fill(Area::new(px(at[0]) - 16, px(at[1]) - 11, 32, 22), colour);
            }
            Self::Entry(entry) => look::marker(canvas, entry, at),
        }
    }
}

/// Draws entries in a row from a place on.
pub(crate) fn legend(canvas: &mut Canvas, at: [i32; 2], entries: &[(Mark, &str)]) {
    let style = Style::new(TICK_SIZE).anchor(Horizontal::Left, Vertical::Middle);
    let mut column = at[0];
    for (mark, text) in entries {
        mark.draw(canvas, [f64::from(column + 24), f64::from(at[1])]);
        canvas.text(text, [column + 60, at[1]], &style);
        column += 60 + canvas.text_width(text, TICK_SIZE) + 50;
    }
}

/// Draws a panel's upright grid lines with their texts below, and the axis label.
pub(crate) fn axis_below(canvas: &mut Canvas, panel: &Panel, ticks: &[(f64, String)], label: &str) {
    let Area { top, height, left, width } = panel.plot;
    let bottom = panel.plot.bottom();
    let style = Style::new(TICK_SIZE).colour(GREY).anchor(Horizontal::Centre, Vertical::Top);
    for (value, text) in ticks {
        let column = px(panel.pixel([*value, 0.0])[0]);
        canvas.fill(Area::new(column, top, 1, height), GRID);
        canvas.fill(Area::new(column, bottom, 2, 8), FRAME);
        canvas.text(text, [column, bottom + 16], &style);
    }
    let style = Style::new(LABEL_SIZE).anchor(Horizontal::Centre, Vertical::Top);
    canvas.text(label, [left + width / 2, bottom + 50], &style);
}

/// Draws a panel's level grid lines with their numbers at the left, and the axis label.
pub(crate) fn axis_left(canvas: &mut Canvas, panel: &Panel, label: &str) {
    let Area { left, width, height, top } = panel.plot;
    let ticks = Ticks::along(panel.y, height, 60);
    for value in &ticks.values {
        let row = px(panel.pixel([0.0, *value])[1]);
        canvas.fill(Area::new(left, row, width, 1), GRID);
        let text = number(*value, ticks.decimals);
        label_left_of(canvas, &text, [left - 14, row], TICK_SIZE, GREY);
    }
    let style = Style { upwards: true, ..Style::new(LABEL_SIZE) };
    let style = style.anchor(Horizontal::Centre, Vertical::Top);
    canvas.text(label, [left - 110, top + height / 2], &style);
}

/// Draws a broken upright line over a panel.
pub(crate) fn dashes(canvas: &mut Canvas, panel: &Panel, x: f64, colour: Rgb) {
    let column = px(panel.pixel([x, 0.0])[0]);
    for row in (panel.plot.top..panel.plot.bottom()).step_by(16) {
        canvas.fill(Area::new(column - 1, row, 3, 9), colour);
    }
}

/// Writes a text that ends at a column, in the middle of a row.
pub(crate) fn label_left_of(canvas: &mut Canvas, text: &str, at: [i32; 2], size: f32, colour: Rgb) {
    let style = Style::new(size).colour(colour).anchor(Horizontal::Right, Vertical::Middle);
    canvas.text(text, at, &style);
}

/// Writes a text from a column on, in the middle of a row.
pub(crate) fn label_right_of(
    canvas: &mut Canvas,
    text: &str,
    at: [i32; 2],
    size: f32,
    colour: Rgb,
) {
    let style = Style::new(size).colour(colour).anchor(Horizontal::Left, Vertical::Middle);
    canvas.text(text, at, &style);
}

/// A whisker over an interval of columns.
pub(crate) fn whisker(canvas: &mut Canvas, columns: [f64; 2], row: f64, colour: Rgb) {
    const HALF: f64 = 6.0;
    canvas.line([columns[0], row], [columns[1], row], 3.0, colour);
    for column in columns {
        canvas.line([column, row - HALF], [column, row + HALF], 3.0, colour);
    }
}

/// The value below which a share of the values lies; none of no values.
pub(crate) fn quantile(values: impl Iterator<Item = f64>, share: f64) -> Option<f64> {
    let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    let last = values.len().checked_sub(1)?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index")]
    let place = (share * trackdyn_core::real(last)).round() as usize;
    values.get(place.min(last)).copied()
}
