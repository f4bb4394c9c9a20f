//! The files of a bag.

use super::compressed::Decompressing;
use super::part::{Part, Storage};
use super::visitor::Visitor;
use super::{mcap_file, ros1_file, sqlite_file};
use crate::Error;
use crate::recording::Warning;
use crate::table::{too_many, unreadable};
use std::path::{Path, PathBuf};
use trackdyn_core::input::{self, name_of};

const METADATA: &str = "metadata.yaml";

/// Whether the path is a bag: a file that ends in `.mcap`, `.db3` or `.bag`, packed by zstd or not,
/// or a folder with such files.
///
/// # Errors
/// [`Error::Unreadable`].
pub(crate) fn is_bag(path: &Path) -> Result<bool, Error> {
    Ok(if path.is_dir() { !parts(path)?.is_empty() } else { Part::of(path).is_some() })
}

/// The name of a bag: that of its folder or file without the endings.
pub(super) fn name(path: &Path) -> String {
    let bare = Part::of(path).map_or_else(|| path.to_owned(), |part| part.unpacked_path());
    name_of(&bare)
}

/// Shows all messages of the bag's files, in their order; memory does not grow with the files.
pub(super) fn scan(path: &Path, visitor: &mut dyn Visitor) -> Result<Vec<Warning>, Error> {
    let mut warnings = Vec::new();
    let parts = parts(path)?;
    if parts.is_empty() {
        return Err(Error::NotARecording {
            path: path.to_owned(),
            found: "no bag file".to_owned(),
            expected: "a .mcap, .db3 or .bag file, packed (.zstd) or not, or a folder with such \
                       files",
        });
    }
    let mut visitor = Decompressing::new(visitor);
    for listed in parts {
        let Some(part) = listed.clone().present() else {
            if !path.is_dir() {
                input::open(path).map_err(|cause| unreadable(path, cause))?;
            }
            warnings.push(Warning::PartMissing { path: listed.path().to_owned() });
            continue;
        };
        warnings.extend(match part.storage {
            Storage::Mcap => mcap_file::scan(&part, &mut visitor)?,
            Storage::Sqlite => sqlite_file::scan(&part, &mut visitor)?.into_iter().collect(),
            Storage::Ros1 => ros1_file::scan(&part, &mut visitor)?,
        });
        if visitor.is_full() {
            let path = path.to_owned();
            return Err(Error::Bag { path, message: too_many("messages of motion") });
        }
    }
    Ok(warnings)
}

/// The files of a bag: those that `metadata.yaml` lists, there or not, else those in the folder by
/// name.
fn parts(path: &Path) -> Result<Vec<Part>, Error> {
    if !path.is_dir() {
        return Ok(Part::of(path).into_iter().collect());
    }
    if let Ok(text) = input::text(&path.join(METADATA)) {
        let listed = listed_files(&text).filter_map(|name| Part::of(&path.join(name)));
        let listed: Vec<Part> = listed.collect();
        if listed.iter().any(|part| part.clone().present().is_some()) {
            return Ok(listed);
        }
    }
    let mut found = Vec::new();
    for entry in std::fs::read_dir(path).map_err(|cause| unreadable(path, cause))? {
        let file = entry.map_err(|cause| unreadable(path, cause))?.path();
        found.extend(Part::of(&file).filter(Part::is_there));
    }
    // A bag of ROS 1 beside one of ROS 2 is what that was converted from.
    if found.iter().any(|part| part.storage != Storage::Ros1) {
        found.retain(|part| part.storage != Storage::Ros1);
    }
    // _2 before _10; of a file that is there packed and unpacked, one
    let order = |part: &Part| -> (usize, PathBuf) {
        let path = part.unpacked_path();
        (path.as_os_str().len(), path)
    };
    found.sort_by_key(order);
    found.dedup_by_key(|part| order(part));
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
    use super::*;

    #[test]
    fn the_list_ends_where_the_next_key_starts() {
        let text = "rosbag2_bagfile_information:\n  relative_file_paths:\n    - a_0.mcap\n    \
                    - \"a_1.mcap\"\n  duration:\n    - 3\n";
        assert_eq!(listed_files(text).collect::<Vec<_>>(), ["a_0.mcap", "a_1.mcap"]);
        assert_eq!(listed_files("files: []").count(), 0);
    }

    /// Names of the parts of a folder with these files, and which of them is taken.
    fn parts_of(files: &[(&str, &str)]) -> Vec<(String, Option<String>)> {
        let folder = tempfile::tempdir().expect("a temporary folder");
        for (name, text) in files {
            std::fs::write(folder.path().join(name), text).expect("written");
        }
        let name =
            |part: &Part| part.path().file_name().expect("a name").to_string_lossy().into_owned();
        let parts = parts(folder.path()).expect("readable");
        assert_eq!(is_bag(folder.path()).expect("readable"), !parts.is_empty());
        parts.into_iter().map(|part| (name(&part), part.present().as_ref().map(name))).collect()
    }

    fn pair(listed: &str, taken: Option<&str>) -> (String, Option<String>) {
        (listed.to_owned(), taken.map(str::to_owned))
    }

    #[test]
    fn packed_and_unpacked_parts_are_one_and_absent_ones_are_kept() {
        let listed = "relative_file_paths:\n  - a_0.mcap.zstd\n  - a_1.mcap.zstd\n  - a_2.mcap\n";
        let found = parts_of(&[
            ("metadata.yaml", listed),
            ("a_0.mcap", ""),
            ("a_0.mcap.zstd", ""),
            ("a_2.mcap.zstd", ""),
        ]);
        let expected = [
            pair("a_0.mcap.zstd", Some("a_0.mcap")),
            pair("a_1.mcap.zstd", None),
            pair("a_2.mcap", Some("a_2.mcap.zstd")),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn a_folder_of_packed_parts_is_a_bag_in_the_order_of_its_numbers() {
        let found = parts_of(&[("a_10.db3.zstd", ""), ("a_9.db3", ""), ("a_9.db3.zstd", "")]);
        let names: Vec<Option<String>> = found.into_iter().map(|(_, taken)| taken).collect();
        assert_eq!(names, [Some("a_9.db3".to_owned()), Some("a_10.db3.zstd".to_owned())]);
        assert_eq!(parts_of(&[("a.bag", ""), ("a.mcap", "")]), [pair("a.mcap", Some("a.mcap"))]);
        assert!(parts_of(&[("notes.txt", "")]).is_empty());
    }
}
