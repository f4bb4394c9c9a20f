//! Numbers in messages by the path of their field, such as `actuators[0].rpm`.

use super::{Count, Definition, Kind, Member};
use crate::rosbag::payload::{Encoding, Number, Payload, PayloadError};
use std::fmt;

/// The path of a field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in super::super) struct Field(Vec<Part>);

/// A name on a path, with the number of an element where it is one of an array.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Part {
    name: String,
    element: Option<usize>,
}

/// The way to a field through the members of a message, by their places.
#[derive(Clone, Debug, PartialEq)]
pub(in super::super) struct Route {
    steps: Vec<(usize, Option<usize>)>,
    number: Number,
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.element {
            Some(element) => write!(f, "{}[{element}]", self.name),
            None => write!(f, "{}", self.name),
        }
    }
}

impl Field {
    /// Reads a path; none where it is none.
    pub(in super::super) fn parse(text: &str) -> Option<Self> {
        let part = |text: &str| {
            let (name, element) = match text.split_once('[') {
                None => (text, None),
                Some((name, element)) => {
                    (name, Some(element.strip_suffix(']')?.parse::<usize>().ok()?))
                }
            };
            let is_name = !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || c == '_');
            is_name.then(|| Part { name: name.to_owned(), element })
        };
        text.split('.').map(part).collect::<Option<Vec<Part>>>().map(Self)
    }
}

/// Messages whose numbers are no measurement.
const UNMEASURED_TYPES: [&str; 4] = [
    "std_msgs/Header",
    "builtin_interfaces/Time",
    "builtin_interfaces/Duration",
    "std_msgs/MultiArrayLayout",
];

/// Deepest message, and most paths, that a list of numbers has.
const MAX_LISTED_DEPTH: usize = 3;
const MAX_LISTED_PATHS: usize = 64;

impl Definition {
    /// The paths of its numbers; of an array that of the first element.
    pub(in super::super) fn numbers(&self) -> Vec<String> {
        let mut paths = Vec::new();
        self.add_numbers(0, "", MAX_LISTED_DEPTH, &mut paths);
        paths
    }

    fn add_numbers(&self, message: usize, before: &str, depth: usize, paths: &mut Vec<String>) {
        for member in &self.messages[message].members {
            if paths.len() >= MAX_LISTED_PATHS || member.count == Count::Fixed(0) {
                continue;
            }
            let element = if member.count == Count::One { "" } else { "[0]" };
            let path = format!("{before}{}{element}", member.name);
            match member.kind {
                Kind::Number(_) => paths.push(path),
                Kind::Message(inner) if depth > 0 && self.is_measured(inner) => {
                    self.add_numbers(inner, &format!("{path}."), depth - 1, paths);
                }
                _ => {}
            }
        }
    }

    /// Whether the numbers of a message may be measured ones.
    fn is_measured(&self, message: usize) -> bool {
        !UNMEASURED_TYPES.contains(&self.messages[message].kind.as_str())
    }

    /// The way to a field that is a number.
    ///
    /// # Errors
    /// What there is instead.
    pub(in super::super) fn route(&self, field: &Field) -> Result<Route, String> {
        let mut message = &self.messages[0];
        let mut steps = Vec::new();
        let mut parts = field.0.iter().peekable();
        while let Some(part) = parts.next() {
            let Some(place) = message.members.iter().position(|one| one.name == part.name) else {
                let names: Vec<&str> =
                    message.members.iter().map(|member| member.name.as_str()).collect();
                let (kind, name, has) = (&message.kind, &part.name, names.join(", "));
                return Err(format!("{kind} has no {name:?}: expected one of {has}"));
            };
            let member = &message.members[place];
            match (member.count, part.element) {
                (Count::One, Some(_)) => {
                    return Err(format!("{} is no array: expected no [] after it", part.name));
                }
                (Count::Fixed(_) | Count::Any, None) => {
                    return Err(format!(
                        "{} is an array: expected one of its elements, such as {}[0]",
                        part.name, part.name
                    ));
                }
                (Count::Fixed(count), Some(element)) if element >= count => {
                    return Err(format!(
                        "{part} is not there: {} has {count} elements, from 0 on",
                        part.name
                    ));
                }
                _ => {}
            }
            steps.push((place, part.element));
            match (member.kind, parts.peek().is_some()) {
                (Kind::Number(number), false) => return Ok(Route { steps, number }),
                (Kind::Message(inner), true) => message = &self.messages[inner],
                (Kind::Message(inner), false) => {
                    let names = self.messages[inner].members.iter();
                    let names: Vec<&str> = names.map(|member| member.name.as_str()).collect();
                    let has = names.join(", ");
                    return Err(format!("{part} is a message: expected one of its fields, {has}"));
                }
                _ => return Err(format!("{part} is no number, and has no fields")),
            }
        }
        Err("expected the path of a field".to_owned())
    }

    /// The stamp in a message, ns: that of its header, or a `stamp` of its own; none where it has
    /// none, or it is zero. `payload` stands at the beginning of the message.
    pub(in super::super) fn stamp(&self, payload: &Payload) -> Result<Option<i64>, String> {
        let members = &self.messages[0].members;
        let is_of = |member: &Member, name: &str| match member.kind {
            Kind::Message(inner) => self.messages[inner].kind == name,
            _ => false,
        };
        let header = members.iter().position(|one| is_of(one, "std_msgs/Header"));
        let is_stamp = |member: &Member| {
            let is_time = member.kind == Kind::Time || is_of(member, "builtin_interfaces/Time");
            is_time && member.name == "stamp"
        };
        let Some(place) = header.or_else(|| members.iter().position(is_stamp)) else {
            return Ok(None);
        };
        if members[place].count != Count::One {
            return Ok(None);
        }
        let mut payload = payload.clone();
        let at_stamp = |payload: &mut Payload| -> Result<Option<i64>, PayloadError> {
            if header.is_some() && payload.encoding() == Encoding::Ros1 {
                // the number in its sequence
                payload.u32()?;
            }
            let (seconds, nanoseconds) = (payload.i32()?, payload.u32()?);
            let stamp = i64::from(seconds) * 1_000_000_000 + i64::from(nanoseconds);
            Ok((stamp != 0).then_some(stamp))
        };
        for member in &members[..place] {
            self.skip(member, &mut payload)?;
        }
        at_stamp(&mut payload).map_err(|error| error.to_string())
    }

    /// The number at the end of a way; `payload` stands at the beginning of the message.
    pub(in super::super) fn number(&self, route: &Route, payload: &Payload) -> Result<f64, String> {
        let decode = |error: PayloadError| error.to_string();
        let mut payload = payload.clone();
        let mut message = &self.messages[0];
        for &(place, element) in &route.steps {
            for member in &message.members[..place] {
                self.skip(member, &mut payload)?;
            }
            let member = &message.members[place];
            if let Some(element) = element {
                let count = Self::count(member, &mut payload)?;
                if element >= count {
                    let name = &member.name;
                    return Err(format!("{name} has {count} elements, and no {name}[{element}]"));
                }
                self.skip_elements(member.kind, element, &mut payload)?;
            }
            if let Kind::Message(inner) = member.kind {
                message = &self.messages[inner];
            }
        }
        payload.number(route.number).map_err(decode)
    }

    /// How many elements a member has; goes to the first.
    fn count(member: &Member, payload: &mut Payload) -> Result<usize, String> {
        let is_flat = matches!(member.kind, Kind::Number(_) | Kind::Bool);
        if !is_flat && member.count != Count::One && payload.delimits_arrays() {
            return Err("it is encoded by XCDR2, whose arrays of messages are not read".to_owned());
        }
        match member.count {
            Count::One => Ok(1),
            Count::Fixed(count) => Ok(count),
            Count::Any => payload.length().map_err(|error| error.to_string()),
        }
    }

    fn skip(&self, member: &Member, payload: &mut Payload) -> Result<(), String> {
        let count = Self::count(member, payload)?;
        self.skip_elements(member.kind, count, payload)
    }

    fn skip_elements(&self, kind: Kind, count: usize, payload: &mut Payload) -> Result<(), String> {
        let decode = |error: PayloadError| error.to_string();
        match kind {
            Kind::Bool => return payload.skip(1, count).map_err(decode),
            Kind::Number(number) => return payload.skip(number.size(), count).map_err(decode),
            Kind::Time => return payload.skip(4, count.saturating_mul(2)).map_err(decode),
            Kind::WideText => return Err("a wide text stands before the field".to_owned()),
            Kind::Text | Kind::Message(_) => {}
        }
        let ros = usize::from(payload.encoding() == Encoding::Cdr);
        if let Kind::Message(inner) = kind
            && self.messages[inner].is_sizeless[ros]
        {
            // However many there are: messages of such messages grow without end.
            return Ok(());
        }
        for _ in 0..count {
            match kind {
                Kind::Message(inner) if self.messages[inner].members.is_empty() => {
                    payload.skip(1, 1).map_err(decode)?;
                }
                Kind::Message(inner) => {
                    for member in &self.messages[inner].members {
                        self.skip(member, payload)?;
                    }
                }
                _ => {
                    let length = payload.length().map_err(decode)?;
                    payload.skip(1, length).map_err(decode)?;
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rosbag::definition::Texts;

    #[test]
    fn ros_1_has_times_a_sequence_number_and_no_gaps() {
        let rule = "=".repeat(80);
        let header = "uint32 seq\ntime stamp\nstring frame_id";
        let text = format!(
            "int8 LOW=1\nHeader header\nduration lag\nchar[] key\nint16 speed\n{rule}\n\
             MSG: std_msgs/Header\n{header}"
        );
        let mut texts = Texts::default();
        texts.add("robot/Wheel", &text);
        let definition = texts.definition("robot/Wheel").expect("a definition");
        let mut bytes = Vec::new();
        for number in [9_u32, 1_700_000_000, 5, 1] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.push(b'b');
        bytes.extend([0; 8]);
        bytes.extend(3_u32.to_le_bytes());
        bytes.extend(*b"key");
        bytes.extend((-7_i16).to_le_bytes());
        let payload = Payload::of(Encoding::Ros1, &bytes).expect("a payload");
        let route = |text: &str| definition.route(&Field::parse(text).expect("a path"));
        assert_eq!(definition.number(&route("speed").expect("there"), &payload), Ok(-7.0));
        assert_eq!(definition.number(&route("header.seq").expect("there"), &payload), Ok(9.0));
        assert_eq!(definition.number(&route("key[1]").expect("there"), &payload), Ok(101.0));
        assert_eq!(definition.stamp(&payload), Ok(Some(1_700_000_000_000_000_005)));
        assert!(route("header.stamp").expect_err("a time").contains("no number"));
    }

    /// Ten members in each of twenty messages are 10²⁰ places at which nothing stands.
    #[test]
    fn messages_without_bytes_are_passed_at_once() {
        let rule = "=".repeat(80);
        for (encoding, last) in [(Encoding::Ros1, ""), (Encoding::Cdr, "uint8[0] nothing")] {
            let level = |level: usize| {
                let member = |k: usize| format!("Level{} member{k}\n", level + 1);
                let members: String = (0..10).map(member).collect();
                format!("{rule}\nMSG: robot/Level{level}\n{members}")
            };
            let levels: String = (0..20).map(level).collect();
            let last = format!("{rule}\nMSG: robot/Level20\n{last}\n");
            let text = format!("Level0 first\nint8 speed\n{levels}{last}");
            let mut texts = Texts::default();
            texts.add("robot/Wheel", &text);
            let definition = texts.definition("robot/Wheel").expect("a definition");
            let bytes: &[u8] = if encoding == Encoding::Ros1 { &[7] } else { &[0, 1, 0, 0, 7] };
            let payload = Payload::of(encoding, bytes).expect("a payload");
            let route = definition.route(&Field::parse("speed").expect("a path")).expect("there");
            assert_eq!(definition.number(&route, &payload), Ok(7.0));
        }
    }
}
