//! `.db3` files: `SQLite` with the tables `topics` and `messages`.

use super::topic::Topic;
use super::visitor::Visitor;
use crate::Error;
use crate::recording::Warning;
use rusqlite::{Connection, OpenFlags};
use std::collections::HashMap;
use std::path::Path;

/// Shows the messages of a file; a warning says where it is damaged.
///
/// # Errors
/// [`Error::Bag`] when the file cannot be opened or its topics cannot be read.
pub(super) fn scan(path: &Path, visitor: &mut dyn Visitor) -> Result<Option<Warning>, Error> {
    let refused =
        |error: rusqlite::Error| Error::Bag { path: path.to_owned(), message: error.to_string() };
    let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let connection = Connection::open_with_flags(path, flags).map_err(refused)?;
    let topics = topics(&connection).map_err(refused)?;
    let wanted: HashMap<i64, Topic> =
        topics.into_iter().filter(|(_, topic)| visitor.wants(topic)).collect();
    let mut messages = 0;
    Ok(show(&connection, &wanted, visitor, &mut messages).err().map(|error| Warning::Damaged {
        path: path.to_owned(),
        message: error.to_string(),
        messages,
    }))
}

fn topics(connection: &Connection) -> rusqlite::Result<Vec<(i64, Topic)>> {
    let mut statement = connection
        .prepare("SELECT id, name, type, serialization_format FROM topics ORDER BY id")?;
    let rows = statement.query_map([], |row| {
        Ok((row.get(0)?, Topic { name: row.get(1)?, kind: row.get(2)?, encoding: row.get(3)? }))
    })?;
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
