//! Texts of message definitions, from bags and from folders.

use super::{Count, Definition};
use crate::Error;
use crate::table::unreadable;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use trackdyn_core::input;

/// Deepest folder that is looked into.
const MAX_FOLDERS: usize = 8;

/// What stands between definitions, at least.
const RULE: &str = "===";

/// Definitions that no bag and no folder has to have: those of numbers and joints, which bags of
/// ROS 2 before Iron hold without.
const KNOWN_DEFINITIONS: [(&str, &str); 18] = [
    ("builtin_interfaces/Time", "int32 sec\nuint32 nanosec"),
    ("builtin_interfaces/Duration", "int32 sec\nuint32 nanosec"),
    ("std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id"),
    ("std_msgs/Float32", "float32 data"),
    ("std_msgs/Float64", "float64 data"),
    ("std_msgs/Int8", "int8 data"),
    ("std_msgs/Int16", "int16 data"),
    ("std_msgs/Int32", "int32 data"),
    ("std_msgs/Int64", "int64 data"),
    ("std_msgs/MultiArrayDimension", "string label\nuint32 size\nuint32 stride"),
    ("std_msgs/MultiArrayLayout", "MultiArrayDimension[] dim\nuint32 data_offset"),
    ("std_msgs/Float32MultiArray", "MultiArrayLayout layout\nfloat32[] data"),
    ("std_msgs/Float64MultiArray", "MultiArrayLayout layout\nfloat64[] data"),
    ("std_msgs/Int16MultiArray", "MultiArrayLayout layout\nint16[] data"),
    ("std_msgs/Int32MultiArray", "MultiArrayLayout layout\nint32[] data"),
    ("std_msgs/Int64MultiArray", "MultiArrayLayout layout\nint64[] data"),
    ("std_msgs/UInt16", "uint16 data"),
    (
        "sensor_msgs/JointState",
        "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n\
         float64[] effort",
    ),
];

/// A type without `msg/`, as both versions of ROS write it.
pub(in super::super) fn bare(kind: &str) -> String {
    kind.replacen("/msg/", "/", 1)
}

/// Texts of definitions by type.
#[derive(Clone, Debug, Default)]
pub(in super::super) struct Texts {
    of_bag: BTreeMap<String, String>,
    of_folder: BTreeMap<String, String>,
}

impl Texts {
    /// The definitions in the files `PACKAGE/msg/TYPE.msg` of a folder, at any depth.
    ///
    /// # Errors
    /// [`Error::Unreadable`]; [`Error::Empty`] where there are none.
    pub(in super::super) fn of_folder(folder: &Path) -> Result<Self, Error> {
        let mut texts = Self::default();
        texts.look_into(folder, 0)?;
        if texts.of_folder.is_empty() {
            let message = "no definitions of messages: expected files such as \
                           PACKAGE/msg/TYPE.msg (--msg-dir)"
                .to_owned();
            return Err(Error::Empty { path: folder.to_owned(), message });
        }
        Ok(texts)
    }

    fn look_into(&mut self, folder: &Path, depth: usize) -> Result<(), Error> {
        let mut paths: Vec<PathBuf> = Vec::new();
        for entry in std::fs::read_dir(folder).map_err(|cause| unreadable(folder, cause))? {
            paths.push(entry.map_err(|cause| unreadable(folder, cause))?.path());
        }
        paths.sort();
        for path in paths {
            if path.is_dir() && depth < MAX_FOLDERS {
                self.look_into(&path, depth + 1)?;
            } else if path.extension().is_some_and(|ending| ending == "msg")
                && let Some(kind) = kind_of_file(&path)
            {
                let text = input::bytes(&path, input::MAX_TEXT_SIZE)
                    .map_err(|cause| unreadable(&path, cause))?;
                let text = String::from_utf8_lossy(&text).into_owned();
                self.of_folder.entry(kind).or_insert(text);
            }
        }
        Ok(())
    }

    /// Adds the definition of a type as a bag has it, with those of the types that it needs.
    pub(in super::super) fn add(&mut self, kind: &str, text: &str) {
        let mut name = bare(kind);
        let mut lines: Vec<&str> = Vec::new();
        for line in text.lines().chain([RULE]) {
            let trimmed = line.trim();
            if trimmed.len() >= RULE.len() && trimmed.bytes().all(|byte| byte == b'=') {
                let section = std::mem::take(&mut lines).join("\n");
                let name = std::mem::take(&mut name);
                // A message may have no members, but nothing at all is said of the type itself.
                if !name.is_empty() && (name != bare(kind) || !section.trim().is_empty()) {
                    self.of_bag.entry(name).or_insert(section);
                }
            } else if let Some(next) = trimmed.strip_prefix("MSG:") {
                name = bare(next.trim());
            } else {
                lines.push(line);
            }
        }
    }

    /// The definition of a type.
    ///
    /// # Errors
    /// What is missing, and the option that helps.
    pub(in super::super) fn definition(&self, kind: &str) -> Result<Definition, String> {
        let known = |kind: &str| {
            KNOWN_DEFINITIONS.iter().find(|(name, _)| *name == kind).map(|(_, text)| *text)
        };
        let text = |kind: &str| {
            let text = self.of_bag.get(kind).or_else(|| self.of_folder.get(kind));
            text.map(String::as_str).or_else(|| known(kind))
        };
        Definition::of(kind, text).map_err(|problem| {
            format!("{problem}: expected in the bag, or a folder of .msg files by --msg-dir DIR")
        })
    }
}

/// The type that a file defines, by its name and that of its package.
fn kind_of_file(path: &Path) -> Option<String> {
    let name = path.file_stem()?.to_str()?;
    let folder = path.parent()?;
    let package = if folder.ends_with("msg") { folder.parent()? } else { folder };
    Some(format!("{}/{name}", package.file_name()?.to_str()?))
}

/// A line that defines a member.
pub(super) struct Line<'a> {
    pub(super) kind: &'a str,
    pub(super) name: &'a str,
    pub(super) count: Count,
}

/// The members that a text defines; a line that defines none as an error.
pub(super) fn members(text: &str) -> impl Iterator<Item = Result<Line<'_>, &str>> {
    let lines = text.lines().map(|line| line.split('#').next().unwrap_or_default().trim());
    lines.filter(|line| !line.is_empty()).filter_map(|line| member(line).transpose())
}

/// A member; none for a constant.
fn member(line: &str) -> Result<Option<Line<'_>>, &str> {
    let (kind, rest) = line.split_once(char::is_whitespace).ok_or(line)?;
    let rest = rest.trim_start();
    let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
    let (name, rest) = rest.split_at(end);
    if rest.trim_start().starts_with('=') {
        return Ok(None);
    }
    let (kind, count) = match kind.split_once('[') {
        None => (kind, Count::One),
        Some((kind, count)) => {
            let count = count.strip_suffix(']').ok_or(line)?;
            if count.is_empty() || count.starts_with("<=") {
                (kind, Count::Any)
            } else {
                (kind, Count::Fixed(count.parse().map_err(|_| line)?))
            }
        }
    };
    // a bound of a text
    let kind = kind.split_once("<=").map_or(kind, |(kind, _)| kind);
    let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '/';
    if name.is_empty() || kind.is_empty() || !kind.chars().all(is_word) {
        return Err(line);
    }
    Ok(Some(Line { kind, name, count }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_bounds_defaults_and_constants_are_told_apart() {
        let text = "# a comment\nuint8 MODE_A=1\nstring X = \"a # b\"\nint32[<=3] counts [1, 2]\n\
                    string<=5[2] names # two\n  float64   speed 1.5\npkg/msg/Wheel[] wheels\n";
        let members: Vec<_> = members(text).map(|line| line.expect("a member")).collect();
        let found: Vec<(&str, &str, Count)> =
            members.iter().map(|line| (line.kind, line.name, line.count)).collect();
        let expected = [
            ("int32", "counts", Count::Any),
            ("string", "names", Count::Fixed(2)),
            ("float64", "speed", Count::One),
            ("pkg/msg/Wheel", "wheels", Count::Any),
        ];
        assert_eq!(found, expected);
        for wrong in ["float64", "float64[x] a", "float64[2 a", "[] a"] {
            assert_eq!(super::members(wrong).next().and_then(Result::err), Some(wrong));
        }
    }

    #[test]
    fn sections_of_a_bag_come_before_files_of_a_folder() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let package = folder.path().join("share/pkg/msg");
        std::fs::create_dir_all(&package).expect("a folder");
        std::fs::write(package.join("Wheel.msg"), "float32 other").expect("written");
        std::fs::write(package.join("Lamp.msg"), "bool on").expect("written");
        let mut texts = Texts::of_folder(folder.path()).expect("definitions");
        let rule = "=".repeat(80);
        texts.add("pkg/msg/Car", &format!("Wheel[] wheels\n{rule}\nMSG: pkg/Wheel\nint16 rpm\n"));
        let wheel = texts.definition("pkg/msg/Wheel").expect("a definition");
        assert_eq!(wheel.messages[0].members[0].name, "rpm");
        assert!(texts.definition("pkg/Lamp").is_ok());
        // as some recorders write it: a rule and a name before the type itself, an empty message
        texts.add("pkg/Van", &format!("{rule}\nMSG: pkg/Van\nNone none\n{rule}\nMSG: pkg/None\n"));
        let van = texts.definition("pkg/Van").expect("a definition");
        assert_eq!((van.messages.len(), van.messages[1].members.len()), (2, 0));
        // a bag that says nothing
        texts.add("pkg/msg/Boat", "");
        assert!(texts.definition("pkg/Boat").is_err());
        let refused = texts.definition("pkg/Engine").expect_err("not there");
        assert!(refused.contains("pkg/Engine") && refused.contains("--msg-dir"), "{refused}");
        let empty = tempfile::tempdir().expect("a temporary folder");
        let refused = Texts::of_folder(empty.path()).expect_err("nothing there");
        assert!(refused.to_string().contains("PACKAGE/msg/TYPE.msg"), "{refused}");
    }

    #[test]
    fn a_message_that_holds_itself_is_refused() {
        let mut texts = Texts::default();
        texts.add("pkg/Node", "Node[] children");
        assert!(texts.definition("pkg/Node").expect_err("refused").contains("nested"));
    }
}
