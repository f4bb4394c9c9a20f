//! CSV tables with a header: rows of numbers, and errors that point at the cell.

use crate::Error;
use crate::recording::Warning;
use csv::{ByteRecord, ErrorKind, Reader, ReaderBuilder};
use std::cell::Cell;
use std::collections::HashSet;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use trackdyn_core::input;
use trackdyn_core::lines::shortened;

mod ends;
mod number;
mod opening;

use ends::Ends;
pub(crate) use number::number;
use number::{any_number, shows_decimal_comma, with_commas};
use opening::Text;

/// Most rows of a table, and messages of a bag, that are kept: a day at 100 Hz. A reading takes 24
/// to 48 bytes, and there are two copies of all of them for a moment.
pub(crate) const MAX_ROWS: u64 = 10_000_000;

/// Longest row, bytes: ten thousand columns take a tenth of it.
pub(crate) const MAX_ROW_SIZE: u64 = 1 << 20;

/// Most characters of a header or a cell in an error.
const MAX_SHOWN_CHARACTERS: usize = 1000;

/// A table that is being read, one row at a time.
pub struct Table {
    path: PathBuf,
    reader: Reader<Bounded>,
    /// Bytes read since the row began.
    since_row: Arc<AtomicU64>,
    rows: u64,
    header: Vec<String>,
    /// Whether the header ends in an empty cell, which is no column.
    has_spare: bool,
    row: ByteRecord,
    /// How a log ends; none of other tables.
    ends: Option<Ends>,
    /// Whether numbers are written with a decimal comma: beside semicolons, and where a cell before
    /// has shown it.
    has_commas: Cell<bool>,
    above: Above,
}

/// What stands above the header.
#[derive(Clone, Copy)]
struct Above {
    lines: u64,
    /// None where the file is read in another encoding.
    bytes: Option<u64>,
}

impl Table {
    /// Opens a file and reads its header. Lines above the header are left out where it is found
    /// below them. Cells may stand between commas, tabs, or semicolons. Beside semicolons, numbers
    /// may have a decimal comma. A separator may stand at the end of header and rows.
    ///
    /// # Errors
    /// [`Error::Unreadable`]; [`Error::Header`] when a name stands there twice or `required` lacks;
    /// [`Error::Empty`] for files that are no text.
    pub fn open(path: &Path, required: &[&str]) -> Result<Self, Error> {
        Self::open_with(path, required, false)
    }

    /// Opens a file of another program, which may have any columns beside those that are required.
    ///
    /// # Errors
    /// Those of [`Table::open`].
    pub fn open_any(path: &Path, required: &[&str]) -> Result<Self, Error> {
        Self::open_with(path, required, true)
    }

    fn open_with(path: &Path, required: &[&str], is_any: bool) -> Result<Self, Error> {
        let Text { reader, delimiter, lines, bytes } = opening::open(path, required)?;
        let above = Above { lines, bytes };
        let since_row = Arc::new(AtomicU64::new(0));
        let reader = Bounded { content: reader, since_row: since_row.clone() };
        let mut builder = ReaderBuilder::new();
        builder.buffer_capacity(1 << 18).delimiter(delimiter).flexible(true);
        let mut reader = builder.from_reader(reader);
        let header = reader.byte_headers().map_err(|error| csv_error(path, above, 1, error))?;
        let line = header.position().map_or(1, csv::Position::line) + lines;
        let mut header: Vec<String> =
            header.iter().map(|name| opening::text(name.trim_ascii())).collect();
        let has_spare = header.len() > 1 && header.last().is_some_and(String::is_empty);
        header.truncate(header.len() - usize::from(has_spare));
        let counts = |name: &String| !is_any || required.contains(&name.as_str());
        let mut names = HashSet::new();
        let twice = header.iter().filter(|name| counts(name)).any(|name| !names.insert(name));
        let lacks = required.iter().any(|name| !header.iter().any(|column| column == name));
        if twice || lacks {
            let expected = format!("{}, each name once", required.join(","));
            let mut found = shortened(&header.join(","), MAX_SHOWN_CHARACTERS);
            if found.is_empty() {
                "(none)".clone_into(&mut found);
            } else if header.iter().all(|name| any_number(name.as_bytes()).is_some()) {
                found += " (numbers: a line with the names of the columns is missing above)";
            }
            return Err(Error::Header { path: path.to_owned(), line, found, expected });
        }
        let (path, row, has_commas) =
            (path.to_owned(), ByteRecord::new(), Cell::new(delimiter == b';'));
        let (rows, ends) = (0, None);
        Ok(Self { path, reader, since_row, rows, header, has_spare, row, ends, has_commas, above })
    }

    /// This table as one that a program wrote until it was switched off: its end may be cut off or
    /// have text, and its header may stand there again. These are left out. Cells of the columns
    /// given have numbers or times.
    pub(crate) fn of_log(mut self, columns: &[&str]) -> Self {
        let places = columns.iter().filter_map(|name| self.column(name)).collect();
        self.ends = Some(Ends::new(places, &self.header));
        self
    }

    /// What was left out of a log.
    pub(crate) fn left_out(&self) -> Vec<Warning> {
        self.ends.as_ref().map_or_else(Vec::new, |ends| ends.warnings(&self.path))
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
        let Some(mut ends) = self.ends.take() else {
            return Ok(self.read()? && self.has_cells()?);
        };
        let found = self.advance_log(&mut ends);
        self.ends = Some(ends);
        found
    }

    /// Goes to the next row of a log.
    fn advance_log(&mut self, ends: &mut Ends) -> Result<bool, Error> {
        loop {
            if let Some(row) = ends.next_ahead() {
                self.row = row;
                return self.has_cells();
            }
            if !self.read()? {
                return Ok(false);
            }
            if ends.is_header(&self.row) {
                ends.note_header(self.line());
            } else if !ends.is_odd(&self.row) {
                ends.note_row(&self.row);
                return self.has_cells();
            } else {
                self.look_ahead(ends)?;
            }
        }
    }

    /// Reads on from a row without data to the next row with data, or to the end of the table.
    fn look_ahead(&mut self, ends: &mut Ends) -> Result<(), Error> {
        let line = self.line();
        let mut rows = vec![std::mem::take(&mut self.row)];
        while rows.len() <= ends::MAX_ROWS && rows.last().is_some_and(|row| ends.is_odd(row)) {
            if !self.read()? {
                ends.note_end(line, rows);
                return Ok(());
            }
            rows.push(std::mem::take(&mut self.row));
        }
        ends.keep_ahead(rows);
        Ok(())
    }

    /// Reads the next row as it stands in the file; false at the end.
    fn read(&mut self) -> Result<bool, Error> {
        self.since_row.store(0, Ordering::Relaxed);
        self.rows += 1;
        if self.rows > MAX_ROWS {
            return Err(out_of_bounds(&self.path, self.above.lines + self.rows));
        }
        let begin = self.reader.position().line();
        let read = self.reader.read_byte_record(&mut self.row);
        read.map_err(|error| csv_error(&self.path, self.above, begin, error))
    }

    /// True where the current row has a cell for each column, and at most an empty one more.
    fn has_cells(&self) -> Result<bool, Error> {
        let (found, expected) = (self.row.len(), self.header.len());
        let is_spare = self.has_spare || self.cell(expected).is_empty();
        if found == expected || (found == expected + 1 && is_spare) {
            return Ok(true);
        }
        let (found, expected) = (found as u64, expected as u64);
        Err(Error::Row { path: self.path.clone(), line: self.line(), found, expected })
    }

    /// The line of the current row.
    fn line(&self) -> u64 {
        self.row.position().map_or(0, |position| line(&self.path, self.above, position))
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
        self.value(column).ok_or_else(|| self.cell_error(column, "a number"))
    }

    /// The cell as a number where it is one; NaN where it is empty.
    pub(crate) fn value(&self, column: usize) -> Option<f64> {
        let cell = self.cell(column);
        if !cell.contains(&b',') {
            return number(cell);
        }
        if shows_decimal_comma(cell) {
            self.has_commas.set(true);
        }
        with_commas(cell, self.has_commas.get())
    }

    /// The cell as a finite number.
    ///
    /// # Errors
    /// [`Error::Cell`].
    pub fn finite(&self, column: usize) -> Result<f64, Error> {
        self.value(column)
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
            line: self.line(),
            column: column + 1,
            name: shortened(&self.header[column], MAX_SHOWN_CHARACTERS),
            value: shortened(&String::from_utf8_lossy(self.cell(column)), MAX_SHOWN_CHARACTERS),
            expected,
        }
    }
}

/// A text whose rows end: more bytes than a row may have, read since a row began, are an error.
struct Bounded {
    content: Box<dyn Read + Send>,
    since_row: Arc<AtomicU64>,
}

impl Read for Bounded {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let count = self.content.read(buffer)?;
        // What is read ahead of the row that follows counts for none.
        if self.since_row.fetch_add(count as u64, Ordering::Relaxed) > MAX_ROW_SIZE {
            return Err(input::too_large(MAX_ROW_SIZE));
        }
        Ok(count)
    }
}

/// The error of a table whose rows are too long or too many.
pub(crate) fn out_of_bounds(path: &Path, line: u64) -> Error {
    let message = if line > MAX_ROWS {
        too_many("rows")
    } else {
        format!("line {line} has more than {} KiB: expected a row of numbers", MAX_ROW_SIZE >> 10)
    };
    Error::Empty { path: path.to_owned(), message }
}

/// What is said of more readings than memory holds.
pub(crate) fn too_many(what: &str) -> String {
    format!(
        "more than {MAX_ROWS} {what}, which would take more than 1 GB of memory: expected a part \
         of it, or readings at a lower rate"
    )
}

/// The error of a file that the system does not let us read.
pub(crate) fn unreadable(path: &Path, cause: std::io::Error) -> Error {
    Error::Unreadable { path: path.to_owned(), cause }
}

/// The line of a row. Of lines that end in CR LF a row seems to begin at the LF before it.
fn line(path: &Path, above: Above, position: &csv::Position) -> u64 {
    let first = |bytes: u64| -> std::io::Result<u8> {
        let mut file = input::open(path)?;
        file.seek(SeekFrom::Start(bytes + position.byte()))?;
        let mut byte = [0];
        file.read_exact(&mut byte)?;
        Ok(byte[0])
    };
    let is_before = above.bytes.is_some_and(|bytes| first(bytes).is_ok_and(|byte| byte == b'\n'));
    above.lines + position.line() + u64::from(is_before)
}

/// The error of a row that begins at a line below what stands above the header.
fn csv_error(path: &Path, above: Above, begin: u64, error: csv::Error) -> Error {
    let path = path.to_owned();
    match error.into_kind() {
        ErrorKind::Io(cause) if cause.kind() == std::io::ErrorKind::FileTooLarge => {
            let message = format!(
                "line {}: a row of more than {} KiB: expected cells between commas and an end of \
                 the line",
                above.lines + begin,
                MAX_ROW_SIZE >> 10
            );
            Error::Empty { path, message }
        }
        ErrorKind::Io(cause) => Error::Unreadable { path, cause },
        other => Error::Empty { path, message: format!("not a table: {other:?}") },
    }
}
