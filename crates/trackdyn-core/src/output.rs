//! Files that the tool writes: whole or not at all, and traceable to their source.

use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{PoisonError, RwLock, RwLockWriteGuard};

/// Read-locked by each writer of a file, and write-locked by who is about to end the program.
static WRITE_LOCK: RwLock<()> = RwLock::new(());

/// What names of temporary files begin with.
pub const TEMPORARY: &str = ".trackdyn-";

/// A file that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot be written: {cause}", path.display())]
pub struct OutputError {
    /// The file or folder.
    pub path: PathBuf,
    /// What the system says.
    pub cause: io::Error,
}

/// Writes a file by way of a temporary one beside it: a reader sees the old file or the new one,
/// never half of it.
///
/// # Errors
/// [`OutputError`]; the old file is then untouched.
pub fn write_file(path: &Path, contents: &[u8]) -> Result<(), OutputError> {
    write(path, contents, tempfile::Builder::new().permissions(permissions()))
}

/// Writes a file as [`write_file`] does, but one that nobody but its owner can read.
///
/// # Errors
/// As [`write_file`].
pub fn write_private(path: &Path, contents: &[u8]) -> Result<(), OutputError> {
    write(path, contents, &mut tempfile::Builder::new())
}

/// Writes a file as [`write_file`] does, piece by piece, for one that memory shall not hold.
///
/// # Errors
/// As [`write_file`], and what `fill` returns; the old file is then untouched.
pub fn write_stream(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
) -> Result<(), OutputError> {
    let fill = |file: &mut File| {
        let mut buffered = BufWriter::new(file);
        fill(&mut buffered)?;
        buffered.flush()
    };
    replace(path, fill, tempfile::Builder::new().permissions(permissions()))
}

fn write(
    path: &Path,
    contents: &[u8],
    builder: &mut tempfile::Builder<'_, '_>,
) -> Result<(), OutputError> {
    replace(path, |file| file.write_all(contents), builder)
}

/// Fills a temporary file beside a path and puts it there.
fn replace(
    path: &Path,
    fill: impl FnOnce(&mut File) -> io::Result<()>,
    builder: &mut tempfile::Builder<'_, '_>,
) -> Result<(), OutputError> {
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let _writing = WRITE_LOCK.read().unwrap_or_else(PoisonError::into_inner);
    let put = || -> io::Result<()> {
        let mut temporary = builder.prefix(TEMPORARY).tempfile_in(folder)?;
        fill(temporary.as_file_mut())?;
        temporary.persist(path).map_err(|failure| failure.error)?;
        Ok(())
    };
    put().map_err(|cause| OutputError { path: path.to_owned(), cause })
}

/// Waits until no file is being written, and lets none be begun while what it gives is kept.
///
/// For an end of the program that runs no destructors, such as a signal: inside [`write_file`] it
/// would leave the temporary file.
pub fn files_at_rest() -> RwLockWriteGuard<'static, ()> {
    WRITE_LOCK.write().unwrap_or_else(PoisonError::into_inner)
}

/// Makes a folder and its parents where they are missing, and makes sure that files can be written
/// into it.
///
/// # Errors
/// [`OutputError`] with the folder.
pub fn prepare_folder(path: &Path) -> Result<(), OutputError> {
    std::fs::create_dir_all(path)
        .and_then(|()| tempfile::tempfile_in(path))
        .map(drop)
        .map_err(|cause| OutputError { path: path.to_owned(), cause })
}

/// The first 16 hexadecimal digits of the SHA-256 of what an output was made from.
pub fn fingerprint(source: &[u8]) -> String {
    let mut head = [0; 8];
    head.copy_from_slice(&Sha256::digest(source)[..8]);
    format!("{:016x}", u64::from_be_bytes(head))
}

/// Ordinary permissions; temporary files are private by default.
#[cfg(unix)]
fn permissions() -> std::fs::Permissions {
    use std::os::unix::fs::PermissionsExt;
    std::fs::Permissions::from_mode(0o644)
}

#[cfg(not(unix))]
fn permissions() -> std::fs::Permissions {
    std::env::temp_dir().metadata().map_or_else(
        |_| unreachable!("the folder for temporary files exists"),
        |folder| folder.permissions(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn writing_replaces_the_whole_file_and_leaves_nothing_else() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.toml");
        write_file(&path, b"a long first text").expect("written");
        write_file(&path, b"short").expect("written");
        assert_eq!(std::fs::read(&path).expect("readable"), b"short");
        assert_eq!(std::fs::read_dir(folder.path()).expect("readable").count(), 1);
    }

    #[test]
    fn a_stream_that_breaks_off_leaves_the_old_file_alone() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.mcap");
        write_stream(&path, |file| file.write_all(b"whole")).expect("written");
        let half = |file: &mut BufWriter<&mut File>| {
            file.write_all(b"half")?;
            Err(io::Error::other("no more"))
        };
        let error = write_stream(&path, half).expect_err("it breaks off").to_string();
        assert!(error.ends_with("a.mcap: cannot be written: no more"), "{error}");
        assert_eq!(std::fs::read(&path).expect("readable"), b"whole");
        assert_eq!(std::fs::read_dir(folder.path()).expect("readable").count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn a_private_file_is_its_owners() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().expect("a temporary folder");
        let mode = |path: &Path| std::fs::metadata(path).expect("there").permissions().mode();
        let [private, other] = ["x.key", "x.toml"].map(|name| folder.path().join(name));
        write_private(&private, b"0123").expect("written");
        write_file(&other, b"0123").expect("written");
        assert_eq!([mode(&private), mode(&other)].map(|mode| mode & 0o777), [0o600, 0o644]);
    }

    #[test]
    fn no_file_is_begun_while_files_rest() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.toml");
        let (written, wait) = std::sync::mpsc::channel();
        let rest = files_at_rest();
        std::thread::scope(|scope| {
            scope.spawn(|| {
                write_file(&path, b"text").expect("written");
                written.send(()).expect("someone waits");
            });
            wait.recv_timeout(Duration::from_millis(50)).expect_err("files rest");
            assert_eq!(std::fs::read_dir(folder.path()).expect("readable").count(), 0);
            drop(rest);
            wait.recv().expect("written at last");
        });
    }

    #[test]
    fn a_missing_folder_is_named() {
        let error = write_file(Path::new("/nonexistent/a.toml"), b"").expect_err("no such folder");
        assert!(error.to_string().starts_with("/nonexistent/a.toml: cannot be written"));
    }

    #[test]
    fn fingerprints_are_those_of_sha_256() {
        // FIPS 180-2, appendix B.1
        assert_eq!(fingerprint(b"abc"), "ba7816bf8f01cfea");
    }
}
