//! Files in a temporary folder, for readers that take paths.
//!
//! The folder lasts as long as the target. `TMPDIR` says where it is; in memory it is fast.

use std::path::PathBuf;
use std::sync::OnceLock;
use tempfile::TempDir;

/// The folder of this target.
///
/// # Panics
/// Where none can be made.
pub fn folder() -> PathBuf {
    static FOLDER: OnceLock<TempDir> = OnceLock::new();
    let folder = FOLDER.get_or_init(|| tempfile::tempdir().expect("a temporary folder"));
    folder.path().to_owned()
}

/// A file with these bytes in place of the one that was there.
///
/// # Panics
/// Where it cannot be written.
pub fn file(name: &str, bytes: &[u8]) -> PathBuf {
    let path = folder().join(name);
    std::fs::write(&path, bytes).expect("written");
    path
}

/// A file that is not there.
///
/// # Panics
/// Where it is there and cannot be removed.
pub fn no_file(name: &str) -> PathBuf {
    let path = folder().join(name);
    if path.exists() {
        std::fs::remove_file(&path).expect("removed");
    }
    path
}

/// The files that an input stands for: a zero byte stands between them.
pub fn parts<const N: usize>(input: &[u8]) -> [Option<&[u8]>; N] {
    let mut parts = input.splitn(N, |byte| *byte == 0);
    std::array::from_fn(|_| parts.next())
}
