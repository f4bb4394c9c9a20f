//! Colours, markers and lines of what a figure compares.

use crate::canvas::{Area, Canvas};
use crate::colour::Rgb;

/// Colours that every kind of colour vision tells apart (Okabe and Ito, 2008).
const COLOURS: [Rgb; 6] =
    [[213, 94, 0], [0, 114, 178], [0, 158, 115], [204, 121, 167], [230, 159, 0], [86, 180, 233]];

/// Colour of the entry at this place.
pub(crate) fn colour(entry: usize) -> Rgb {
    COLOURS[entry % COLOURS.len()]
}

/// Marker of the entry at this place: form tells entries apart where colour does not.
#[expect(clippy::cast_possible_truncation, reason = "places on the canvas")]
pub(crate) fn marker(canvas: &mut Canvas, entry: usize, centre: [f64; 2]) {
    const RADIUS: f64 = 10.0;
    let colour = colour(entry);
    let [column, row] = centre.map(|place| place.round() as i32);
    let square = Area::new(column - 9, row - 9, 19, 19);
    match entry % 4 {
        0 => canvas.disc(centre, RADIUS, colour),
        1 => canvas.fill(square, colour),
        2 => canvas.ring(centre, RADIUS - 2.0, 4.0, colour),
        _ => canvas.outline(square, 4, colour),
    }
}

/// A whisker over an interval of rows.
pub(crate) fn whisker(canvas: &mut Canvas, column: f64, rows: [f64; 2], colour: Rgb) {
    const HALF: f64 = 7.0;
    canvas.line([column, rows[0]], [column, rows[1]], 3.0, colour);
    for row in rows {
        canvas.line([column - HALF, row], [column + HALF, row], 3.0, colour);
    }
}

/// A line through places on the canvas; steps shorter than a pixel are joined.
pub(crate) fn line(
    canvas: &mut Canvas,
    places: impl IntoIterator<Item = [f64; 2]>,
    thickness: f64,
    colour: Rgb,
) {
    let mut places = places.into_iter();
    let Some(mut from) = places.next() else { return };
    let mut to = from;
    for next in places {
        to = next;
        if (to[0] - from[0]).hypot(to[1] - from[1]) >= 1.0 {
            canvas.line(from, to, thickness, colour);
            from = to;
        }
    }
    canvas.line(from, to, thickness, colour);
}
