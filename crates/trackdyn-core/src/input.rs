//! Files that the tool reads: regular ones, and no more of them than memory holds.

use std::fs::{File, Metadata};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// Largest text that is read as a whole, bytes. A vehicle file takes 1 kB, the largest diagnosis
/// and replay some 100 kB, and a TOML text takes some thirty times its size in memory.
pub const MAX_TEXT_SIZE: u64 = 2 << 20;

/// Opens a regular file. A pipe that nobody writes to would be waited for, and a device such as
/// `/dev/zero` would be read without end.
///
/// # Errors
/// What the system says, or what the path is instead.
pub fn open(path: &Path) -> io::Result<File> {
    // before it is opened: to open a pipe waits for who writes to it
    require_regular(&std::fs::metadata(path)?)?;
    File::open(path)
}

/// The text of a regular file of at most [`MAX_TEXT_SIZE`].
///
/// # Errors
/// Those of [`bytes`]; text that is not UTF-8.
pub fn text(path: &Path) -> io::Result<String> {
    let bytes = bytes(path, MAX_TEXT_SIZE)?;
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..at].split(|byte| *byte == b'\n').count();
        io::Error::new(ErrorKind::InvalidData, format!("line {line}: expected text in UTF-8"))
    })
}

/// The bytes of a regular file of at most so many of them.
///
/// # Errors
/// Those of [`open`]; what was expected of a larger file.
pub fn bytes(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open(path)?.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(too_large(most));
    }
    Ok(bytes)
}

/// The error of what is larger than it may be.
pub fn too_large(most: u64) -> io::Error {
    let expected = if most >= 1 << 20 {
        format!("at most {} MiB", most >> 20)
    } else {
        format!("at most {} KiB", most >> 10)
    };
    io::Error::new(ErrorKind::FileTooLarge, format!("it is larger than expected: {expected}"))
}

fn require_regular(file: &Metadata) -> io::Result<()> {
    if file.is_file() {
        return Ok(());
    }
    let found = if file.is_dir() { "a folder" } else { "a pipe, socket or device" };
    Err(io::Error::new(ErrorKind::InvalidInput, format!("it is {found}: expected a file")))
}

/// The name of a file or folder for outputs: that of a file without its ending; that of a folder
/// whole, for what follows a dot is no ending there.
///
/// ```
/// use std::path::Path;
/// use trackdyn_core::input::name_of;
/// assert_eq!(name_of(Path::new("logs/yard.csv")), "yard");
/// ```
pub fn name_of(path: &Path) -> String {
    let name = if path.is_dir() { path.file_name() } else { path.file_stem() };
    name.unwrap_or_default().to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dot_in_the_name_of_a_folder_begins_no_ending() {
        let place = tempfile::tempdir().expect("a temporary folder");
        let folder = place.path().join("offset_1.5");
        std::fs::create_dir(&folder).expect("created");
        assert_eq!(name_of(&folder), "offset_1.5");
        assert_eq!(name_of(&folder.join("drive_1.5.mcap")), "drive_1.5");
    }

    #[test]
    fn only_files_are_opened_and_only_small_ones_are_texts() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.toml");
        std::fs::write(&path, "a = 1\n").expect("written");
        assert_eq!(text(&path).expect("a text"), "a = 1\n");
        assert_eq!(bytes(&path, 6).expect("as large as it may be").len(), 6);
        let refused = |path: &Path| text(path).expect_err("refused").to_string();
        assert!(bytes(&path, 5).is_err());
        std::fs::write(&path, b"a = 1\nb = \"\xff\"\n").expect("written");
        assert_eq!(refused(&path), "line 2: expected text in UTF-8");
        let large = File::create(&path).expect("created");
        large.set_len(MAX_TEXT_SIZE + 1).expect("a large file");
        assert!(refused(&path).contains("at most 2 MiB"), "{}", refused(&path));
        assert!(refused(folder.path()).contains("a folder: expected a file"));
        #[cfg(unix)]
        assert!(refused(Path::new("/dev/zero")).contains("a pipe, socket or device"));
    }
}
