//! Positions of a table: metres, or latitude and longitude.

use super::{Columns, Key, Unit};
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
    /// Columns of latitude and longitude, with degrees per number. Their first place is the origin.
    Degrees { columns: [(usize, f64); 2], origin: Option<[f64; 3]> },
}

impl Places {
    /// The columns of a table; `open` is the unit of x and y that have none.
    pub(super) fn of(table: &Table, columns: &Columns, open: PoseUnit) -> Self {
        let at = |key: Key, open: f64| {
            let (place, column) = columns.at(key, table)?;
            let open = if column.unit == Unit::Open { open } else { 1.0 };
            Some((place, open * column.factor()))
        };
        let both = |[first, second]: [Key; 2], open| Some([at(first, open)?, at(second, open)?]);
        if let Some(columns) = both([Key::X, Key::Y], open.factor()) {
            return Self::Metres(columns);
        }
        match both([Key::Latitude, Key::Longitude], 1.0) {
            Some(columns) => Self::Degrees { columns, origin: None },
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
                let within = |(column, factor): (usize, f64), most: f64, expected: &'static str| {
                    let degrees = factor * table.number(column)?;
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
