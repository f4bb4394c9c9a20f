//! `.mcap` files, read as a stream of records.
//!
//! A file is a list of records: operation code (1 byte), length of the content (8 bytes), content.
//! Chunks hold records too, compressed or not, with a CRC. A chunk that is damaged is dropped as a
//! whole. Where records end before the end of the file says so, all that stands before is used, and
//! so is the readable part of the chunk that is cut.
//!
//! # Sources
//! The MCAP format specification, sections "Records" and "Chunk".

use super::mcap_chunk::{Chunks, Decompressed};
use super::part::Part;
use super::ros1_record::split_sized;
use super::stream::{EARLY_END, MAX_SIZE, Stream, without_topic};
use super::topic::Topic;
use super::visitor::Visitor;
use crate::Error;
use crate::recording::Warning;
use mcap::records::op;
use std::collections::HashMap;

/// Operation code and length of a record.
const HEAD_SIZE: usize = 9;

/// Topics by the ids that the file gives them.
#[derive(Default)]
struct Channels {
    kinds: HashMap<u16, String>,
    topics: HashMap<u16, (Topic, bool)>,
}

/// What was read of a file.
#[derive(Default)]
struct Progress {
    messages: u64,
    /// Messages whose channel no record describes.
    unknown: u64,
}

/// Shows the messages of a file; warnings say where it is damaged.
///
/// # Errors
/// [`Error::Unreadable`]; [`Error::Bag`] when the file does not start as a `.mcap` does.
pub(super) fn scan(part: &Part, visitor: &mut dyn Visitor) -> Result<Vec<Warning>, Error> {
    let mut records = Records::open(part)?;
    let mut channels = Channels::default();
    let mut chunks = Chunks::default();
    let mut progress = Progress::default();
    let problem = loop {
        let (opcode, data) = match records.next(is_wanted)? {
            Next::Record(opcode, data) => (opcode, data),
            Next::Cut(op::CHUNK, data) => {
                if let Some(records) = chunks.cut(data) {
                    show_all(records, &mut channels, visitor, &mut progress);
                }
                break Some(EARLY_END.to_owned());
            }
            Next::Cut(..) => break Some(EARLY_END.to_owned()),
            Next::TooLong(opcode, length) => {
                break Some(format!(
                    "a record of kind {opcode:#04x} and {length} bytes is damaged"
                ));
            }
            Next::End => break None,
        };
        if opcode != op::CHUNK {
            if let Err(problem) = take(opcode, data, &mut channels, visitor, &mut progress) {
                break Some(problem);
            }
            continue;
        }
        match chunks.whole(data) {
            Decompressed::Records(records) => {
                if let Some(problem) = show_all(records, &mut channels, visitor, &mut progress) {
                    chunks.dropped.note(problem);
                }
            }
            // What a dropped chunk says of its channels stands at the end of the file again.
            Decompressed::Dropped { is_first: true } => learn_all(part, &mut channels, visitor)?,
            Decompressed::Dropped { is_first: false } => {}
        }
    };
    let path = part.path().to_owned();
    let mut warnings: Vec<Warning> = chunks.dropped.warning(&path).into_iter().collect();
    if let (Some(message), true) = (&problem, channels.topics.is_empty()) {
        return Err(Error::Bag { path, message: message.clone() });
    }
    warnings.extend(without_topic(&path, progress.unknown));
    let messages = progress.messages;
    warnings.extend(problem.map(|message| Warning::Damaged { path, message, messages }));
    Ok(warnings)
}

/// Kinds of records that are read; others are passed over.
fn is_wanted(opcode: u8) -> bool {
    matches!(opcode, op::SCHEMA | op::CHANNEL | op::MESSAGE | op::CHUNK)
}

/// The schemas and channels that stand outside the chunks of a file.
fn learn_all(part: &Part, channels: &mut Channels, visitor: &mut dyn Visitor) -> Result<(), Error> {
    let mut records = Records::open(part)?;
    let is_wanted = |opcode| matches!(opcode, op::SCHEMA | op::CHANNEL);
    while let Next::Record(opcode, data) = records.next(is_wanted)? {
        // A damaged one is told where the records are read for their messages.
        let _ = channels.learn(opcode, data, visitor);
    }
    Ok(())
}

/// Shows the records of a chunk; what is wrong, where they end before the chunk does.
fn show_all(
    mut records: &[u8],
    channels: &mut Channels,
    visitor: &mut dyn Visitor,
    progress: &mut Progress,
) -> Option<String> {
    while let Some((head, rest)) = records.split_first_chunk::<HEAD_SIZE>() {
        let (opcode, length) = opcode_and_length(*head);
        let Some((data, rest)) = rest.split_at_checked(usize::try_from(length).ok()?) else {
            return Some("a record in it is longer than the chunk".to_owned());
        };
        if let Err(problem) = take(opcode, data, channels, visitor, progress) {
            return Some(problem);
        }
        records = rest;
    }
    (!records.is_empty()).then(|| "it ends within a record".to_owned())
}

/// Takes a record that is no chunk.
fn take(
    opcode: u8,
    data: &[u8],
    channels: &mut Channels,
    visitor: &mut dyn Visitor,
    progress: &mut Progress,
) -> Result<(), String> {
    if opcode == op::MESSAGE {
        if show(data, channels, visitor) {
            progress.messages += 1;
        } else {
            progress.unknown += 1;
        }
        return Ok(());
    }
    channels.learn(opcode, data, visitor).map_err(str::to_owned)
}

/// Shows a message record, whose layout is: channel (2 bytes), sequence (4), log time (8),
/// publish time (8), payload. False where its topic is unknown.
fn show(record: &[u8], channels: &Channels, visitor: &mut dyn Visitor) -> bool {
    let Some((head, payload)) = record.split_at_checked(22) else { return false };
    let channel = u16::from_le_bytes([head[0], head[1]]);
    let Some((topic, wanted)) = channels.topics.get(&channel) else { return false };
    if *wanted {
        let mut log_time = [0; 8];
        log_time.copy_from_slice(&head[6..14]);
        visitor.message(topic, u64::from_le_bytes(log_time).cast_signed(), payload);
    }
    true
}

impl Channels {
    /// Takes note of schemas and channels. Their layouts are: id (2 bytes), name, encoding,
    /// definition; id (2), id of the schema (2), topic, encoding, further texts.
    fn learn(
        &mut self,
        opcode: u8,
        data: &[u8],
        visitor: &mut dyn Visitor,
    ) -> Result<(), &'static str> {
        if opcode == op::SCHEMA {
            let schema = id(data).and_then(|(id, rest)| {
                let (name, rest) = text(rest)?;
                let (encoding, rest) = text(rest)?;
                let (definition, _) = split_sized(rest)?;
                Some((id, name, encoding, definition))
            });
            let (id, name, encoding, definition) = schema.ok_or("a schema is damaged")?;
            if ["ros2msg", "ros1msg"].contains(&encoding) {
                visitor.defines(name, &String::from_utf8_lossy(definition));
            }
            self.kinds.insert(id, name.to_owned());
        } else if opcode == op::CHANNEL {
            let channel = id(data).and_then(|(channel, rest)| {
                let (schema, rest) = id(rest)?;
                let (name, rest) = text(rest)?;
                let (encoding, _) = text(rest)?;
                Some((channel, schema, name, encoding))
            });
            let (channel, schema, name, encoding) = channel.ok_or("a channel is damaged")?;
            if !self.topics.contains_key(&channel) {
                let topic = Topic {
                    name: name.to_owned(),
                    kind: self.kinds.get(&schema).cloned().unwrap_or_default(),
                    encoding: encoding.to_owned(),
                };
                let wanted = visitor.wants(&topic);
                self.topics.insert(channel, (topic, wanted));
            }
        }
        Ok(())
    }
}

/// A number of a schema or a channel, and the rest.
fn id(bytes: &[u8]) -> Option<(u16, &[u8])> {
    let (id, rest) = bytes.split_first_chunk::<2>()?;
    Some((u16::from_le_bytes(*id), rest))
}

/// A text after its length, and the rest.
fn text(bytes: &[u8]) -> Option<(&str, &[u8])> {
    let (text, rest) = split_sized(bytes)?;
    Some((std::str::from_utf8(text).ok()?, rest))
}

/// The records of a file, one after the other.
struct Records {
    file: Stream,
    content: Vec<u8>,
    is_at_end: bool,
}

/// What follows in a file.
enum Next<'a> {
    /// Operation code and content.
    Record(u8, &'a [u8]),
    /// Operation code and what there is of the content of a record at which the file ends.
    Cut(u8, &'a [u8]),
    /// Operation code and length of a record that cannot be.
    TooLong(u8, u64),
    /// The end, as it should be.
    End,
}

impl Records {
    /// A file after its magic bytes.
    fn open(part: &Part) -> Result<Self, Error> {
        let mut file = Stream::open(part)?;
        if file.bytes()?.is_none_or(|magic: [u8; mcap::MAGIC.len()]| magic != mcap::MAGIC) {
            let message = "it does not start as a .mcap file does".to_owned();
            return Err(Error::Bag { path: part.path().to_owned(), message });
        }
        Ok(Self { file, content: Vec::new(), is_at_end: false })
    }

    /// The next record of a kind that is wanted.
    fn next(&mut self, is_wanted: impl Fn(u8) -> bool) -> Result<Next<'_>, Error> {
        loop {
            if self.is_at_end {
                let size = mcap::MAGIC.len() as u64;
                let is_whole =
                    self.file.fill(&mut self.content, size)? && self.content == mcap::MAGIC;
                return Ok(if is_whole { Next::End } else { Next::Cut(op::FOOTER, &[]) });
            }
            let Some(head) = self.file.bytes()? else { return Ok(Next::Cut(op::FOOTER, &[])) };
            let (opcode, length) = opcode_and_length(head);
            self.is_at_end = opcode == op::FOOTER;
            if !is_wanted(opcode) {
                if self.file.skip(length)? {
                    continue;
                }
                return Ok(Next::Cut(opcode, &[]));
            }
            if length > MAX_SIZE {
                return Ok(Next::TooLong(opcode, length));
            }
            let is_whole = self.file.fill(&mut self.content, length)?;
            let next = if is_whole { Next::Record } else { Next::Cut };
            return Ok(next(opcode, &self.content));
        }
    }
}

/// The parts of the head of a record.
fn opcode_and_length([opcode, length @ ..]: [u8; HEAD_SIZE]) -> (u8, u64) {
    (opcode, u64::from_le_bytes(length))
}

#[cfg(test)]
mod tests {
    use super::*;

    struct All;

    impl Visitor for All {
        fn wants(&mut self, _: &Topic) -> bool {
            true
        }

        fn message(&mut self, _: &Topic, _: i64, _: &[u8]) {}
    }

    /// Memory for a text is taken by the bytes that are there, not by those that it claims.
    #[test]
    fn texts_that_are_longer_than_their_record_are_damage() {
        let count = |count: usize| u32::try_from(count).expect("few").to_le_bytes();
        let text = |text: &str| [&count(text.len())[..], text.as_bytes()].concat();
        let schema = [&[3, 0][..], &text("sensor_msgs/msg/Imu"), &text("ros2msg"), &text("")];
        let channel = [&[7, 0, 3, 0][..], &text("/imu"), &text("cdr"), &text("")];
        let (schema, channel) = (schema.concat(), channel.concat());
        let mut channels = Channels::default();
        for (opcode, place, whole) in [(op::SCHEMA, 2, &schema), (op::CHANNEL, 4, &channel)] {
            let mut claiming = whole.clone();
            claiming[place..place + 4].copy_from_slice(&u32::MAX.to_le_bytes());
            assert!(channels.learn(opcode, &claiming, &mut All).is_err());
            assert!(channels.learn(opcode, &whole[..whole.len() - 5], &mut All).is_err());
            assert!(channels.learn(opcode, &[], &mut All).is_err());
            assert_eq!(channels.learn(opcode, whole, &mut All), Ok(()));
        }
        let topic = &channels.topics[&7].0;
        let found = [&topic.name, &topic.kind, &topic.encoding].map(String::as_str);
        assert_eq!(found, ["/imu", "sensor_msgs/msg/Imu", "cdr"]);
    }
}
