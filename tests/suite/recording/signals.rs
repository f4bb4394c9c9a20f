//! Track speeds from numbers in messages that are named by the path of their field.

use super::drives::{EPOCH, RADIUS, ns, poses, quaternion, speeds, times};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use trackdyn_core::PerSide;
use trackdyn_recording::rosbag::{self, RosbagOptions};
use trackdyn_recording::{Recording, SpeedUnit};
use trackdyn_tests::cdr::Message;

/// A message with all that a definition can have before the numbers.
const STATUS: &str = "# state of the drives
uint8 MODE_OFF = 0
string NAME=\"a # b\"
std_msgs/Header header
bool armed
string<=10 mode
uint8[3] cells
int16[<=4] temperatures
string[] faults
Pair[2] pairs
Empty nothing
Actuator[] actuators
float64 voltage 24.0";
const NESTED_DEFINITIONS: [(&str, &str); 3] = [
    ("my_msgs/Pair", "int8 a\nfloat32 b"),
    ("my_msgs/Empty", ""),
    ("my_msgs/Actuator", "string name\nint32 rpm\nfloat32 speed\nuint64 count"),
];
const KIND: &str = "my_msgs/msg/Status";

/// The definition as a bag has it.
fn definition() -> String {
    let rule = "=".repeat(80);
    let nested =
        NESTED_DEFINITIONS.iter().map(|(kind, text)| format!("\n{rule}\nMSG: {kind}\n{text}"));
    format!("{STATUS}{}", nested.collect::<String>())
}

/// A message at a time; the turns per minute are rounded to whole ones, and the wheels on the right
/// count backwards.
#[expect(clippy::cast_possible_truncation, reason = "wheels turn by less than 2³¹ a minute")]
fn status(t: f64) -> Message {
    let mut message = Message::new(EPOCH + ns(t), "base");
    message.bytes(1, &[1]);
    message.text("auto");
    message.bytes(1, &[1, 2, 3]);
    message.count(3);
    for temperature in [20_i16, 21, 22] {
        message.bytes(2, &temperature.to_le_bytes());
    }
    message.count(2);
    message.text("hot");
    message.text("");
    for _ in 0..2 {
        message.bytes(1, &[7]);
        message.bytes(4, &0.5_f32.to_le_bytes());
    }
    message.bytes(1, &[0]);
    message.count(2);
    let PerSide { left, right } = speeds(t);
    for (name, speed) in [("l", left), ("right", -right)] {
        message.text(name);
        message.bytes(4, &((speed * 60.0 / TAU).round() as i32).to_le_bytes());
        message.bytes(4, &((speed * RADIUS) as f32).to_le_bytes());
        message.bytes(8, &5_u64.to_le_bytes());
    }
    message.numbers(&[24.5]);
    message
}

/// Messages of the drive: topic, type, time of logging in s, content.
fn messages() -> Vec<(&'static str, &'static str, f64, Vec<u8>)> {
    let mut all: Vec<_> = times(50).map(|t| ("/status", KIND, t, status(t).0)).collect();
    for (t, pose) in poses() {
        let mut message = Message::new(EPOCH + ns(t), "map");
        message.numbers(&[pose.x, pose.y, 0.0]);
        message.numbers(&quaternion(pose.yaw));
        all.push(("/slam", "geometry_msgs/msg/PoseStamped", t, message.0));
    }
    all.sort_by(|a, b| a.2.total_cmp(&b.2));
    all
}

/// Writes the drive as `.mcap`, with this definition of the status.
fn mcap(folder: &Path, encoding: &str, definition: &str) -> PathBuf {
    let path = folder.join("drive.mcap");
    let file = std::io::BufWriter::new(std::fs::File::create(&path).expect("a file"));
    let mut writer = mcap::Writer::new(file).expect("a writer");
    let mut channels = BTreeMap::new();
    for (topic, kind, t, content) in messages() {
        let channel_id = *channels.entry(topic).or_insert_with(|| {
            let text = if kind == KIND { definition } else { "" };
            let schema = writer.add_schema(kind, encoding, text.as_bytes()).expect("a schema");
            writer.add_channel(schema, topic, "cdr", &BTreeMap::new()).expect("a channel")
        });
        let log_time = u64::try_from(EPOCH + ns(t)).expect("after 1970");
        let header = mcap::records::MessageHeader {
            channel_id,
            sequence: 0,
            log_time,
            publish_time: log_time,
        };
        writer.write_to_known_channel(&header, &content).expect("written");
    }
    writer.finish().expect("finished");
    path
}

/// Writes the drive as `.db3`, with a table of definitions.
fn db3(folder: &Path) -> PathBuf {
    let path = folder.join("drive.db3");
    let file = rusqlite::Connection::open(&path).expect("a database");
    let tables = "CREATE TABLE topics(id INTEGER PRIMARY KEY, name, type, serialization_format);
        CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, data);
        CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type, encoding,
            encoded_message_definition, type_description_hash);
        INSERT INTO topics VALUES(1, '/status', 'my_msgs/msg/Status', 'cdr');
        INSERT INTO topics VALUES(2, '/slam', 'geometry_msgs/msg/PoseStamped', 'cdr');";
    file.execute_batch(&format!("{tables} BEGIN")).expect("tables");
    let insert = "INSERT INTO message_definitions VALUES(1, ?1, 'ros2msg', ?2, '')";
    file.execute(insert, (KIND, definition())).expect("inserted");
    for (topic, _, t, content) in messages() {
        let id = if topic == "/status" { 1 } else { 2 };
        let insert = "INSERT INTO messages(topic_id, timestamp, data) VALUES(?1, ?2, ?3)";
        file.execute(insert, (id, EPOCH + ns(t), content)).expect("inserted");
    }
    file.execute_batch("COMMIT").expect("committed");
    path
}

fn options(left: &str, right: &str) -> RosbagOptions {
    RosbagOptions {
        left_signals: vec![left.to_owned()],
        right_signals: vec![right.to_owned()],
        wheel_radius: Some(RADIUS),
        ..RosbagOptions::default()
    }
}

/// Options for the turns per minute of the drive.
fn of_turns() -> RosbagOptions {
    let unit = Some(SpeedUnit::TurnsPerMinute);
    let named = options("/status:actuators[0].rpm", "-/status:actuators[1].rpm");
    RosbagOptions { speed_unit: unit, ..named }
}

/// Speeds are those of the drive within `near` m/s.
#[track_caller]
fn assert_speeds(recording: &Recording, near: f64) {
    let tracks = recording.runs()[0].tracks();
    assert_eq!(tracks.len(), times(50).count());
    for (row, t) in tracks.iter().zip(times(50)) {
        let truth = speeds(t).map(|speed| RADIUS * speed);
        let error = (row.v_left - truth.left).abs().max((row.v_right - truth.right).abs());
        assert!((row.t - t).abs() < 1e-6 && error <= near, "{row:?} instead of {truth:?}");
    }
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

#[test]
fn numbers_by_their_path_are_the_speeds_of_the_tracks() {
    let folder = folder();
    // half a turn per minute
    let rounding = 0.5 * TAU / 60.0 * RADIUS + 1e-9;
    for path in [mcap(folder.path(), "ros2msg", &definition()), db3(folder.path())] {
        assert_speeds(&rosbag::read(&path, &of_turns()).expect("readable"), rounding);
    }
    let path = folder.path().join("drive.mcap");
    let metres = RosbagOptions {
        speed_unit: Some(SpeedUnit::MetresPerSecond),
        wheel_radius: None,
        ..options("/status:actuators[0].speed", "-/status:actuators[1].speed")
    };
    assert_speeds(&rosbag::read(&path, &metres).expect("readable"), 1e-6);
}

#[test]
fn definitions_come_from_a_folder_where_a_bag_has_none() {
    let folder = folder();
    let path = mcap(folder.path(), "", "");
    let text = rosbag::read(&path, &of_turns()).map(drop).expect_err("unknown").to_string();
    assert!(text.contains("the definition of my_msgs/Status is not there"), "{text}");
    assert!(text.contains("--msg-dir DIR"), "{text}");
    let package = folder.path().join("src/my_msgs/msg");
    std::fs::create_dir_all(&package).expect("a folder");
    let main = [("my_msgs/Status", STATUS)];
    for (kind, text) in main.iter().chain(&NESTED_DEFINITIONS) {
        let name = kind.strip_prefix("my_msgs/").expect("of the package");
        std::fs::write(package.join(format!("{name}.msg")), text).expect("written");
    }
    let with = RosbagOptions { msg_dir: Some(folder.path().join("src")), ..of_turns() };
    assert_speeds(&rosbag::read(&path, &with).expect("readable"), 0.02);
}

#[test]
fn a_wrong_path_or_unit_says_what_is_expected() {
    let folder = folder();
    let path = mcap(folder.path(), "ros2msg", &definition());
    let refused = |options: &RosbagOptions| {
        rosbag::read(&path, options).map(drop).expect_err("refused").to_string()
    };
    let right = "/status:actuators[1].rpm";
    for (left, expected) in [
        ("/status:actuators[0].rmp", "expected one of name, rpm, speed, count"),
        ("/status:actuators.rpm", "actuators is an array: expected one of its elements"),
        ("/status:actuators[2].rpm", "actuators has 2 elements, and no actuators[2]"),
        ("/status:cells[3]", "cells[3] is not there: cells has 3 elements"),
        ("/status:actuators[0]", "is a message: expected one of its fields, name, rpm"),
        ("/status:actuators[0].name", "name is no number"),
        ("/status:voltage[0]", "voltage is no array"),
        ("/stats:voltage", "--left-signal /stats:voltage: no such topic"),
        ("/status", "expected TOPIC:FIELD, such as"),
        ("/status:actuators[x].rpm", "expected TOPIC:FIELD, such as"),
    ] {
        let text = refused(&options(left, right));
        assert!(text.contains(expected) && text.contains("--left-signal"), "{left}: {text}");
    }
    let alone = RosbagOptions { right_signals: Vec::new(), ..of_turns() };
    assert!(refused(&alone).contains("--right-signal TOPIC:FIELD is missing"));
    let unit = Some(SpeedUnit::MetresPerSecond);
    let text = refused(&RosbagOptions { speed_unit: unit, ..of_turns() });
    assert!(text.contains("those of the tracks already"), "{text}");
    let of_twist = RosbagOptions {
        twist_topic: Some("/twist".to_owned()),
        separation: Some(0.8),
        speed_unit: unit,
        ..RosbagOptions::default()
    };
    assert!(refused(&of_twist).contains("expected without --twist-topic"));
    // without them, the topics are named that may have them
    let text = refused(&RosbagOptions::default());
    assert!(text.contains(":FIELD --right-signal /"), "{text}");
    let text = refused(&RosbagOptions { wheel_radius: None, ..of_turns() });
    assert!(text.contains("--wheel-radius METRES"), "{text}");
    let both = RosbagOptions { left_joints: vec!["left".to_owned()], ..of_turns() };
    assert!(refused(&both).contains("--left-joint chooses other track speeds"));
    // the right side counts backwards
    let text = refused(&RosbagOptions { right_signals: vec![right.to_owned()], ..of_turns() });
    assert!(text.contains(&format!("--right-signal -{right}")), "{text}");
}

#[test]
fn messages_that_end_early_are_skipped_at_every_cut() {
    let mut whole = status(1.0).0;
    let path = folder();
    let file = path.path().join("cut.mcap");
    // one message for each cut, beside whole ones
    let writer = std::io::BufWriter::new(std::fs::File::create(&file).expect("a file"));
    let mut writer = mcap::Writer::new(writer).expect("a writer");
    let schema = writer.add_schema(KIND, "ros2msg", definition().as_bytes()).expect("a schema");
    let channel_id =
        writer.add_channel(schema, "/status", "cdr", &BTreeMap::new()).expect("a channel");
    let header =
        mcap::records::MessageHeader { channel_id, sequence: 0, log_time: 1, publish_time: 1 };
    // up to the end of the speeds of the second actuator
    whole.truncate(whole.len() - 8);
    let mut cuts = 0;
    for end in 0..whole.len() - 28 {
        writer.write_to_known_channel(&header, &whole[..end]).expect("written");
        cuts += 1;
    }
    writer.finish().expect("finished");
    let text = rosbag::read(&file, &of_turns()).map(drop).expect_err("refused").to_string();
    assert!(text.contains(&format!("none of {cuts} messages can be read")), "{text}");
}
