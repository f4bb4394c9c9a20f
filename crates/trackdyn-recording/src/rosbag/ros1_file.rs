//! `.bag` files of ROS 1, format 2.0, read as a stream of records.
//!
//! The index at the end is not needed: a bag whose recorder was stopped early is read as far as it
//! goes. It tells whether the bag was closed. A chunk that does not decompress is left out as a
//! whole.

use super::part::Part;
use super::ros1_record::{Fields, decompress, nanoseconds, op, split_sized};
use super::stream::{Dropped, EARLY_END, MAX_SIZE, Stream, without_topic};
use super::topic::Topic;
use super::visitor::Visitor;
use crate::Error;
use crate::recording::Warning;
use std::collections::HashMap;

/// How a bag begins.
const MAGIC: [u8; 13] = *b"#ROSBAG V2.0\n";

/// What was read of a bag.
struct Reader<'a> {
    visitor: &'a mut dyn Visitor,
    /// Topics by the numbers of their connections.
    topics: HashMap<u32, (Topic, bool)>,
    messages: u64,
    /// Messages whose connection no record describes.
    unknown: u64,
    dropped: Dropped,
    /// Earliest and latest message of the chunk read last, if that was left out, ns.
    missing: Option<(u64, u64)>,
}

/// Shows the messages of a bag; warnings say where it is damaged.
///
/// # Errors
/// [`Error::Unreadable`]; [`Error::Bag`] when the file is no bag of ROS 1 of this format.
pub(super) fn scan(part: &Part, visitor: &mut dyn Visitor) -> Result<Vec<Warning>, Error> {
    let path = part.path().to_owned();
    let mut reader = Reader {
        visitor,
        topics: HashMap::new(),
        messages: 0,
        unknown: 0,
        dropped: Dropped::default(),
        missing: None,
    };
    let problem = reader.read(part)?;
    reader.close_chunk();
    if let (Some(message), true) = (&problem, reader.topics.is_empty()) {
        return Err(Error::Bag { path, message: message.clone() });
    }
    let mut warnings: Vec<Warning> = reader.dropped.warning(&path).into_iter().collect();
    warnings.extend(without_topic(&path, reader.unknown));
    let messages = reader.messages;
    warnings.extend(problem.map(|message| Warning::Damaged { path, message, messages }));
    Ok(warnings)
}

impl Reader<'_> {
    /// Reads all records; what is wrong, where they do not end as they should.
    fn read(&mut self, part: &Part) -> Result<Option<String>, Error> {
        let mut records = Records::open(part)?;
        let mut content = Vec::new();
        let (mut chunks, mut listed) = (0_u64, 0_u64);
        loop {
            let is_missed = self.missing.is_some();
            let is_wanted = |op| is_wanted(op) || (op == op::INDEX && is_missed);
            match records.next(is_wanted)? {
                Next::Record(op::CHUNK) => {
                    chunks += 1;
                    let dropped = self.dropped.chunks;
                    self.take_chunk(records.fields(), &records.data, true, &mut content);
                    // What a dropped chunk says of its topics stands at the end of the bag again.
                    if dropped == 0 && self.dropped.chunks > 0 {
                        self.learn_all(part)?;
                    }
                }
                Next::Record(op::INDEX) => self.note_missing(&records.data),
                Next::Record(op::CHUNK_INFO) => listed += 1,
                Next::Record(op) => self.take(op, records.fields(), &records.data),
                Next::Cut(op) => {
                    if op == op::CHUNK {
                        self.take_chunk(records.fields(), &records.data, false, &mut content);
                    }
                    return Ok(Some(EARLY_END.to_owned()));
                }
                Next::Damaged(problem) => return Ok(Some(problem)),
                Next::End if listed < chunks => {
                    return Ok(Some("it was not closed (rosbag reindex)".to_owned()));
                }
                Next::End => return Ok(None),
            }
        }
    }

    /// Takes the connections that stand outside the chunks of a bag.
    fn learn_all(&mut self, part: &Part) -> Result<(), Error> {
        let mut records = Records::open(part)?;
        while let Next::Record(op) = records.next(|op| op == op::CONNECTION)? {
            self.take(op, records.fields(), &records.data);
        }
        Ok(())
    }

    /// Shows the records of a chunk, of one that is cut as far as they go.
    fn take_chunk(&mut self, head: Fields, data: &[u8], is_whole: bool, records: &mut Vec<u8>) {
        self.close_chunk();
        if let Err(problem) = decompress(head, data, records)
            && is_whole
        {
            self.dropped.note(problem);
            self.missing = Some((u64::MAX, 0));
            return;
        }
        let mut rest = records.as_slice();
        while let Some((head, after)) = split_sized(rest) {
            let Some((data, after)) = split_sized(after) else { break };
            let fields = Fields(head);
            let Some(op) = fields.op() else { break };
            self.take(op, fields, data);
            rest = after;
        }
        if is_whole && !rest.is_empty() {
            self.dropped.note("a record in it is damaged".to_owned());
        }
    }

    /// Takes a connection or a message.
    fn take(&mut self, op: u8, head: Fields, data: &[u8]) {
        let Some(connection) = head.u32("conn") else { return };
        if op == op::CONNECTION {
            if let (Some(name), Some(kind)) = (head.text("topic"), Fields(data).text("type")) {
                let topic = Topic { name, kind, encoding: "ros1".to_owned() };
                self.topics.entry(connection).or_insert_with(|| {
                    if let Some(text) = Fields(data).text("message_definition") {
                        self.visitor.defines(&topic.kind, &text);
                    }
                    let wanted = self.visitor.wants(&topic);
                    (topic, wanted)
                });
            }
        } else if op == op::MESSAGE {
            let Some((topic, wanted)) = self.topics.get(&connection) else {
                self.unknown += 1;
                return;
            };
            self.messages += 1;
            if *wanted {
                let time = head.time("time").unwrap_or_default().cast_signed();
                self.visitor.message(topic, time, data);
            }
        }
    }

    /// Takes note of the times of messages in a chunk that is left out: time (8 bytes), offset (4).
    fn note_missing(&mut self, index: &[u8]) {
        let Some((first, last)) = &mut self.missing else { return };
        for time in index.chunks_exact(12).filter_map(nanoseconds) {
            (*first, *last) = ((*first).min(time), (*last).max(time));
        }
    }

    /// Adds the time of a chunk that was left out, once its index is read.
    fn close_chunk(&mut self) {
        if let Some((first, last)) = self.missing.take() {
            self.dropped.add_time(first, last);
        }
    }
}

/// Kinds of records that are read of any bag; others are passed over.
fn is_wanted(op: u8) -> bool {
    matches!(op, op::MESSAGE | op::CHUNK | op::CONNECTION | op::CHUNK_INFO)
}

/// The records of a bag outside its chunks, and the chunks, one after the other.
struct Records {
    file: Stream,
    head: Vec<u8>,
    data: Vec<u8>,
}

/// What follows in a bag; its content stands in [`Records`].
enum Next {
    Record(u8),
    /// A record at which the file ends.
    Cut(u8),
    /// Why nothing can be read from here on.
    Damaged(String),
    End,
}

impl Records {
    /// A bag after its magic bytes.
    fn open(part: &Part) -> Result<Self, Error> {
        let mut file = Stream::open(part)?;
        if file.bytes()? != Some(MAGIC) {
            let message = "it is no bag of ROS 1, format 2.0 (rosbag fix converts older ones)";
            return Err(Error::Bag { path: part.path().to_owned(), message: message.to_owned() });
        }
        Ok(Self { file, head: Vec::new(), data: Vec::new() })
    }

    fn fields(&self) -> Fields<'_> {
        Fields(&self.head)
    }

    /// Goes to the next record of a kind that is wanted.
    fn next(&mut self, is_wanted: impl Fn(u8) -> bool) -> Result<Next, Error> {
        loop {
            if !self.file.fill(&mut self.data, 4)? {
                return Ok(if self.data.is_empty() { Next::End } else { Next::Cut(0) });
            }
            let length = self.data.iter().rev().fold(0, |sum, byte| sum << 8 | u64::from(*byte));
            if length > MAX_SIZE {
                return Ok(Next::Damaged(format!("a head of {length} bytes is damaged")));
            }
            let is_whole = self.file.fill(&mut self.head, length)?;
            let Some(length) = self.file.bytes()?.filter(|_| is_whole) else {
                return Ok(Next::Cut(0));
            };
            let length = u64::from(u32::from_le_bytes(length));
            let Some(op) = self.fields().op() else {
                return Ok(Next::Damaged("the head of a record is damaged".to_owned()));
            };
            if !is_wanted(op) {
                if self.file.skip(length)? {
                    continue;
                }
                return Ok(Next::Cut(op));
            }
            if length > MAX_SIZE {
                return Ok(Next::Damaged(format!("a record of {length} bytes is damaged")));
            }
            let is_whole = self.file.fill(&mut self.data, length)?;
            return Ok(if is_whole { Next::Record(op) } else { Next::Cut(op) });
        }
    }
}
