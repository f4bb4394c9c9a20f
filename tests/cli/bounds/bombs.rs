//! Bags that unpack to far more than they are, or whose rows are computed without end.

use super::{Case, check, prepared};
use crate::Workplace;
use rusqlite::Connection;
use std::io::Write;

/// A record of a `.mcap` file.
fn record(opcode: u8, content: &[u8]) -> Vec<u8> {
    [&[opcode][..], &(content.len() as u64).to_le_bytes(), content].concat()
}

fn text(text: &str) -> Vec<u8> {
    sized(text.as_bytes())
}

/// Bytes after their length.
fn sized(bytes: &[u8]) -> Vec<u8> {
    [&u32::try_from(bytes.len()).expect("few").to_le_bytes()[..], bytes].concat()
}

/// A chunk that says that it holds so many bytes.
fn chunk(size: u64, compression: &str, packed: &[u8]) -> Vec<u8> {
    let content = [
        &[0; 16][..],
        &size.to_le_bytes(),
        &[0; 4],
        &text(compression),
        &(packed.len() as u64).to_le_bytes(),
        packed,
    ];
    record(6, &content.concat())
}

/// A topic of joint states, called so.
fn topic(name: &str) -> Vec<u8> {
    let schema = [&[1, 0][..], &text("sensor_msgs/msg/JointState"), &text("ros2msg"), &text("")];
    let channel = [&[1, 0, 1, 0][..], &text(name), &text("cdr"), &text("")];
    [record(3, &schema.concat()), record(4, &channel.concat())].concat()
}

/// A message of the topic.
fn message(payload: &[u8]) -> Vec<u8> {
    record(5, &[&[1, 0][..], &[0; 20], payload].concat())
}

fn bag(records: &[Vec<u8>]) -> Vec<u8> {
    [mcap::MAGIC, &records.concat(), mcap::MAGIC].concat()
}

fn write(place: &Workplace, name: &str, bytes: &[u8]) {
    std::fs::write(place.path().join(name), bytes).expect("written");
}

/// So many zeros, packed piece by piece.
fn zeros(count: usize) -> Vec<u8> {
    let mut packed = zstd::stream::Encoder::new(Vec::new(), 1).expect("an encoder");
    let piece = vec![0; 1 << 20];
    for _ in 0..count >> 20 {
        packed.write_all(&piece).expect("packed");
    }
    packed.finish().expect("packed")
}

#[test]
fn mcap() {
    let place = prepared();
    let packed = zeros(1 << 30);
    let size = 1 << 30;
    let joints = topic("/joint_states");
    write(&place, "zstd.mcap", &bag(&[joints.clone(), chunk(size, "zstd", &packed)]));
    write(&place, "less.mcap", &bag(&[joints.clone(), chunk(1000, "zstd", &packed)]));
    write(&place, "more.mcap", &bag(&[joints.clone(), chunk(u64::MAX, "zstd", &packed)]));
    write(&place, "lz4.mcap", &bag(&[joints.clone(), chunk(size, "lz4", &packed)]));
    write(&place, "none.mcap", &bag(&[joints.clone(), chunk(size, "", &[0; 100])]));
    write(&place, "message.mcap", &bag(&[joints.clone(), message(&packed)]));
    // a list of 2³¹ names
    let list = [&[0, 1, 0, 0][..], &[0; 8], &text("a\0"), &[0, 0, 0], &[0, 0, 0, 0x80]].concat();
    write(&place, "list.mcap", &bag(&[joints.clone(), message(&list)]));
    // a schema whose name claims 4 GB
    let name = record(3, &[&[1, 0][..], &u32::MAX.to_le_bytes(), b"name"].concat());
    write(&place, "name.mcap", &bag(&[joints.clone(), name]));
    // a record of 2⁶³ bytes, and a file that ends within a chunk
    let endless = [&[5][..], &(1_u64 << 63).to_le_bytes()].concat();
    write(&place, "record.mcap", &bag(&[joints.clone(), endless]));
    let cut = bag(&[joints.clone(), chunk(size, "zstd", &packed)]);
    write(&place, "cut.mcap", &cut[..cut.len() - 20]);
    write(&place, "file.mcap.zstd", &packed);
    write(&place, "file.db3.zstd", &packed);
    write(&place, "file.bag.zst", &packed);
    let escape = "\u{1b}[2J\u{202e}";
    write(&place, "topic.mcap", &bag(&[topic(escape), message(&list)]));
    let names = [
        "zstd.mcap",
        "less.mcap",
        "more.mcap",
        "lz4.mcap",
        "none.mcap",
        "message.mcap",
        "list.mcap",
        "name.mcap",
        "record.mcap",
        "cut.mcap",
        "file.mcap.zstd",
        "file.db3.zstd",
        "file.bag.zst",
        "topic.mcap",
    ];
    let mut all: Vec<Case> = Vec::new();
    for name in names {
        let inspect = format!("inspect {name}");
        // What is left out of a bag is a warning, and a bag in which nothing is left has no tracks.
        all.push(Case::ended(inspect));
        all.push(Case::refused(format!("odometry {name} --gauge 0.5"), &[name]));
    }
    check(&place, &all);
}

#[test]
fn ros1() {
    let place = prepared();
    let field = |name: &str, value: &[u8]| sized(&[name.as_bytes(), b"=", value].concat());
    let mut all = Vec::new();
    for (compression, size) in [("bz2", 1_u32 << 31), ("lz4", 1 << 31), ("none", u32::MAX)] {
        let head = [
            field("op", &[5]),
            field("compression", compression.as_bytes()),
            field("size", &size.to_le_bytes()),
        ];
        let records = [sized(&head.concat()), sized(&[0; 100])].concat();
        let name = format!("{compression}.bag");
        write(&place, &name, &[&b"#ROSBAG V2.0\n"[..], &records].concat());
        all.push(Case::ended(format!("inspect {name}")));
        all.push(Case::refused(format!("odometry {name} --gauge 0.5"), &[&name]));
    }
    check(&place, &all);
}

#[test]
fn sqlite() {
    const TOPICS: &str = "CREATE TABLE topics(id INTEGER PRIMARY KEY, name, type, \
        serialization_format); INSERT INTO topics VALUES \
        (1, '/joint_states', 'sensor_msgs/msg/JointState', 'cdr');";
    const ENDLESS_ROWS: &str = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n)";
    let place = prepared();
    let mut all = Vec::new();
    for (name, text) in [
        (
            "view.db3",
            format!(
                "{TOPICS} CREATE VIEW messages(id, topic_id, timestamp, data) AS {ENDLESS_ROWS} \
                 SELECT i, 1, i, zeroblob(100) FROM n;"
            ),
        ),
        (
            "topics.db3",
            format!(
                "CREATE VIEW topics(id, name, type, serialization_format) AS {ENDLESS_ROWS} \
                 SELECT i, '/a', 'b', 'cdr' FROM n; \
                 CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, data);"
            ),
        ),
        (
            "generated.db3",
            format!(
                "{TOPICS} CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, \
                 data AS (zeroblob(900000000))); \
                 INSERT INTO messages(topic_id, timestamp) VALUES (1, 1), (1, 2), (1, 3);"
            ),
        ),
        (
            "definitions.db3",
            format!(
                "{TOPICS} CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, \
                 data); CREATE VIEW message_definitions(topic_type, encoding, \
                 encoded_message_definition) AS {ENDLESS_ROWS} SELECT 'a', 'ros2msg', 'b' FROM n;"
            ),
        ),
    ] {
        let file = Connection::open(place.path().join(name)).expect("a database");
        file.execute_batch(&text).expect("tables");
        for command in ["inspect {}", "odometry {} --gauge 0.5"] {
            let arguments = command.replace("{}", name);
            all.push(Case::refused(arguments, &[name, "are computed: expected a table of rows"]));
        }
    }
    check(&place, &all);
}
