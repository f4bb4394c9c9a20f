//! A row of units below the header.

use super::{Columns, Key, Unit};
use crate::Error;
use crate::table::Table;

/// What a cell of a row of units may be.
const EXPECTED_CELL: &str = "a number, or in a row of units one that --columns takes and that is \
                             not contrary to it";

/// Columns with the units of the current row, where that is a row of units; none where it is not.
///
/// # Errors
/// [`Error::Cell`] for a unit that is not known, or is not the one that the user gave.
pub(super) fn of_row(columns: &Columns, table: &Table) -> Result<Option<Columns>, Error> {
    let at = |name: &str| table.column(name).map(|place| (place, unit_text(table.cell(place))));
    let cells = columns.columns.values().filter_map(|column| at(&column.name));
    let cells: Vec<(usize, String)> = cells.collect();
    let is_word = |(place, text): &(usize, String)| {
        let is_number = table.value(*place).is_some_and(|value| !value.is_nan());
        !is_number && !text.bytes().any(|byte| byte.is_ascii_digit())
    };
    let is_known =
        |(key, name): (&Key, &str)| at(name).is_some_and(|(_, text)| key.unit(&text).is_some());
    let mut named = columns.columns.iter().map(|(key, column)| (key, column.name.as_str()));
    if !cells.iter().all(is_word) || !named.any(is_known) {
        return Ok(None);
    }
    let mut found = columns.clone();
    for (key, column) in &mut found.columns {
        let Some((place, text)) = at(&column.name).filter(|(_, text)| !text.is_empty()) else {
            continue;
        };
        // A compass shows degrees too.
        if column.unit == Unit::Compass && key.unit(&text).is_some() {
            continue;
        }
        let unit = key.unit(&text).filter(|unit| column.unit == Unit::Open || column.unit == *unit);
        let Some(unit) = unit else {
            return Err(table.cell_error(place, EXPECTED_CELL));
        };
        column.unit = unit;
    }
    Ok(Some(found))
}

/// The text of a cell without brackets around it; nothing for a dash.
fn unit_text(cell: &[u8]) -> String {
    let text = String::from_utf8_lossy(cell);
    let text = text.trim_matches(|c: char| "[]() ".contains(c)).to_owned();
    if text == "-" { String::new() } else { text }
}
