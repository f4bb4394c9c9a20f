//! A file of a bag: what it holds, and whether it is packed.

use super::unpacked::max_unpacked;
use crate::Error;
use crate::table::unreadable;
use std::fs::File;
use std::io::{BufReader, ErrorKind, Read};
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use trackdyn_core::input;

/// Bytes taken from a file at a time; longer reads pass the buffer by.
const BUFFER_SIZE: usize = 1 << 16;

/// Endings of files that `zstd` packed: those of rosbag2 and of the program itself.
const PACKED_ENDINGS: [&str; 2] = [".zstd", ".zst"];

/// Endings of the files of bags. `.bag.active` is a bag whose recorder was stopped early.
const ENDINGS: [(&str, Storage); 4] = [
    (".mcap", Storage::Mcap),
    (".db3", Storage::Sqlite),
    (".bag", Storage::Ros1),
    (".bag.active", Storage::Ros1),
];

/// How the messages are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Storage {
    Mcap,
    Sqlite,
    Ros1,
}

/// A file of a bag.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Part {
    path: PathBuf,
    pub(super) storage: Storage,
    is_packed: bool,
}

/// A file whose content lies on the disk as it is, for readers that jump about in it.
pub(super) struct OnDisk {
    pub(super) path: PathBuf,
    /// Folder of a copy, which is removed with this value; none where it is the user's file.
    copy: Option<TempDir>,
}

impl Part {
    /// The part that a path names, there or not; none where it has another ending.
    pub(super) fn of(path: &Path) -> Option<Self> {
        let name = path.file_name()?.to_string_lossy();
        let bare = PACKED_ENDINGS.iter().find_map(|ending| name.strip_suffix(ending));
        let storage = ENDINGS.iter().find(|(ending, _)| bare.unwrap_or(&name).ends_with(ending))?.1;
        Some(Self { path: path.to_owned(), storage, is_packed: bare.is_some() })
    }

    /// The file.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// The name without the ending of packed files.
    pub(super) fn unpacked_path(&self) -> PathBuf {
        if self.is_packed { self.path.with_extension("") } else { self.path.clone() }
    }

    pub(super) fn is_there(&self) -> bool {
        self.path.is_file()
    }

    /// This part if it is there, else its packed or unpacked form; the unpacked one is preferred.
    pub(super) fn present(self) -> Option<Self> {
        let bare = self.unpacked_path();
        let packed = PACKED_ENDINGS.iter().map(|ending| {
            let mut name = bare.clone().into_os_string();
            name.push(ending);
            PathBuf::from(name)
        });
        std::iter::once(bare.clone())
            .chain(packed)
            .filter_map(|path| Self::of(&path))
            .find(Self::is_there)
    }

    /// Its content as a stream, unpacked on the way.
    ///
    /// # Errors
    /// [`Error::Unreadable`].
    pub(super) fn open(&self) -> Result<Box<dyn Read>, Error> {
        let refused = |cause| unreadable(&self.path, cause);
        let file = input::open(&self.path).map_err(refused)?;
        Ok(if self.is_packed {
            let most = max_unpacked(file.metadata().map_err(refused)?.len());
            let unpacking = zstd::stream::read::Decoder::new(file).map_err(refused)?;
            let unpacking = AtMost { most, left: most, content: unpacking };
            Box::new(BufReader::with_capacity(BUFFER_SIZE, unpacking))
        } else {
            Box::new(BufReader::with_capacity(BUFFER_SIZE, file))
        })
    }

    /// Its content as a file. What is packed is unpacked into the folder for temporary files, and
    /// so are files with what `beside` lists: endings of files that belong to it, which its reader
    /// would change.
    ///
    /// # Errors
    /// [`Error::Unreadable`], also for a disk that is full.
    pub(super) fn on_disk(&self, beside: &[&str]) -> Result<OnDisk, Error> {
        let sibling = |ending: &str| {
            let mut name = self.path.clone().into_os_string();
            name.push(ending);
            PathBuf::from(name)
        };
        let is_filled = |path: &PathBuf| {
            std::fs::metadata(path).is_ok_and(|file| file.is_file() && file.len() > 0)
        };
        let live: Vec<&&str> = beside.iter().filter(|ending| is_filled(&sibling(ending))).collect();
        if !self.is_packed && live.is_empty() {
            return Ok(OnDisk { path: self.path.clone(), copy: None });
        }
        let refused = |cause| unreadable(&self.path, cause);
        let folder = tempfile::tempdir().map_err(refused)?;
        let path = folder.path().join("part");
        let mut target = File::create(&path).map_err(refused)?;
        std::io::copy(&mut self.open()?, &mut target).map_err(refused)?;
        for ending in live {
            let copy = folder.path().join(format!("part{ending}"));
            std::fs::copy(sibling(ending), copy).map_err(refused)?;
        }
        Ok(OnDisk { path, copy: Some(folder) })
    }
}

/// A content that ends with an error where it is larger than it may be.
struct AtMost<R> {
    content: R,
    most: u64,
    left: u64,
}

impl<R: Read> Read for AtMost<R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let count = self.content.read(buffer)?;
        let Some(left) = self.left.checked_sub(count as u64) else {
            let most = self.most >> 20;
            let expected = format!(
                "it unpacks to more than {most} MiB, far more than its size: expected less, or the \
                 file unpacked (zstd -d)"
            );
            return Err(std::io::Error::new(ErrorKind::FileTooLarge, expected));
        };
        self.left = left;
        Ok(count)
    }
}

impl OnDisk {
    /// Whether it is a copy that may be changed.
    pub(super) fn is_copy(&self) -> bool {
        self.copy.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_tell_storage_and_packing() {
        let of = |name: &str| Part::of(Path::new(name)).map(|part| (part.storage, part.is_packed));
        assert_eq!(of("a/b_0.mcap"), Some((Storage::Mcap, false)));
        assert_eq!(of("b_0.db3.zstd"), Some((Storage::Sqlite, true)));
        assert_eq!(of("drive.bag.active"), Some((Storage::Ros1, false)));
        assert_eq!((of("notes.zst"), of("mcap"), of("b.mcap.gz")), (None, None, None));
        let part = Part::of(Path::new("a/b_0.mcap.zst")).expect("a part");
        assert_eq!(part.unpacked_path(), Path::new("a/b_0.mcap"));
    }
}
