//! Definitions of messages: which members a message has, in which order.
//!
//! # Sources
//! ROS 2 documentation, "Interfaces" (types, bounds, constants); ROS wiki, "msg" (those of ROS 1);
//! the MCAP format registry, "ros2msg" and "ros1msg" (definitions with those that they need).

use super::payload::Number;
use std::collections::BTreeMap;

mod field;
mod text;

pub(super) use field::{Field, Route};
pub(super) use text::{Texts, bare};

/// Deepest nesting of messages that is followed.
const MAX_DEPTH: usize = 32;

/// What messages of a type consist of: the first of the messages, and those that it holds.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Definition {
    messages: Vec<Message>,
}

/// A message.
#[derive(Clone, Debug, PartialEq)]
struct Message {
    /// Its type, without `msg/`.
    kind: String,
    members: Vec<Member>,
    /// Whether no byte stands for it: in ROS 1, and in ROS 2.
    is_sizeless: [bool; 2],
}

/// A member of a message.
#[derive(Clone, Debug, PartialEq)]
struct Member {
    name: String,
    kind: Kind,
    count: Count,
}

/// What a member is, or each of its elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Bool,
    Number(Number),
    /// `time` and `duration` of ROS 1: two numbers of 4 bytes.
    Time,
    Text,
    WideText,
    /// Another message, by its place.
    Message(usize),
}

/// How many elements a member has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Count {
    /// It is no array.
    One,
    /// An array of this length.
    Fixed(usize),
    /// A sequence with its length before it.
    Any,
}

impl Definition {
    /// The definition of a type; `text` has those of all types.
    ///
    /// # Errors
    /// A type that is not defined, or a line that is none of a definition.
    fn of<'a>(kind: &str, text: impl Fn(&str) -> Option<&'a str>) -> Result<Self, String> {
        let mut builder = Builder { text, messages: Vec::new(), places: BTreeMap::new() };
        builder.place(&bare(kind), 0)?;
        Ok(Self { messages: builder.messages })
    }
}

/// Gathers the messages that a type needs.
struct Builder<F> {
    text: F,
    messages: Vec<Message>,
    places: BTreeMap<String, usize>,
}

impl<'a, F: Fn(&str) -> Option<&'a str>> Builder<F> {
    /// The place of a message.
    fn place(&mut self, kind: &str, depth: usize) -> Result<usize, String> {
        if let Some(place) = self.places.get(kind) {
            return Ok(*place);
        }
        if depth > MAX_DEPTH {
            return Err(format!("{kind} is nested more than {MAX_DEPTH} deep"));
        }
        let text =
            (self.text)(kind).ok_or_else(|| format!("the definition of {kind} is not there"))?;
        let place = self.messages.len();
        let none_yet =
            Message { kind: kind.to_owned(), members: Vec::new(), is_sizeless: [false; 2] };
        self.messages.push(none_yet);
        let package = kind.split_once('/').map_or("", |(package, _)| package);
        let mut members = Vec::new();
        for line in text::members(text) {
            let line = line.map_err(|line| format!("{line:?} is no member of {kind}"))?;
            let found = match line.kind {
                "bool" => Kind::Bool,
                "int8" | "byte" => Kind::Number(Number::I8),
                "uint8" | "char" => Kind::Number(Number::U8),
                "int16" => Kind::Number(Number::I16),
                "uint16" => Kind::Number(Number::U16),
                "int32" => Kind::Number(Number::I32),
                "uint32" => Kind::Number(Number::U32),
                "int64" => Kind::Number(Number::I64),
                "uint64" => Kind::Number(Number::U64),
                "float32" => Kind::Number(Number::F32),
                "float64" => Kind::Number(Number::F64),
                "time" | "duration" => Kind::Time,
                "string" => Kind::Text,
                "wstring" => Kind::WideText,
                "Header" => Kind::Message(self.place("std_msgs/Header", depth + 1)?),
                other if other.contains('/') => Kind::Message(self.place(&bare(other), depth + 1)?),
                other => Kind::Message(self.place(&format!("{package}/{other}"), depth + 1)?),
            };
            members.push(Member { name: line.name.to_owned(), kind: found, count: line.count });
        }
        self.places.insert(kind.to_owned(), place);
        let are_sizeless = |ros: usize| {
            members.iter().all(|member| match (member.count, member.kind) {
                (Count::Fixed(0), _) => true,
                (Count::One | Count::Fixed(_), Kind::Message(inner)) => {
                    self.messages[inner].is_sizeless[ros]
                }
                _ => false,
            })
        };
        // ROS 2 writes a byte where a message has no members.
        let is_sizeless = [are_sizeless(0), are_sizeless(1) && !members.is_empty()];
        self.messages[place].members = members;
        self.messages[place].is_sizeless = is_sizeless;
        Ok(place)
    }
}
