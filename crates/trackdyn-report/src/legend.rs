//! Which entry of a figure has which colour.

use crate::canvas::{Area, Canvas};
use crate::colour::INK;
use crate::look;
use crate::text::{Horizontal, Style, Vertical};

const SIZE: f32 = 26.0;
/// Length of a sample of a line, pixels.
const SAMPLE: i32 = 64;
/// Distance between a sample and its text, and between entries, pixels.
const GAPS: [i32; 2] = [14, 46];
/// Distance between lines, pixels.
const LINE: i32 = 40;
/// Lines at most.
const LINES: usize = 2;
/// Longest name, pixels.
const LONGEST: i32 = 420;

/// Draws an entry for what the others are compared with and one for each of them, in one or two lines.
pub(crate) fn draw<'a>(
    canvas: &mut Canvas,
    area: Area,
    first: &'a str,
    names: impl Iterator<Item = &'a str>,
) {
    let style = Style::new(SIZE).anchor(Horizontal::Left, Vertical::Middle);
    let names: Vec<&str> = std::iter::once(first).chain(names).collect();
    let (mut at, mut line) = ([area.left, area.top + LINE / 2], 1);
    for (entry, name) in names.iter().enumerate() {
        let name = canvas.fitted(name, SIZE, LONGEST);
        let width = SAMPLE + GAPS[0] + canvas.text_width(&name, SIZE);
        let left = names.len() - entry;
        let more = format!("and {left} more");
        // the last line keeps room for saying how many have none
        let room =
            if line == LINES && left > 1 { GAPS[1] + canvas.text_width(&more, SIZE) } else { 0 };
        if at[0] + width + room > area.right() && entry > 0 {
            if line == LINES {
                canvas.text(&more, at, &style);
                return;
            }
            (at, line) = ([area.left, at[1] + LINE], line + 1);
        }
        let [left, row] = at.map(f64::from);
        let right = left + f64::from(SAMPLE);
        match entry.checked_sub(1) {
            None => canvas.line([left, row], [right, row], 8.0, INK),
            Some(entry) => {
                canvas.line([left, row], [right, row], 4.0, look::colour(entry));
                look::marker(canvas, entry, [f64::midpoint(left, right), row]);
            }
        }
        canvas.text(&name, [at[0] + SAMPLE + GAPS[0], at[1]], &style);
        at[0] += width + GAPS[1];
    }
}
