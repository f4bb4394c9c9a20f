//! CSV tables with a header: rows of numbers, and errors that point at the cell.

use crate::Error;
use csv::{ByteRecord, ErrorKind, Reader, ReaderBuilder};
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// Longest first line that is looked at, bytes.
const MAX_HEADER: u64 = 1 << 16;

/// A table that is being read, one row at a time.
pub struct Table {
    path: PathBuf,
    reader: Reader<File>,
    header: Vec<String>,
    row: ByteRecord,
    /// Whether numbers are written with a decimal comma.
    has_commas: bool,
}

impl Table {
    /// Opens a file and reads its header.
    ///
    /// # Errors
    /// [`Error::Unreadable`]; [`Error::Header`] when a name stands there twice or `required` lacks.
    pub fn open(path: &Path, required: &[&str]) -> Result<Self, Error> {
        Self::open_with(path, required, b',', false)
    }

    /// Opens a file whose cells stand between commas, tabs, or semicolons: the first line has one
    /// of them more often than the others. Beside semicolons, numbers may have a decimal comma.
    ///
    /// # Errors
    /// Those of [`Table::open`].
    pub fn open_any(path: &Path, required: &[&str]) -> Result<Self, Error> {
        let mut line = Vec::new();
        let file = File::open(path).map_err(|cause| unreadable(path, cause))?;
        let mut start = BufReader::new(file).take(MAX_HEADER);
        start.read_until(b'\n', &mut line).map_err(|cause| unreadable(path, cause))?;
        let count = |delimiter: u8| line.split(|byte| *byte == delimiter).count();
        let delimiter = [b';', b'\t', b','].into_iter().max_by_key(|&delimiter| count(delimiter));
        Self::open_with(path, required, delimiter.unwrap_or(b','), true)
    }

    fn open_with(
        path: &Path,
        required: &[&str],
        delimiter: u8,
        is_any: bool,
    ) -> Result<Self, Error> {
        let file = File::open(path).map_err(|cause| unreadable(path, cause))?;
        let mut builder = ReaderBuilder::new();
        let mut reader = builder.buffer_capacity(1 << 18).delimiter(delimiter).from_reader(file);
        let header = reader.byte_headers().map_err(|error| csv_error(path, error))?;
        let line = header.position().map_or(1, csv::Position::line);
        let header: Vec<String> =
            header.iter().map(|name| String::from_utf8_lossy(name.trim_ascii()).into()).collect();
        // Tables of other programs may have any columns beside those that are named.
        let counts = |name: &String| !is_any || required.contains(&name.as_str());
        let mut twice = header.iter().enumerate().filter(|(_, name)| counts(name));
        let twice = twice.any(|(at, name)| header[..at].contains(name));
        let lacks = required.iter().any(|name| !header.iter().any(|column| column == name));
        if twice || lacks {
            let expected = format!("{}, each name once", required.join(","));
            let found = header.join(",");
            let found = if found.is_empty() { "(none)".to_owned() } else { found };
            return Err(Error::Header { path: path.to_owned(), line, found, expected });
        }
        let (path, row, has_commas) = (path.to_owned(), ByteRecord::new(), delimiter == b';');
        Ok(Self { path, reader, header, row, has_commas })
    }

    /// Names of the columns.
    pub fn header(&self) -> &[String] {
        &self.header
    }

    /// Place of a column.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.header.iter().position(|column| column == name)
    }

    /// Goes to the next row; false at the end.
    ///
    /// # Errors
    /// [`Error::Row`] where the number of cells is wrong, [`Error::Unreadable`].
    pub fn advance(&mut self) -> Result<bool, Error> {
        self.reader.read_byte_record(&mut self.row).map_err(|error| csv_error(&self.path, error))
    }

    /// The cell of the current row without the blanks around it.
    pub fn cell(&self, column: usize) -> &[u8] {
        self.row.get(column).unwrap_or_default().trim_ascii()
    }

    /// The cell as a number; NaN where it is empty.
    ///
    /// # Errors
    /// [`Error::Cell`].
    pub fn number(&self, column: usize) -> Result<f64, Error> {
        let cell = self.cell(column);
        let value = if self.has_commas && cell.contains(&b',') {
            let point = |byte: &u8| if *byte == b',' { b'.' } else { *byte };
            number(&cell.iter().map(point).collect::<Vec<_>>())
        } else {
            number(cell)
        };
        value.ok_or_else(|| self.cell_error(column, "a number"))
    }

    /// The cell as a finite number.
    ///
    /// # Errors
    /// [`Error::Cell`].
    pub fn finite(&self, column: usize) -> Result<f64, Error> {
        number(self.cell(column))
            .filter(|value| value.is_finite())
            .ok_or_else(|| self.cell_error(column, "a finite number"))
    }

    /// The cell as a whole number.
    ///
    /// # Errors
    /// [`Error::Cell`].
    pub fn integer(&self, column: usize) -> Result<i64, Error> {
        std::str::from_utf8(self.cell(column))
            .ok()
            .and_then(|text| text.parse().ok())
            .ok_or_else(|| self.cell_error(column, "an integer"))
    }

    /// The error of a cell of the current row that is not accepted.
    pub fn cell_error(&self, column: usize, expected: &'static str) -> Error {
        Error::Cell {
            path: self.path.clone(),
            line: self.row.position().map_or(0, |position| line(&self.path, position)),
            column: column + 1,
            name: self.header[column].clone(),
            value: String::from_utf8_lossy(self.cell(column)).into(),
            expected,
        }
    }
}

/// A number as spreadsheets, numpy and C write it; NaN for nothing.
pub(crate) fn number(text: &[u8]) -> Option<f64> {
    if text.is_empty() {
        return Some(f64::NAN);
    }
    fast_float2::parse(text).ok()
}

/// The error of a file that the system does not let us read.
pub(crate) fn unreadable(path: &Path, cause: std::io::Error) -> Error {
    Error::Unreadable { path: path.to_owned(), cause }
}

/// The line of a row. Of lines that end in CR LF a row seems to begin at the LF before it.
fn line(path: &Path, position: &csv::Position) -> u64 {
    let first = || -> std::io::Result<u8> {
        let mut file = File::open(path)?;
        file.seek(SeekFrom::Start(position.byte()))?;
        let mut byte = [0];
        file.read_exact(&mut byte)?;
        Ok(byte[0])
    };
    position.line() + u64::from(first().is_ok_and(|byte| byte == b'\n'))
}

fn csv_error(path: &Path, error: csv::Error) -> Error {
    let path = path.to_owned();
    match error.into_kind() {
        ErrorKind::Io(cause) => Error::Unreadable { path, cause },
        ErrorKind::UnequalLengths { pos, expected_len, len } => Error::Row {
            line: pos.map_or(0, |position| line(&path, &position)),
            path,
            found: len,
            expected: expected_len,
        },
        other => Error::Empty { path, message: format!("not a table: {other:?}") },
    }
}
