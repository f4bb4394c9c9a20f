//! Legends.

use super::marks::marker;
use super::paper::Paper;
use super::whole;
use crate::figure::{Area, Legend, Swatch};
use crate::text::{Horizontal, Style, Vertical, fitted, width};

/// Distance between lines, pixels.
const LINE: i32 = 40;
/// Lines at most.
const MAX_LINES: usize = 2;
/// Longest name, pixels.
const MAX_NAME: i32 = 900;

/// Draws as many entries as have room, and how many have none.
pub(super) fn draw(paper: &mut impl Paper, legend: &Legend) {
    let Legend { size, sample, gaps: [to_text, between], .. } = *legend;
    let style = Style::new(size).anchor(Horizontal::Left, Vertical::Middle);
    let (mut at, mut line) = (legend.at, 1);
    for (index, entry) in legend.entries.iter().enumerate() {
        let name = fitted(&entry.text, size, MAX_NAME);
        let needed = sample + to_text + width(&name, size);
        let left = legend.entries.len() - index;
        let more = format!("and {left} more");
        // The last line keeps room for saying how many have none
        let room = if line == MAX_LINES && left > 1 { between + width(&more, size) } else { 0 };
        if at[0] + needed + room > legend.right && index > 0 {
            if line == MAX_LINES {
                return paper.text(&more, at, &style);
            }
            (at, line) = ([legend.at[0], at[1] + LINE], line + 1);
        }
        for swatch in &entry.swatches {
            draw_swatch(paper, *swatch, at.map(f64::from), f64::from(sample));
        }
        paper.text(&name, [at[0] + sample + to_text, at[1]], &style);
        at[0] += needed + between;
    }
}

fn draw_swatch(paper: &mut impl Paper, swatch: Swatch, [left, row]: [f64; 2], sample: f64) {
    let (right, middle) = (left + sample, left + sample / 2.0);
    match swatch {
        Swatch::Line(colour, thickness) => {
            paper.line([left, row], [right, row], thickness, colour);
        }
        Swatch::Box(colour) => {
            paper.fill(Area::new(whole(middle) - 16, whole(row) - 11, 32, 22), colour);
        }
        Swatch::Marker(of) => marker(paper, of, [middle, row]),
    }
}
