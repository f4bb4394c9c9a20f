//! What figures with a heading share.

use crate::colour::{GREY, INK};
use crate::figure::Figure;
use crate::text::{Style, fitted, two_lines};

/// Columns of every figure.
pub(crate) const WIDTH: i32 = 2400;
/// Left end of all lines of text.
pub(crate) const LEFT: i32 = 40;
/// Right end.
pub(crate) const RIGHT: i32 = 2360;
/// First row below the heading.
pub(crate) const TOP: i32 = 180;
/// Rows that the caption takes.
pub(crate) const FOOT: i32 = 70;

/// Places of the entries among the colours of figures.
pub(crate) const BEFORE_COLOUR: usize = 0;
pub(crate) const AFTER_COLOUR: usize = 1;

/// Size of the explanation below the title, pixels.
const EXPLANATION_SIZE: f32 = 25.0;

/// An empty figure with these texts around it.
pub(crate) fn sheet(
    name: &str,
    height: i32,
    title: &str,
    explanation: &str,
    caption: &str,
) -> Figure {
    let mut figure = Figure::new(name, [WIDTH, height]);
    let [first, second] = two_lines(explanation, EXPLANATION_SIZE, RIGHT - LEFT);
    for (text, size, colour, row) in [
        (title, 40.0, INK, 68),
        (&first, EXPLANATION_SIZE, GREY, 112),
        (&second, EXPLANATION_SIZE, GREY, 146),
        (caption, 22.0, GREY, height - 26),
    ] {
        line(&mut figure, text, row, Style::new(size).colour(colour));
    }
    figure
}

/// Writes a line of text, or as much of it as fits.
pub(crate) fn line(figure: &mut Figure, text: &str, row: i32, style: Style) {
    figure.write(fitted(text, style.size, RIGHT - LEFT), [LEFT, row], style);
}

/// A count as pixels or rows.
pub(crate) fn rows(count: usize) -> i32 {
    i32::try_from(count).unwrap_or(i32::MAX / 64)
}

/// The finite value below which a share of the finite ones lies; none of no values.
pub(crate) fn quantile(values: impl Iterator<Item = f64>, share: f64) -> Option<f64> {
    let mut finite: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    trackdyn_core::robust::quantile(&mut finite, share)
}
