//! Positions of a table: metres, or latitude and longitude.

use super::{Column, Columns, Key, Unit};
use crate::table::Table;
use crate::wgs84::east_north;
use crate::{Error, PoseUnit};

/// What latitude and longitude may be.
const LATITUDE: &str = "a latitude between -90 and 90 degrees";
const LONGITUDE: &str = "a longitude between -180 and 180 degrees";

/// Where the position of a row stands.
pub(super) enum Places {
    /// Nowhere.
    None,
    /// Columns of x and y, with metres per number.
    Metres([(usize, f64); 2]),
    /// Columns of latitude and longitude, degrees. Their first place is the origin.
    Degrees { columns: [usize; 2], origin: Option<[f64; 3]> },
}

impl Places {
    /// The columns of a table; `open` is the unit of x and y that have none.
    pub(super) fn of(table: &Table, columns: &Columns, open: PoseUnit) -> Self {
        let at = |key: Key| {
            let column = columns.columns.get(&key)?;
            Some((table.column(&column.name)?, column))
        };
        let metres = |(place, column): (usize, &Column)| {
            let open = if column.unit == Unit::Open { open.factor() } else { 1.0 };
            (place, open * column.factor())
        };
        if let Some((x, y)) = at(Key::X).zip(at(Key::Y)) {
            return Self::Metres([metres(x), metres(y)]);
        }
        match at(Key::Latitude).zip(at(Key::Longitude)) {
            Some(((latitude, _), (longitude, _))) => {
                Self::Degrees { columns: [latitude, longitude], origin: None }
            }
            None => Self::None,
        }
    }

    /// x and y of the current row, m; NaN where they were not measured. Those of latitude and
    /// longitude are metres east and north of the first place.
    pub(super) fn read(&mut self, table: &Table) -> Result<[f64; 2], Error> {
        match self {
            Self::None => Ok([f64::NAN; 2]),
            Self::Metres([(x, of_x), (y, of_y)]) => {
                Ok([*of_x * table.number(*x)?, *of_y * table.number(*y)?])
            }
            Self::Degrees { columns: [latitude, longitude], origin } => {
                let within = |column: usize, most: f64, expected: &'static str| {
                    let degrees = table.number(column)?;
                    let is_beyond = degrees.abs() > most;
                    if is_beyond { Err(table.cell_error(column, expected)) } else { Ok(degrees) }
                };
                let fix = [
                    within(*latitude, 90.0, LATITUDE)?,
                    within(*longitude, 180.0, LONGITUDE)?,
                    0.0,
                ];
                // A receiver without a fix says 0, 0.
                let is_seen = fix.iter().all(|degrees| !degrees.is_nan());
                if !is_seen || fix == [0.0; 3] {
                    return Ok([f64::NAN; 2]);
                }
                Ok(east_north(*origin.get_or_insert(fix), fix))
            }
        }
    }
}
