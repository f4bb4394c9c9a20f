//! Where the header of a table is, and how its text is written.

use super::unreadable;
use crate::Error;
use std::io::{Cursor, Read, Seek, SeekFrom};
use std::path::Path;
use trackdyn_core::input;

/// Longest beginning of a file that is looked at, bytes.
const MAX_START: u64 = 1 << 16;

/// Largest text in UTF-16, bytes, which is converted as a whole.
const MAX_UTF16_SIZE: u64 = 1 << 26;

/// Most lines above a header.
const MAX_PREAMBLE: usize = 100;

/// The text of a table from its header on.
pub(super) struct Text {
    pub(super) reader: Box<dyn Read + Send>,
    /// What stands between cells.
    pub(super) delimiter: u8,
    /// Lines above the header.
    pub(super) lines: u64,
    /// Bytes above the header; none where the file is written in another encoding.
    pub(super) bytes: Option<u64>,
}

/// Opens a table with these columns. Lines above the header are left out where it is found below
/// them. Cells stand between commas, tabs or semicolons: the header has one of them more often than
/// the others.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::Empty`] for files that are no text.
pub(super) fn open(path: &Path, required: &[&str]) -> Result<Text, Error> {
    let failed = |cause| unreadable(path, cause);
    let mut file = input::open(path).map_err(failed)?;
    let mut start = Vec::new();
    file.by_ref().take(MAX_START).read_to_end(&mut start).map_err(failed)?;
    if let Some(kind) = binary(&start) {
        let message = format!("{kind}: expected a table as text, such as CSV in UTF-8");
        return Err(Error::Empty { path: path.to_owned(), message });
    }
    if let [first @ (0xff | 0xfe), second @ (0xff | 0xfe), ..] = start[..]
        && first != second
    {
        let mut bytes = start.split_off(2);
        file.take(MAX_UTF16_SIZE).read_to_end(&mut bytes).map_err(failed)?;
        if bytes.len() as u64 >= MAX_UTF16_SIZE {
            return Err(failed(input::too_large(MAX_UTF16_SIZE)));
        }
        let pair = |pair: &[u8]| match first {
            0xff => u16::from_le_bytes([pair[0], pair[1]]),
            _ => u16::from_be_bytes([pair[0], pair[1]]),
        };
        let units: Vec<u16> = bytes.chunks_exact(2).map(pair).collect();
        let text = String::from_utf16_lossy(&units).into_bytes();
        let Header { line, byte, delimiter } = header(&text, required);
        let rest = text[byte..].to_vec();
        let reader = Box::new(Cursor::new(rest));
        return Ok(Text { reader, delimiter, lines: line, bytes: None });
    }
    let Header { line, byte, delimiter } = header(&start, required);
    let bytes = byte as u64;
    file.seek(SeekFrom::Start(bytes)).map_err(failed)?;
    Ok(Text { reader: Box::new(file), delimiter, lines: line, bytes: Some(bytes) })
}

/// Where the header is.
struct Header {
    line: u64,
    byte: usize,
    delimiter: u8,
}

/// The first line with all the names, else the first line.
fn header(start: &[u8], required: &[&str]) -> Header {
    let mut byte = 0;
    let lines = start.split(|byte| *byte == b'\n').take(MAX_PREAMBLE);
    for (number, line) in (0..).zip(lines) {
        let delimiter = delimiter(line);
        let is_it = {
            let line = line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(line);
            let cells: Vec<String> = line.split(|byte| *byte == delimiter).map(name).collect();
            required.iter().all(|name| cells.iter().any(|cell| cell == name))
        };
        if is_it {
            return Header { line: number, byte, delimiter };
        }
        byte += line.len() + 1;
    }
    let first = start.split(|byte| *byte == b'\n').next().unwrap_or_default();
    Header { line: 0, byte: 0, delimiter: delimiter(first) }
}

fn delimiter(line: &[u8]) -> u8 {
    let count = |delimiter: u8| line.split(|byte| *byte == delimiter).count();
    [b';', b'\t', b','].into_iter().max_by_key(|&delimiter| count(delimiter)).unwrap_or(b',')
}

/// The name of a column without blanks and quotation marks around it.
fn name(cell: &[u8]) -> String {
    let cell = cell.trim_ascii();
    let bare = cell.strip_prefix(b"\"").and_then(|cell| cell.strip_suffix(b"\""));
    text(bare.unwrap_or(cell).trim_ascii())
}

/// Text in UTF-8, else in Latin-1.
pub(super) fn text(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().copied().map(char::from).collect(),
    }
}

/// What a file that is no text is.
fn binary(start: &[u8]) -> Option<&'static str> {
    match start {
        [b'P', b'K', 3, 4, ..] => Some("a spreadsheet or another packed file"),
        [b'P', b'A', b'R', b'1', ..] => Some("a table of Parquet"),
        [0xd0, 0xcf, 0x11, 0xe0, ..] => Some("a spreadsheet"),
        [0x1f, 0x8b, ..] => Some("a file packed by gzip"),
        _ => None,
    }
}
