//! Drives in numbers.

use super::TrackedDrive;
use crate::colour::{FRAME, GREY, GRID, INK, Rgb};
use crate::figure::{Area, Boxes, Label, Marker, Paint, Panel, Points};
use crate::text::{TICK_SIZE, TITLE_SIZE, fitted};
use crate::ticks::number;
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

/// A row for each drive, as many as there is room for, and how many more there are.
pub(super) fn panel(area: Area, path: &Path, drives: &[TrackedDrive], point: [f64; 2]) -> Panel {
    let mut panel = Panel::of_sheet(area.grown(ROW));
    let at = |column: i32, row: i32| [column, row].map(f64::from);
    let end = |column: usize| {
        let later = i32::try_from(COLUMNS.len() - 1 - column).unwrap_or_default();
        area.right() - later * COLUMN
    };
    let title = Label::right_of("Distances", at(area.left, area.top), 0, (TITLE_SIZE, INK));
    panel.labels.push(title);
    for (column, name) in COLUMNS.iter().enumerate() {
        panel.labels.push(Label::left_of(name, at(end(column), area.top), 0, (TICK_SIZE, GREY)));
    }
    let below = |row: i32, height: i32, colour: Rgb| {
        let top = row + ROW / 2;
        Boxes::new(vec![[at(area.left, top + height), at(area.right(), top)]], Paint::One(colour))
    };
    panel.show(below(area.top, 2, FRAME));
    let room = usize::try_from(area.height / ROW - 1).unwrap_or_default();
    let shown = if drives.len() > room { room.saturating_sub(1) } else { drives.len() };
    let names = area.width - 4 * COLUMN - MARKER;
    let mut row = area.top;
    for (entry, TrackedDrive { name, journey }) in drives.iter().enumerate().take(shown) {
        row += ROW;
        panel.show(Points::new(vec![at(area.left + 12, row)], Marker::of_entry(entry)));
        let name = match journey.ending {
            Ending::Arrived => (*name).to_owned(),
            Ending::OutOfTime => format!("{name} (out of time)"),
            _ => format!("{name} (stopped)"),
        };
        let name = fitted(&name, TICK_SIZE, names);
        panel.labels.push(Label::right_of(&name, at(area.left, row), MARKER, (TICK_SIZE, INK)));
        let Summary { rms, max, end_distance, end_belief, .. } = journey.summary(path, point);
        for (column, value) in [rms, max, end_distance, end_belief].into_iter().enumerate() {
            let number = Label::left_of(&length(value), at(end(column), row), 0, (TICK_SIZE, INK));
            panel.labels.push(number);
        }
        panel.show(below(row, 2, GRID));
    }
    if drives.len() > shown {
        let more = format!("and {} more: see the tables", drives.len() - shown);
        let style = (TICK_SIZE, GREY);
        panel.labels.push(Label::right_of(&more, at(area.left, row + ROW), MARKER, style));
    }
    panel
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
