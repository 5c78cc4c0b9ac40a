//! Topics and definitions as the versions of rosbag2's schema have them.
//!
//! Version 1 describes a topic by name, type and format. Version 2 added `offered_qos_profiles`, version 3 the tables
//! `schema` and `metadata`, version 4 `message_definitions` and the column `type_description_hash`. What is there is asked
//! of the database itself: recordings that were converted claim any version.

use std::collections::BTreeMap;

use rusqlite::types::ValueRef;

use super::database::{Database, Unfit, text};
use crate::topic::Topic;
use crate::{MessageDefinition, qos};

/// What the database says about its topics.
#[derive(Default)]
pub(super) struct Schema {
    /// By their ids in the database.
    pub(super) topics: BTreeMap<i64, Topic>,
    /// What could not be read, and why.
    pub(super) damage: Vec<String>,
}

/// The texts of a row of `topics`, in the order of its columns.
#[derive(Default)]
pub(super) struct TopicTexts {
    pub(super) name: String,
    pub(super) type_name: String,
    pub(super) format: String,
    pub(super) qos: String,
    pub(super) type_hash: String,
}

impl TopicTexts {
    pub(super) fn topic(self, definitions: &BTreeMap<String, MessageDefinition>) -> Topic {
        let mut definition = definitions.get(&self.type_name).cloned().unwrap_or_default();
        if !self.type_hash.is_empty() {
            definition.type_hash = self.type_hash;
        }
        Topic {
            name: self.name,
            type_name: self.type_name,
            serialization_format: self.format,
            // A QoS nobody can read is one that is not known.
            offered_qos: qos::from_yaml(&self.qos).unwrap_or_default(),
            definition,
        }
    }
}

/// A definition as the table `message_definitions` has it.
pub(super) fn definition(encoding: String, text: String, type_hash: String) -> MessageDefinition {
    // rosbag2 writes "unknown" where it found no text.
    let encoding = if text.is_empty() { String::new() } else { encoding };
    MessageDefinition { encoding, text, type_hash }
}

/// Reads all topics. The inner error says why its table is not read.
pub(super) fn read(database: &Database) -> rusqlite::Result<Result<Schema, Unfit>> {
    let table = match database.table_with("topics", &["name", "type", "serialization_format"])? {
        Ok(table) => table,
        Err(unfit) => return Ok(Err(unfit)),
    };
    let mut schema = Schema::default();
    let definitions = read_definitions(database).unwrap_or_else(|error| {
        schema.damage.push(format!("the message definitions cannot be read: {error}"));
        BTreeMap::new()
    });
    let or_nothing = |column| if table.has(column) { column } else { "''" };
    let (qos, hash) = (or_nothing("offered_qos_profiles"), or_nothing("type_description_hash"));
    let sql = format!(
        "SELECT id, name, type, serialization_format, {qos}, {hash} FROM topics NOT INDEXED ORDER BY id"
    );
    let mut statement = database.prepare(&sql)?;
    let mut rows = statement.query([])?;
    let mut last = None;
    while let Some(row) = rows.next()? {
        let id: i64 = row.get(0)?;
        if last.is_some_and(|last| last >= id) {
            schema.damage.push("the table of topics leads back into itself".to_owned());
            break;
        }
        last = Some(id);
        let ValueRef::Text(_) = row.get_ref(1)? else {
            schema.damage.push(format!("topic {id} has no name"));
            continue;
        };
        let texts = TopicTexts {
            name: text(row.get_ref(1)?),
            type_name: text(row.get_ref(2)?),
            format: text(row.get_ref(3)?),
            qos: text(row.get_ref(4)?),
            type_hash: text(row.get_ref(5)?),
        };
        schema.topics.insert(id, texts.topic(&definitions));
    }
    Ok(Ok(schema))
}

/// Definitions by type; none where the table is missing.
fn read_definitions(database: &Database) -> rusqlite::Result<BTreeMap<String, MessageDefinition>> {
    let needed = ["topic_type", "encoding", "encoded_message_definition", "type_description_hash"];
    let Ok(_) = database.table_with("message_definitions", &needed)? else { return Ok(BTreeMap::new()) };
    let sql = "SELECT id, topic_type, encoding, encoded_message_definition, type_description_hash
               FROM message_definitions NOT INDEXED ORDER BY id";
    let mut statement = database.prepare(sql)?;
    let mut rows = statement.query([])?;
    let mut definitions = BTreeMap::new();
    let mut last = None;
    while let Some(row) = rows.next()? {
        let id: i64 = row.get(0)?;
        if last.is_some_and(|last| last >= id) {
            break;
        }
        last = Some(id);
        let found = definition(text(row.get_ref(2)?), text(row.get_ref(3)?), text(row.get_ref(4)?));
        definitions.insert(text(row.get_ref(1)?), found);
    }
    Ok(definitions)
}
