//! `.mcap` files, read as a stream.

use super::topic::Topic;
use super::visitor::Visitor;
use crate::Error;
use crate::recording::Warning;
use crate::table::unreadable;
use mcap::records::{Record, op};
use mcap::sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions};
use std::collections::HashMap;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

/// Bytes taken from the file at a time.
const READ_SIZE: usize = 1 << 20;

/// Largest size of a record, bytes: a longer one is damage.
const MAX_RECORD_SIZE: usize = 1 << 28;

/// Topics by the ids that the file gives them.
#[derive(Default)]
struct Channels {
    kinds: HashMap<u16, String>,
    topics: HashMap<u16, (Topic, bool)>,
}

/// Shows the messages of a file; a warning says where it is damaged.
///
/// # Errors
/// [`Error::Unreadable`]; [`Error::Bag`] when the file does not start as a `.mcap` does.
pub(super) fn scan(path: &Path, visitor: &mut dyn Visitor) -> Result<Option<Warning>, Error> {
    let mut file = File::open(path).map_err(|cause| unreadable(path, cause))?;
    let options = LinearReaderOptions::default()
        .with_validate_chunk_crcs(true)
        .with_record_length_limit(MAX_RECORD_SIZE);
    let mut reader = LinearReader::new_with_options(options);
    let mut channels = Channels::default();
    let (mut messages, mut has_begun) = (0, false);
    while let Some(event) = reader.next_event() {
        let problem = match event {
            Ok(LinearReadEvent::ReadRequest(least)) => {
                let target = reader.insert(least.max(READ_SIZE));
                let count =
                    read_some(&mut file, target).map_err(|cause| unreadable(path, cause))?;
                reader.notify_read(count);
                continue;
            }
            Ok(LinearReadEvent::Record { opcode: op::MESSAGE, data }) => {
                has_begun = true;
                messages += u64::from(show(data, &channels, visitor));
                continue;
            }
            Ok(LinearReadEvent::Record { opcode, data }) => {
                has_begun = true;
                match channels.learn(opcode, data, visitor) {
                    Ok(()) => continue,
                    Err(error) => error,
                }
            }
            Err(error) => error,
        };
        let message = problem.to_string();
        if !has_begun {
            return Err(Error::Bag { path: path.to_owned(), message });
        }
        return Ok(Some(Warning::Damaged { path: path.to_owned(), message, messages }));
    }
    Ok(None)
}

/// As much as the file gives at once, and again where a signal came between.
fn read_some(file: &mut File, target: &mut [u8]) -> std::io::Result<usize> {
    loop {
        match file.read(target) {
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            other => return other,
        }
    }
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
    /// Takes note of schemas and channels.
    fn learn(
        &mut self,
        opcode: u8,
        data: &[u8],
        visitor: &mut dyn Visitor,
    ) -> mcap::McapResult<()> {
        if !matches!(opcode, op::SCHEMA | op::CHANNEL) {
            return Ok(());
        }
        match mcap::parse_record(opcode, data)? {
            Record::Schema { header, .. } => {
                self.kinds.insert(header.id, header.name);
            }
            Record::Channel(channel) if !self.topics.contains_key(&channel.id) => {
                let topic = Topic {
                    name: channel.topic,
                    kind: self.kinds.get(&channel.schema_id).cloned().unwrap_or_default(),
                    encoding: channel.message_encoding,
                };
                let wanted = visitor.wants(&topic);
                self.topics.insert(channel.id, (topic, wanted));
            }
            _ => {}
        }
        Ok(())
    }
}
