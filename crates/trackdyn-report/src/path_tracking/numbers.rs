//! Drives in numbers.

use super::TrackedDrive;
use crate::canvas::{Area, Canvas};
use crate::colour::{FRAME, GREY, GRID};
use crate::look;
use crate::panel::ticks::number;
use crate::panel::{TICK_SIZE, TITLE_SIZE};
use crate::text::{Horizontal, Style, Vertical};
use trackdyn_drive::tracking::Summary;
use trackdyn_drive::{Ending, Path};

/// Names of the columns of numbers.
const COLUMNS: [&str; 4] = ["rms", "largest", "from the end", "belief off by"];
/// Width of a column of numbers, pixels.
const COLUMN: i32 = 175;
/// Height of a row, pixels.
const ROW: i32 = 52;
/// Room for the marker, pixels.
const MARKER: i32 = 44;

/// Draws a row for each drive, as many as there is room for, and says how many more there are.
pub(super) fn draw(
    canvas: &mut Canvas,
    area: Area,
    path: &Path,
    drives: &[TrackedDrive],
    point: [f64; 2],
) {
    let left = Style::new(TICK_SIZE).anchor(Horizontal::Left, Vertical::Middle);
    let right = Style::new(TICK_SIZE).anchor(Horizontal::Right, Vertical::Middle);
    let end = |column: usize| {
        let later = i32::try_from(COLUMNS.len() - 1 - column).unwrap_or_default();
        area.right() - later * COLUMN
    };
    let title = Style::new(TITLE_SIZE).anchor(Horizontal::Left, Vertical::Middle);
    canvas.text("Distances", [area.left, area.top], &title);
    for (column, name) in COLUMNS.iter().enumerate() {
        canvas.text(name, [end(column), area.top], &right.colour(GREY));
    }
    canvas.fill(Area::new(area.left, area.top + ROW / 2, area.width, 2), FRAME);
    let room = usize::try_from(area.height / ROW - 1).unwrap_or_default();
    let shown = if drives.len() > room { room.saturating_sub(1) } else { drives.len() };
    let names = area.width - 4 * COLUMN - MARKER;
    let mut row = area.top;
    for (entry, TrackedDrive { name, journey }) in drives.iter().enumerate().take(shown) {
        row += ROW;
        look::marker(canvas, entry, [f64::from(area.left) + 12.0, f64::from(row)]);
        let name = match journey.ending {
            Ending::Arrived => (*name).to_owned(),
            Ending::OutOfTime => format!("{name} (out of time)"),
            _ => format!("{name} (stopped)"),
        };
        let name = canvas.fitted(&name, TICK_SIZE, names);
        canvas.text(&name, [area.left + MARKER, row], &left);
        let Summary { rms, max, end_distance, end_belief, .. } = journey.summary(path, point);
        for (column, value) in [rms, max, end_distance, end_belief].into_iter().enumerate() {
            canvas.text(&length(value), [end(column), row], &right);
        }
        canvas.fill(Area::new(area.left, row + ROW / 2, area.width, 2), GRID);
    }
    if drives.len() > shown {
        let more = format!("and {} more: see the tables", drives.len() - shown);
        canvas.text(&more, [area.left + MARKER, row + ROW], &left.colour(GREY));
    }
}

/// A length with two or three digits and its unit.
fn length(value: f64) -> String {
    match value {
        value if value < 1e-5 => "0 mm".to_owned(),
        value if value < 0.0995 => format!("{} mm", number(1e3 * value, 1)),
        value if value < 0.9995 => format!("{} mm", number(1e3 * value, 0)),
        value => format!("{} m", number(value, 2)),
    }
}

#[cfg(test)]
mod tests {
    use super::length;

    #[test]
    fn lengths_have_the_unit_that_suits_them() {
        assert_eq!(
            [3e-6, 8.3e-4, 0.1248, 7.147].map(length),
            ["0 mm", "0.8 mm", "125 mm", "7.15 m"]
        );
    }
}
