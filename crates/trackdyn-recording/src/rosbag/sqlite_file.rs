//! `.db3` files: `SQLite` with the tables `topics` and `messages`.
//!
//! Nothing is left beside the user's file. It is opened as one that does not change: `SQLite` then
//! makes neither locks nor shared memory, which it could not in a folder without write permission.
//! Where a recorder that was stopped early left a write-ahead log or a rollback journal, the file
//! is read as a copy together with that, which `SQLite` merges into the copy.

use super::part::{OnDisk, Part};
use super::topic::Topic;
use super::visitor::Visitor;
use crate::Error;
use crate::recording::Warning;
use rusqlite::{Connection, OpenFlags, OptionalExtension};
use std::collections::HashMap;
use std::fmt::Write;
use std::path::Path;

/// What `SQLite` appends to the name of a database for files that hold a part of its content.
const COMPANIONS: [&str; 2] = ["-wal", "-journal"];

/// Shows the messages of a file; a warning says where it is damaged.
///
/// # Errors
/// [`Error::Bag`] when the file cannot be opened or its topics cannot be read.
pub(super) fn scan(part: &Part, visitor: &mut dyn Visitor) -> Result<Option<Warning>, Error> {
    let path = part.path();
    let refused =
        |error: rusqlite::Error| Error::Bag { path: path.to_owned(), message: error.to_string() };
    // The copy, if it is one, lives until the connection is closed.
    let file = part.on_disk(&COMPANIONS)?;
    let connection = connect(&file).map_err(refused)?;
    require_tables(&connection).map_err(|message| Error::Bag { path: path.to_owned(), message })?;
    let topics = topics(&connection).map_err(refused)?;
    // Bags before ROS 2 Jazzy have no such table.
    for (kind, text) in definitions(&connection).unwrap_or_default() {
        visitor.defines(&kind, &text);
    }
    let wanted: HashMap<i64, Topic> =
        topics.into_iter().filter(|(_, topic)| visitor.wants(topic)).collect();
    let mut messages = 0;
    Ok(show(&connection, &wanted, visitor, &mut messages).err().map(|error| Warning::Damaged {
        path: path.to_owned(),
        message: error.to_string(),
        messages,
    }))
}

fn connect(file: &OnDisk) -> rusqlite::Result<Connection> {
    if file.is_copy() {
        let flags = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
        return Connection::open_with_flags(&file.path, flags);
    }
    let flags = OpenFlags::SQLITE_OPEN_READ_ONLY
        | OpenFlags::SQLITE_OPEN_URI
        | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    Connection::open_with_flags(immutable(&file.path), flags)
}

/// The address of a file that does not change (<https://www.sqlite.org/uri.html>).
fn immutable(path: &Path) -> String {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let mut address = "file:".to_owned();
    let path = path.as_os_str().as_encoded_bytes();
    if !path.starts_with(b"/") {
        address.push('/');
    }
    for &byte in path {
        let byte = if cfg!(windows) && byte == b'\\' { b'/' } else { byte };
        if byte.is_ascii_alphanumeric() || b"/-_.~:".contains(&byte) {
            address.push(char::from(byte));
        } else {
            let _ = write!(address, "%{byte:02X}");
        }
    }
    address.push_str("?immutable=1");
    address
}

/// Refuses rows that a database computes instead of holding them: a view, a virtual table or a
/// generated column may have rows without end, or cells of any size.
fn require_tables(connection: &Connection) -> Result<(), String> {
    const COMPUTED_TABLES: &str = "SELECT name FROM sqlite_schema \
         WHERE lower(name) IN ('topics', 'messages', 'message_definitions') \
         AND type IN ('table', 'view') AND (type = 'view' OR rootpage = 0 OR EXISTS \
         (SELECT 1 FROM pragma_table_xinfo(sqlite_schema.name) WHERE hidden <> 0))";
    let found = connection.query_row(COMPUTED_TABLES, [], |row| row.get::<_, String>(0)).optional();
    match found.map_err(|error| error.to_string())? {
        None => Ok(()),
        Some(name) => Err(format!("the rows of {name} are computed: expected a table of rows")),
    }
}

fn topics(connection: &Connection) -> rusqlite::Result<Vec<(i64, Topic)>> {
    let mut statement = connection
        .prepare("SELECT id, name, type, serialization_format FROM topics ORDER BY id")?;
    let rows = statement.query_map([], |row| {
        Ok((row.get(0)?, Topic { name: row.get(1)?, kind: row.get(2)?, encoding: row.get(3)? }))
    })?;
    rows.collect()
}

/// Types and their definitions.
fn definitions(connection: &Connection) -> rusqlite::Result<Vec<(String, String)>> {
    let mut statement = connection.prepare(
        "SELECT topic_type, encoded_message_definition FROM message_definitions \
         WHERE encoding = 'ros2msg'",
    )?;
    let rows = statement.query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?;
    rows.collect()
}

fn show(
    connection: &Connection,
    wanted: &HashMap<i64, Topic>,
    visitor: &mut dyn Visitor,
    messages: &mut u64,
) -> rusqlite::Result<()> {
    let mut statement =
        connection.prepare("SELECT topic_id, timestamp, data FROM messages ORDER BY id")?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        *messages += 1;
        if let Some(topic) = wanted.get(&row.get(0)?) {
            let payload = row.get_ref(2)?.as_blob().map_err(rusqlite::Error::from)?;
            visitor.message(topic, row.get(1)?, payload);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Count(u32);

    impl Visitor for Count {
        fn wants(&mut self, _: &Topic) -> bool {
            true
        }

        fn message(&mut self, _: &Topic, _: i64, _: &[u8]) {
            self.0 += 1;
        }
    }

    fn count(path: &Path) -> u32 {
        let mut count = Count(0);
        let damage = scan(&Part::of(path).expect("a part"), &mut count).expect("readable");
        assert_eq!(damage, None);
        count.0
    }

    const TABLES: &str = "PRAGMA journal_mode=WAL; PRAGMA wal_autocheckpoint=0;
        CREATE TABLE topics(id INTEGER PRIMARY KEY, name, type, serialization_format);
        CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, data);
        INSERT INTO topics VALUES(1, '/a', 'a/msg/B', 'cdr');";

    #[test]
    fn a_write_ahead_log_is_read_and_nothing_is_left_beside_the_file() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let live = folder.path().join("live.db3");
        let writer = Connection::open(&live).expect("a database");
        writer.execute_batch(TABLES).expect("tables");
        for id in 0..3 {
            writer.execute("INSERT INTO messages VALUES(?1, 1, 7, x'00')", [id]).expect("inserted");
        }
        // as a recorder leaves it that is killed, in a folder of a name that needs escapes
        let bag = folder.path().join("a bag? #1 100%");
        std::fs::create_dir(&bag).expect("a folder");
        for ending in ["", "-wal"] {
            let copy = bag.join(format!("drive.db3{ending}"));
            std::fs::copy(folder.path().join(format!("live.db3{ending}")), copy).expect("copied");
        }
        drop(writer);
        let names = || -> Vec<_> {
            let entries = std::fs::read_dir(&bag).expect("a folder");
            entries.map(|entry| entry.expect("an entry").file_name()).collect()
        };
        assert_eq!((count(&bag.join("drive.db3")), names().len()), (3, 2));
        // closed as it should be: the log is merged, the mode stays
        std::fs::remove_file(bag.join("drive.db3-wal")).expect("removed");
        std::fs::copy(&live, bag.join("drive.db3")).expect("copied");
        assert_eq!((count(&bag.join("drive.db3")), names().len()), (3, 1));
        let packed = zstd::stream::encode_all(&std::fs::read(&live).expect("bytes")[..], 3);
        std::fs::write(bag.join("packed.db3.zstd"), packed.expect("packed")).expect("written");
        assert_eq!((count(&bag.join("packed.db3.zstd")), names().len()), (3, 2));
    }
}
