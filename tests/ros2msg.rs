//! Messages of ROS 2 by the definition that a bag carries, without the readers and the writer.

use std::collections::BTreeMap;

/// What a member of a message holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number or a truth value.
    Number(f64),
    /// A text.
    Text(String),
}

/// The members of a message by their paths, such as `poses[2].pose.position.x`. The number of
/// elements of a sequence stands under its path followed by `[]`.
pub type Members = BTreeMap<String, Value>;

/// Reads a message.
///
/// # Panics
/// Where the bytes are not those of the definition: too few, too many, or a text without its end.
pub fn read(definition: &str, bytes: &[u8]) -> Members {
    let mut types = BTreeMap::new();
    for (place, part) in definition.split(&format!("{}\n", "=".repeat(80))).enumerate() {
        let named = part.strip_prefix("MSG: ").and_then(|part| part.split_once('\n'));
        let (kind, members) = named.unwrap_or(("", part));
        assert!((place == 0) == kind.is_empty(), "{part}");
        types.insert(kind, members);
    }
    assert_eq!(bytes[..4], [0, 1, 0, 0], "CDR, little-endian");
    let mut reader = Reader { types, bytes: &bytes[4..], at: 0, members: Members::new() };
    reader.message("", "");
    assert_eq!(reader.at, reader.bytes.len(), "bytes are left");
    reader.members
}

struct Reader<'a> {
    types: BTreeMap<&'a str, &'a str>,
    bytes: &'a [u8],
    at: usize,
    members: Members,
}

impl Reader<'_> {
    fn message(&mut self, kind: &str, path: &str) {
        let members = *self.types.get(kind).unwrap_or_else(|| panic!("{kind} is not defined"));
        for line in members.lines().filter(|line| !line.is_empty() && !line.contains('=')) {
            let (kind, name) = line.split_once(' ').expect("a type and a name");
            let path = if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
            match kind.strip_suffix("[]") {
                Some(kind) => {
                    let count = u32::from_le_bytes(self.take());
                    for index in 0..count {
                        self.member(kind, &format!("{path}[{index}]"));
                    }
                    self.members.insert(format!("{path}[]"), Value::Number(f64::from(count)));
                }
                None => self.member(kind, &path),
            }
        }
    }

    fn member(&mut self, kind: &str, path: &str) {
        let value = match kind {
            "bool" | "uint8" => Value::Number(f64::from(self.take::<1>()[0])),
            "int32" => Value::Number(f64::from(i32::from_le_bytes(self.take()))),
            "uint32" => Value::Number(f64::from(u32::from_le_bytes(self.take()))),
            "float32" => Value::Number(f64::from(f32::from_le_bytes(self.take()))),
            "float64" => Value::Number(f64::from_le_bytes(self.take())),
            "string" => Value::Text(self.text()),
            _ => return self.message(kind, path),
        };
        self.members.insert(path.to_owned(), value);
    }

    /// A number of this many bytes, which begins at a multiple of its size.
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let start = self.at.next_multiple_of(N);
        self.at = start + N;
        self.bytes[start..self.at].try_into().expect("as many bytes")
    }

    fn text(&mut self) -> String {
        let length = u32::from_le_bytes(self.take()) as usize;
        let text = &self.bytes[self.at..self.at + length];
        self.at += length;
        let (end, text) = text.split_last().expect("a text ends with a zero");
        assert_eq!(*end, 0, "a text ends with a zero");
        String::from_utf8(text.to_vec()).expect("a text")
    }
}
