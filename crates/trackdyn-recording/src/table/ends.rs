//! What a log has besides its rows, because a program wrote it until it was switched off.
//!
//! The last row is cut off, or is followed by text or by zeros that the disk never filled. A
//! program that is started again writes the header again. Odd rows are left out only at the end,
//! where nothing but such rows follows. In the middle they are damage.

use super::number::any_number;
use crate::recording::Warning;
use csv::ByteRecord;
use std::collections::VecDeque;
use std::path::Path;

/// Most rows of an end.
pub(super) const MAX_ROWS: usize = 20;

/// Least number of rows of data for each row of an end. In a shorter table, odd rows are a mistake
/// and no end.
const MIN_DATA: u64 = 10;

/// The ends of a log.
pub(super) struct Ends {
    /// Places of columns with numbers.
    places: Vec<usize>,
    header: Vec<String>,
    /// Rows with a number.
    rows: u64,
    /// Rows that were read to see whether the table ends.
    ahead: VecDeque<ByteRecord>,
    /// Headers below the first one, and the line of the first of them.
    headers: Option<(usize, u64)>,
    end: Option<End>,
}

/// An end that is left out.
struct End {
    line: u64,
    rows: usize,
    bytes: usize,
}

impl Ends {
    pub(super) fn new(places: Vec<usize>, header: &[String]) -> Self {
        let (header, ahead) = (header.to_vec(), VecDeque::new());
        Self { places, header, rows: 0, ahead, headers: None, end: None }
    }

    /// Whether a row is the header again.
    pub(super) fn is_header(&self, row: &ByteRecord) -> bool {
        let names = self.header.iter().map(String::as_bytes);
        row.len() >= self.header.len()
            && names.zip(row).all(|(name, cell)| name == cell.trim_ascii())
    }

    /// Whether a cell has a number, or begins as a date does.
    fn has_number(&self, row: &ByteRecord) -> bool {
        let cells = self.places.iter().filter_map(|place| row.get(*place)).map(<[u8]>::trim_ascii);
        let is_number = |cell: &[u8]| cell[0].is_ascii_digit() || any_number(cell).is_some();
        cells.filter(|cell| !cell.is_empty()).any(is_number)
    }

    /// Whether a row below others has too few cells, zeros that are no text, or no number.
    pub(super) fn is_odd(&self, row: &ByteRecord) -> bool {
        let is_odd = row.len() < self.header.len()
            || row.as_slice().contains(&0)
            || !(self.has_number(row) || row.as_slice().trim_ascii().is_empty());
        self.rows > 0 && is_odd
    }

    pub(super) fn note_row(&mut self, row: &ByteRecord) {
        self.rows += u64::from(self.rows > 0 || self.has_number(row));
    }

    pub(super) fn note_header(&mut self, line: u64) {
        let (count, first) = self.headers.unwrap_or((0, line));
        self.headers = Some((count + 1, first));
    }

    /// Notes odd rows that nothing follows; of a short table they are kept.
    pub(super) fn note_end(&mut self, line: u64, rows: Vec<ByteRecord>) {
        if MIN_DATA * rows.len() as u64 > self.rows {
            self.keep_ahead(rows);
            return;
        }
        let bytes = rows.iter().map(|row| row.as_slice().len()).sum();
        self.end = Some(End { line, rows: rows.len(), bytes });
    }

    /// Keeps rows that were read ahead.
    pub(super) fn keep_ahead(&mut self, rows: Vec<ByteRecord>) {
        self.ahead = rows.into();
    }

    pub(super) fn next_ahead(&mut self) -> Option<ByteRecord> {
        self.ahead.pop_front()
    }

    pub(super) fn warnings(&self, path: &Path) -> Vec<Warning> {
        let path = || path.to_owned();
        let headers =
            self.headers.map(|(count, line)| Warning::HeadersLeftOut { path: path(), count, line });
        let end = self.end.as_ref().map(|&End { line, rows, bytes }| Warning::EndLeftOut {
            path: path(),
            line,
            rows,
            bytes,
        });
        headers.into_iter().chain(end).collect()
    }
}

#[cfg(test)]
mod tests {
    use crate::Error;
    use crate::table::Table;
    use std::fmt::Write;

    const COLUMNS: [&str; 3] = ["t", "v", "w"];

    /// Rows that are read of a log of 40 rows with this end, and what is said.
    fn read(header: &str, separator: &str, end: &str) -> Result<(usize, String), Error> {
        let mut text = format!("{header}\n");
        for k in 0..40 {
            let _ = writeln!(text, "{k}.5,0.25,-{k}{separator}");
        }
        text.push_str(end);
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("log.csv");
        std::fs::write(&path, text).expect("written");
        let mut table = Table::open(&path, &COLUMNS)?.of_log(&COLUMNS);
        let mut rows = 0;
        while table.advance()? {
            for place in 0..3 {
                table.finite(place)?;
            }
            rows += 1;
        }
        let told = table.left_out().iter().map(ToString::to_string).collect();
        Ok((rows, told))
    }

    #[test]
    fn an_end_that_is_cut_off_or_text_is_left_out() {
        for (end, part) in [
            ("41,0.2", ":42: the table ends in 1 row (5 bytes)"),
            ("41,0.2,\0\0", ":42: the table ends in 1 row (7 bytes)"),
            ("\0\0\0\0", ":42: the table ends in 1 row (4 bytes)"),
            ("# end of log\nEOF\n", ":42: the table ends in 2 rows (15 bytes)"),
            ("stopped,by,user\n\n", ":42: the table ends in 1 row"),
        ] {
            let (rows, told) = read("t,v,w", "", end).expect(end);
            assert!(rows == 40 && told.contains(part), "{end:?}: {rows}, {told}");
        }
        assert_eq!(read("t,v,w", "", "").expect("plain"), (40, String::new()));
    }

    #[test]
    fn what_is_odd_in_the_middle_or_in_part_is_an_error() {
        for (end, part) in [
            ("41,0.2\n42,0,0\n", ":42: 2 cells: expected 3"),
            ("stopped,by,user\n42,0,0\n", ":42:1: t = \"stopped\": expected a finite number"),
            ("41,fast,0\n", ":42:2: v = \"fast\": expected a finite number"),
            ("a\nb\nc\nd\ne\n", ":42: 1 cells: expected 3"),
        ] {
            let text = read("t,v,w", "", end).expect_err(end).to_string();
            assert!(text.contains(part), "{end:?}: {text}");
        }
    }

    #[test]
    fn a_header_that_stands_there_again_is_skipped() {
        let again = "t,v,w\n41,0,0\nt, v, w\n42,0,0\n";
        let (rows, told) = read("t,v,w", "", again).expect("a log");
        assert!(rows == 42 && told.contains(":42: the header stands there again"), "{told}");
        assert!(told.contains("(2 times)"), "{told}");
    }

    /// Of a row whose time is a date, nothing but the time may be known.
    #[test]
    fn a_row_with_a_date_is_no_end() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("log.csv");
        let rows = "2024-03-31T00:59:30,1,2,a\n".repeat(40);
        std::fs::write(&path, format!("t,v,w,n\n{rows}2024-03-31T00:59:31,,,b\n"))
            .expect("written");
        let mut table = Table::open_any(&path, &COLUMNS).expect("a table").of_log(&COLUMNS);
        let count = std::iter::from_fn(|| table.advance().expect("rows").then_some(())).count();
        assert!(count == 41 && table.left_out().is_empty());
    }

    #[test]
    fn a_table_without_names_is_told_so() {
        let text = read("1,2,3", "", "").expect_err("no names").to_string();
        assert!(text.contains(":1: columns 1,2,3 (numbers: a line with the names"), "{text}");
    }

    #[test]
    fn a_separator_at_the_end_of_rows_is_no_cell() {
        for (header, separator) in
            [("t,v,w,", ","), ("t,v,w", ","), ("t,v,w,", ""), ("t,v,w,", ",7")]
        {
            assert_eq!(read(header, separator, "").expect(header), (40, String::new()));
        }
        let text = read("t,v,w", ",7", "").expect_err("a cell more").to_string();
        assert!(text.contains(":2: 4 cells: expected 3"), "{text}");
    }
}
