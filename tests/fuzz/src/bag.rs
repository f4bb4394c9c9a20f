//! Bags that are written as they should be, and then damaged.

use crate::damage::Damage;
use crate::drive::{Drive, Sent, Topic};
use crate::encoder::Ros;
use crate::files;
use crate::reading::Wanted;
use arbitrary::Arbitrary;
use mcap::records::MessageHeader;
use rusqlite::Connection;
use rusqlite::types::Value;
use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::PathBuf;

/// A bag, what is wrong with it, and how it is read.
#[derive(Arbitrary, Clone, Debug)]
pub struct Bag {
    /// How it is read.
    pub wanted: Wanted,
    packing: Packing,
    damage: Damage,
    /// Further rows of a database.
    rows: Vec<Row>,
    drive: Drive,
}

/// How messages are packed.
#[derive(Arbitrary, Clone, Copy, Debug, PartialEq)]
enum Packing {
    None,
    Chunks,
    Zstd,
    Lz4,
}

/// A row of a database as no recorder writes it.
#[derive(Arbitrary, Clone, Debug)]
struct Row {
    table: Table,
    cells: [Cell; 3],
}

#[derive(Arbitrary, Clone, Copy, Debug)]
enum Table {
    Topics,
    Messages,
    Definitions,
}

#[derive(Arbitrary, Clone, Debug)]
enum Cell {
    Null,
    Integer(i64),
    Real(f64),
    Text(String),
    Blob(Vec<u8>),
}

impl Bag {
    /// A `.mcap` file.
    ///
    /// # Panics
    /// Where it cannot be written.
    pub fn mcap(&self) -> PathBuf {
        let mut bytes = self.mcap_bytes().expect("an mcap file");
        self.damage.apply(&mut bytes);
        files::file("written.mcap", &bytes)
    }

    fn mcap_bytes(&self) -> mcap::McapResult<Vec<u8>> {
        let (topics, messages) = self.drive.messages(Ros::Two);
        let compression = match self.packing {
            Packing::None | Packing::Chunks => None,
            Packing::Zstd => Some(mcap::Compression::Zstd),
            Packing::Lz4 => Some(mcap::Compression::Lz4),
        };
        // Without checksums the damage is seen by what reads on.
        let options = mcap::WriteOptions::new()
            .compression(compression)
            .use_chunks(self.packing != Packing::None)
            .chunk_size(Some(2048))
            .calculate_chunk_crcs(false)
            .calculate_data_section_crc(false)
            .calculate_summary_section_crc(false);
        let mut writer = options.create(Cursor::new(Vec::new()))?;
        let mut channels = Vec::new();
        for Topic { name, kind, definition } in &topics {
            let kind = kind.join("/msg/");
            let schema = writer.add_schema(&kind, "ros2msg", definition.as_bytes())?;
            channels.push(writer.add_channel(schema, name, "cdr", &BTreeMap::new())?);
        }
        for (sequence, Sent { topic, log, payload }) in (0..).zip(messages) {
            let channel_id = channels[topic];
            let header = MessageHeader { channel_id, sequence, log_time: log, publish_time: log };
            writer.write_to_known_channel(&header, &payload)?;
        }
        writer.finish()?;
        Ok(writer.into_inner().into_inner())
    }

    /// A `.db3` file.
    ///
    /// # Panics
    /// Where it cannot be written.
    pub fn db3(&self) -> PathBuf {
        let path = files::no_file("written.db3");
        self.write_db3(&path).expect("a database");
        let mut bytes = std::fs::read(&path).expect("bytes");
        self.damage.apply(&mut bytes);
        files::file("written.db3", &bytes)
    }

    fn write_db3(&self, path: &PathBuf) -> rusqlite::Result<()> {
        let mut connection = Connection::open(path)?;
        connection.execute_batch(
            "PRAGMA page_size = 512; PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF;
            CREATE TABLE topics(id INTEGER PRIMARY KEY, name, type, serialization_format);
            CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, data);
            CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type, encoding,
                encoded_message_definition);",
        )?;
        let all = connection.transaction()?;
        let (topics, messages) = self.drive.messages(Ros::Two);
        for (id, Topic { name, kind, definition }) in (1_i64..).zip(&topics) {
            let kind = kind.join("/msg/");
            all.execute("INSERT INTO topics VALUES(?1, ?2, ?3, 'cdr')", (id, name, &kind))?;
            let defined = "INSERT INTO message_definitions VALUES(?1, ?2, 'ros2msg', ?3)";
            all.execute(defined, (id, kind, definition))?;
        }
        {
            let mut insert = all.prepare("INSERT INTO messages VALUES(NULL, ?1, ?2, ?3)")?;
            for Sent { topic, log, payload } in messages {
                insert.execute((topic + 1, log.cast_signed(), payload))?;
            }
        }
        for Row { table, cells } in self.rows.iter().take(8) {
            let table = match table {
                Table::Topics => "topics",
                Table::Messages => "messages",
                Table::Definitions => "message_definitions",
            };
            let insert = format!("INSERT INTO {table} VALUES(NULL, ?1, ?2, ?3)");
            all.execute(&insert, cells.clone().map(Value::from))?;
        }
        all.commit()
    }

    /// A `.bag` file.
    ///
    /// # Panics
    /// Where it cannot be written.
    pub fn ros1(&self) -> PathBuf {
        let mut bytes = self.ros1_bytes();
        self.damage.apply(&mut bytes);
        files::file("written.bag", &bytes)
    }

    fn ros1_bytes(&self) -> Vec<u8> {
        let (topics, messages) = self.drive.messages(Ros::One);
        let mut connections = Vec::new();
        for (id, Topic { name, kind, definition }) in (0_u32..).zip(&topics) {
            let kind = kind.join("/");
            let told =
                fields(&[("type", kind.as_bytes()), ("message_definition", definition.as_bytes())]);
            let head = [("conn", &id.to_le_bytes()[..]), ("topic", name.as_bytes())];
            connections.extend(record(7, &head, &told));
        }
        let mut sent = connections.clone();
        for Sent { topic, log, payload } in messages {
            let conn = count(topic);
            let [seconds, rest] = [log / 1_000_000_000, log % 1_000_000_000];
            let time = [&seconds.to_le_bytes()[..4], &rest.to_le_bytes()[..4]].concat();
            sent.extend(record(2, &[("conn", &conn), ("time", &time)], &payload));
        }
        let head = record(3, &[("index_pos", &[0; 8])], &[]);
        let magic = &b"#ROSBAG V2.0\n"[..];
        if self.packing == Packing::None {
            return [magic, &head, &sent].concat();
        }
        let size = count(sent.len());
        let chunk = record(5, &[("compression", b"none"), ("size", &size)], &sent);
        let listed = record(6, &[("ver", &[1, 0, 0, 0])], &[]);
        [magic, &head, &chunk, &connections, &listed].concat()
    }
}

impl From<Cell> for Value {
    fn from(cell: Cell) -> Self {
        match cell {
            Cell::Null => Self::Null,
            Cell::Integer(value) => Self::Integer(value),
            Cell::Real(value) => Self::Real(value),
            Cell::Text(value) => Self::Text(value),
            Cell::Blob(value) => Self::Blob(value),
        }
    }
}

/// A number of four bytes.
fn count(count: usize) -> [u8; 4] {
    u32::try_from(count).expect("few").to_le_bytes()
}

/// Bytes after their length.
fn sized(bytes: &[u8]) -> Vec<u8> {
    [&count(bytes.len())[..], bytes].concat()
}

fn fields(fields: &[(&str, &[u8])]) -> Vec<u8> {
    let field = |(name, value): &(&str, &[u8])| sized(&[name.as_bytes(), b"=", value].concat());
    fields.iter().flat_map(field).collect()
}

/// A record of ROS 1.
fn record(op: u8, head: &[(&str, &[u8])], data: &[u8]) -> Vec<u8> {
    let head = [fields(&[("op", &[op])]), fields(head)].concat();
    [sized(&head), sized(data)].concat()
}
