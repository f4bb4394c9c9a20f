//! Paths as CSV: `x,y`.

use super::Path;
use crate::Error;
use std::fmt::Write;
use trackdyn_recording::table::Table;

/// Places further away than this are taken for a wrong unit, m.
const MAX_PLACE: f64 = 1e7;

impl Path {
    /// Reads a table `x,y` of points, m.
    ///
    /// # Errors
    /// [`Error::Recording`] with line and column of a cell that is not a number, and of a point in
    /// the place of the one before it; [`Error::TooLittle`] for fewer than two points.
    pub fn read(path: &std::path::Path) -> Result<Self, Error> {
        let mut table = Table::open(path, &["x", "y"])?;
        let columns = ["x", "y"].map(|name| table.column(name).unwrap_or_default());
        let mut points: Vec<[f64; 2]> = Vec::new();
        while table.advance()? {
            let mut point = [0.0; 2];
            for (value, column) in point.iter_mut().zip(columns) {
                *value = table.finite(column)?;
                if value.abs() > MAX_PLACE {
                    return Err(table.cell_error(column, "at most 10000000 m").into());
                }
            }
            // pieces shorter than a nanometre have no direction
            if points.last().is_some_and(|last| super::distance(*last, point) < 1e-9) {
                let expected = "a point away from that of the row before it";
                return Err(table.cell_error(columns[0], expected).into());
            }
            points.push(point);
        }
        if points.len() < 2 {
            return Err(Error::TooLittle {
                path: path.to_owned(),
                found: format!("{} points", points.len()),
                expected: "two points or more",
            });
        }
        Self::new(points)
    }

    /// The text of a table that reads back to the same bits.
    pub fn to_csv(&self) -> String {
        let mut text = String::from("x,y\n");
        for [x, y] in self.points() {
            let _ = writeln!(text, "{x},{y}");
        }
        text
    }
}
