//! Tables of a recording as Parquet: the same columns as in CSV.
//!
//! Columns are flat: numbers of any width, booleans as 0 and 1, texts. A null is an empty cell. In
//! errors a row stands for the line.

use super::rows::Rows;
use crate::Error;
use crate::sample::{Cells, Column, Sample, Series};
use crate::table::unreadable;
use parquet::basic::LogicalType;
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::{ByteArray, DataType};
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};
use std::collections::BTreeMap;
use std::path::Path;
use trackdyn_core::input;

/// Reads a file with the columns of `S`, maybe `run`, and any others.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::Header`], [`Error::Cell`], [`Error::Empty`].
pub(super) fn read_rows<S: Sample>(path: &Path) -> Result<Rows<S>, Error> {
    let refused = |error: ParquetError| Error::Empty {
        path: path.to_owned(),
        message: format!("not a readable Parquet file: {error}"),
    };
    let file = input::open(path).map_err(|cause| unreadable(path, cause))?;
    let reader = SerializedFileReader::new(file).map_err(refused)?;
    if reader.num_row_groups() == 0 {
        return Err(Error::Empty { path: path.to_owned(), message: "no rows".to_owned() });
    }
    let mut columns: Vec<Column> = Vec::new();
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group).map_err(refused)?;
        for index in 0..group.num_columns() {
            let column = read_column(group.as_ref(), index).map_err(refused)?;
            match columns.get_mut(index) {
                Some(before) => append(&mut before.cells, column.cells),
                None => columns.push(column),
            }
        }
    }
    split(path, &columns)
}

/// The rows of all columns, by the column `run`.
fn split<S: Sample>(path: &Path, columns: &[Column]) -> Result<Rows<S>, Error> {
    let place = |name: &str| columns.iter().position(|column| column.name == name);
    let known: Option<Vec<usize>> = S::COLUMNS.iter().map(|name| place(name)).collect();
    let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
    let Some(known) = known else {
        return Err(Error::Header {
            path: path.to_owned(),
            line: 1,
            found: names.join(","),
            expected: S::COLUMNS.join(","),
        });
    };
    let values: Vec<&[f64]> =
        known.iter().map(|&at| numbers(path, columns, at)).collect::<Result<_, _>>()?;
    let run_column = place("run");
    let ids = run_column.map(|at| numbers(path, columns, at)).transpose()?;
    let mut rows_of: BTreeMap<i64, Vec<usize>> = BTreeMap::new();
    for row in 0..values[0].len() {
        let id = ids.map_or(Ok(0), |ids| {
            let cell = || (row, run_column.unwrap_or_default(), ids[row].to_string());
            integer(ids[row]).ok_or_else(|| cell_error(path, "run", cell(), "an integer"))
        })?;
        rows_of.entry(id).or_default().push(row);
    }
    if rows_of.is_empty() {
        return Err(Error::Empty { path: path.to_owned(), message: "no rows".to_owned() });
    }
    let mut cells = vec![0.0; known.len()];
    let samples = (0..values[0].len())
        .map(|row| {
            for (cell, column) in cells.iter_mut().zip(&values) {
                *cell = column[row];
            }
            S::from_columns(&cells)
        })
        .collect();
    let others = columns.iter().enumerate();
    let others = others.filter(|(at, _)| !known.contains(at) && Some(*at) != run_column);
    let all = Series { samples, extra: others.map(|(_, column)| column.clone()).collect() };
    let runs = rows_of.into_iter().map(|(id, rows)| (id, all.part(&rows))).collect();
    Ok(Rows { has_runs: run_column.is_some(), runs, warnings: Vec::new() })
}

fn numbers<'a>(path: &Path, columns: &'a [Column], at: usize) -> Result<&'a [f64], Error> {
    match &columns[at].cells {
        Cells::Numbers(cells) => Ok(cells),
        Cells::Texts(cells) => {
            let value = cells.first().cloned().unwrap_or_default();
            Err(cell_error(path, &columns[at].name, (0, at, value), "a number"))
        }
    }
}

fn cell_error(
    path: &Path,
    name: &str,
    (row, column, value): (usize, usize, String),
    expected: &'static str,
) -> Error {
    Error::Cell {
        path: path.to_owned(),
        line: row as u64 + 1,
        column: column + 1,
        name: name.to_owned(),
        value,
        expected,
    }
}

#[expect(clippy::cast_possible_truncation, reason = "whole and below 2⁵³, as is checked")]
fn integer(value: f64) -> Option<i64> {
    (value.fract() == 0.0 && value.abs() < 9e15).then_some(value as i64)
}

fn append(cells: &mut Cells, more: Cells) {
    match (cells, more) {
        (Cells::Numbers(cells), Cells::Numbers(more)) => cells.extend(more),
        (Cells::Texts(cells), Cells::Texts(more)) => cells.extend(more),
        // A file has one schema for all of its row groups.
        _ => {}
    }
}

fn read_column(group: &dyn RowGroupReader, index: usize) -> Result<Column, ParquetError> {
    let metadata = group.metadata();
    let description = metadata.column(index).column_descr_ptr();
    let name = description.path().string();
    let is_time = matches!(
        description.logical_type_ref(),
        Some(LogicalType::Timestamp { .. } | LogicalType::Time { .. } | LogicalType::Date)
    );
    if description.max_rep_level() > 0 || is_time {
        let message = format!("column {name}: expected one number or text per row");
        return Err(ParquetError::General(message));
    }
    let rows = usize::try_from(metadata.num_rows()).unwrap_or_default();
    let present = description.max_def_level();
    let number = |cells: Vec<Option<f64>>| {
        Cells::Numbers(cells.into_iter().map(|cell| cell.unwrap_or(f64::NAN)).collect())
    };
    let cells = match group.get_column_reader(index)? {
        ColumnReader::BoolColumnReader(reader) => {
            number(cells(reader, rows, present, |value| f64::from(u8::from(*value)))?)
        }
        ColumnReader::Int32ColumnReader(reader) => {
            number(cells(reader, rows, present, |value| f64::from(*value))?)
        }
        ColumnReader::Int64ColumnReader(reader) => {
            #[expect(clippy::cast_precision_loss, reason = "a cell is a real number here")]
            let real = |value: &i64| *value as f64;
            number(cells(reader, rows, present, real)?)
        }
        ColumnReader::FloatColumnReader(reader) => {
            number(cells(reader, rows, present, |value| f64::from(*value))?)
        }
        ColumnReader::DoubleColumnReader(reader) => {
            number(cells(reader, rows, present, |value| *value)?)
        }
        ColumnReader::ByteArrayColumnReader(reader) => {
            let text = |value: &ByteArray| String::from_utf8_lossy(value.data()).into_owned();
            let texts = cells(reader, rows, present, text)?;
            Cells::Texts(texts.into_iter().map(Option::unwrap_or_default).collect())
        }
        _ => {
            let message = format!("column {name}: expected numbers or texts");
            return Err(ParquetError::General(message));
        }
    };
    Ok(Column { name, cells })
}

/// The cells of one column of a row group; `present` is the level of a cell that is not null.
fn cells<D: DataType, T>(
    mut reader: ColumnReaderImpl<D>,
    rows: usize,
    present: i16,
    convert: impl Fn(&D::T) -> T,
) -> Result<Vec<Option<T>>, ParquetError> {
    let mut values = Vec::with_capacity(rows);
    let mut levels = Vec::new();
    let (records, ..) = reader.read_records(rows, Some(&mut levels), None, &mut values)?;
    if records != rows {
        return Err(ParquetError::EOF(format!("{records} of {rows} rows")));
    }
    if present == 0 {
        return Ok(values.iter().map(|value| Some(convert(value))).collect());
    }
    let mut values = values.iter();
    let cell = |level| if level == present { values.next().map(&convert) } else { None };
    Ok(levels.into_iter().map(cell).collect())
}
