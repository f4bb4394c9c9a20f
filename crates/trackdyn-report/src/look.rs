//! Colours and markers of parameter sets.

use crate::canvas::{Area, Canvas};
use crate::colour::Rgb;

/// Colours that every kind of colour vision tells apart (Okabe and Ito, 2008).
const COLOURS: [Rgb; 6] =
    [[213, 94, 0], [0, 114, 178], [0, 158, 115], [204, 121, 167], [230, 159, 0], [86, 180, 233]];

/// Colour of the set at this place.
pub(super) fn colour(set: usize) -> Rgb {
    COLOURS[set % COLOURS.len()]
}

/// Marker of the set at this place: form tells sets apart where colour does not.
#[expect(clippy::cast_possible_truncation, reason = "places on the canvas")]
pub(super) fn marker(canvas: &mut Canvas, set: usize, centre: [f64; 2]) {
    const RADIUS: f64 = 10.0;
    let colour = colour(set);
    let [column, row] = centre.map(|place| place.round() as i32);
    let square = Area::new(column - 9, row - 9, 19, 19);
    match set % 4 {
        0 => canvas.disc(centre, RADIUS, colour),
        1 => canvas.fill(square, colour),
        2 => canvas.ring(centre, RADIUS - 2.0, 4.0, colour),
        _ => canvas.outline(square, 4, colour),
    }
}

/// A whisker over an interval of rows.
pub(super) fn whisker(canvas: &mut Canvas, column: f64, rows: [f64; 2], colour: Rgb) {
    const HALF: f64 = 7.0;
    canvas.line([column, rows[0]], [column, rows[1]], 3.0, colour);
    for row in rows {
        canvas.line([column - HALF, row], [column + HALF, row], 3.0, colour);
    }
}
