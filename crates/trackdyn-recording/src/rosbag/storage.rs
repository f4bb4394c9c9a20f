//! The files of a bag.

use super::visitor::Visitor;
use super::{mcap_file, sqlite_file};
use crate::Error;
use crate::recording::Warning;
use crate::table::unreadable;
use std::path::{Path, PathBuf};

const METADATA: &str = "metadata.yaml";

/// Whether the path is a bag: a file that ends in `.mcap` or `.db3`, or a folder with such files.
///
/// # Errors
/// [`Error::Unreadable`].
pub(crate) fn is_bag(path: &Path) -> Result<bool, Error> {
    Ok(if path.is_dir() { !parts(path)?.is_empty() } else { is_part(path) })
}

fn is_part(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "mcap" || extension == "db3")
}

/// Whether it is a file of a bag that can be read.
fn is_there(file: &Path) -> bool {
    is_part(file) && file.is_file()
}

/// Shows all messages of the bag's files, in their order; memory does not grow with the files.
pub(super) fn scan(path: &Path, visitor: &mut dyn Visitor) -> Result<Vec<Warning>, Error> {
    let mut warnings = Vec::new();
    let parts = parts(path)?;
    if parts.is_empty() {
        return Err(Error::NotARecording {
            path: path.to_owned(),
            found: "no bag file".to_owned(),
            expected: "a .mcap or .db3 file or a folder with such files; zstd -d unpacks .zstd \
                       files",
        });
    }
    for file in parts {
        if !is_there(&file) {
            warnings.push(Warning::PartMissing { path: file });
            continue;
        }
        let damage = if file.extension().is_some_and(|extension| extension == "db3") {
            sqlite_file::scan(&file, visitor)?
        } else {
            mcap_file::scan(&file, visitor)?
        };
        warnings.extend(damage);
    }
    Ok(warnings)
}

/// The files of a bag: those that `metadata.yaml` lists, there or not, else those in the folder by
/// name.
fn parts(path: &Path) -> Result<Vec<PathBuf>, Error> {
    if !path.is_dir() {
        return Ok(if is_part(path) { vec![path.to_owned()] } else { Vec::new() });
    }
    if let Ok(text) = std::fs::read_to_string(path.join(METADATA)) {
        let listed: Vec<PathBuf> = listed_files(&text).map(|name| path.join(name)).collect();
        if listed.iter().any(|file| is_there(file)) {
            return Ok(listed);
        }
    }
    let mut found = Vec::new();
    for entry in std::fs::read_dir(path).map_err(|cause| unreadable(path, cause))? {
        let file = entry.map_err(|cause| unreadable(path, cause))?.path();
        if is_there(&file) {
            found.push(file);
        }
    }
    // _2 before _10
    found.sort_by_key(|file| (file.as_os_str().len(), file.clone()));
    Ok(found)
}

/// The list under `relative_file_paths` of a bag's `metadata.yaml`.
fn listed_files(text: &str) -> impl Iterator<Item = &str> {
    text.lines()
        .skip_while(|line| line.trim() != "relative_file_paths:")
        .skip(1)
        .map_while(|line| line.trim_start().strip_prefix('-'))
        .map(|name| name.trim().trim_matches(['"', '\'']))
}

#[cfg(test)]
mod tests {
    use super::listed_files;

    #[test]
    fn the_list_ends_where_the_next_key_starts() {
        let text = "rosbag2_bagfile_information:\n  relative_file_paths:\n    - a_0.mcap\n    \
                    - \"a_1.mcap\"\n  duration:\n    - 3\n";
        assert_eq!(listed_files(text).collect::<Vec<_>>(), ["a_0.mcap", "a_1.mcap"]);
        assert_eq!(listed_files("files: []").count(), 0);
    }
}
