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

/// Longest text of a quality of service. One publisher has 300 bytes, and reading YAML takes fifty times its size.
const QOS_BYTES: usize = 1 << 18;
/// What those of all topics may have.
const ALL_QOS_BYTES: usize = 4 << 20;
/// What the definitions of all topics may take. A type has a few kB, and each of its topics has its own copy.
const DEFINITIONS_BYTES: usize = 32 << 20;
/// As many as an MCAP file can have.
const MOST_TOPICS: usize = 1 << 16;

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

/// Makes topics of their texts, within bounds: a stranger's file may say of ten thousand topics what takes megabytes each.
pub(super) struct Describer {
    definitions: BTreeMap<String, MessageDefinition>,
    definition_bytes: usize,
    qos_bytes: usize,
    without_definition: u64,
    without_qos: u64,
}

impl Describer {
    /// With definitions by type.
    pub(super) fn new(definitions: BTreeMap<String, MessageDefinition>) -> Self {
        Self {
            definitions,
            definition_bytes: DEFINITIONS_BYTES,
            qos_bytes: ALL_QOS_BYTES,
            without_definition: 0,
            without_qos: 0,
        }
    }

    pub(super) fn topic(&mut self, texts: TopicTexts) -> Topic {
        let mut definition = MessageDefinition::default();
        if let Some(known) = self.definitions.get(&texts.type_name) {
            match self.definition_bytes.checked_sub(known.text.len()) {
                Some(left) => {
                    self.definition_bytes = left;
                    definition.clone_from(known);
                }
                None => self.without_definition += 1,
            }
        }
        if !texts.type_hash.is_empty() {
            definition.type_hash = texts.type_hash;
        }
        let left = self.qos_bytes.checked_sub(texts.qos.len()).filter(|_| texts.qos.len() <= QOS_BYTES);
        let offered_qos = match left {
            Some(left) => {
                self.qos_bytes = left;
                // A QoS nobody can read is one that is not known.
                qos::from_yaml(&texts.qos).unwrap_or_default()
            }
            None => {
                self.without_qos += 1;
                Vec::new()
            }
        };
        let (name, type_name, serialization_format) = (texts.name, texts.type_name, texts.format);
        Topic { name, type_name, serialization_format, offered_qos, definition }
    }

    /// What was left out, a sentence each.
    pub(super) fn damage(&self) -> Vec<String> {
        let definitions = format!(
            "definitions of more than {DEFINITIONS_BYTES} bytes altogether; topics left without theirs: {}",
            self.without_definition
        );
        let qos = format!(
            "qualities of service of more than {QOS_BYTES} bytes, or {ALL_QOS_BYTES} altogether; topics left without theirs: {}",
            self.without_qos
        );
        let sentences = [(self.without_definition, definitions), (self.without_qos, qos)];
        sentences.into_iter().filter(|(count, _)| *count > 0).map(|(_, sentence)| sentence).collect()
    }
}

/// Bytes of texts that are read: rows of a whole file have no more than the file, broken or hostile ones share their pages.
pub(super) struct Budget {
    left: u64,
    refused: u64,
}

impl Budget {
    /// For a file of this size.
    pub(super) fn new(file_bytes: u64) -> Self {
        Self { left: file_bytes, refused: 0 }
    }

    /// Whether a row with this many bytes may be read.
    pub(super) fn take(&mut self, bytes: u64) -> bool {
        let left = self.left.checked_sub(bytes);
        self.left = left.unwrap_or(self.left);
        self.refused += u64::from(left.is_none());
        left.is_some()
    }

    /// What was not read.
    pub(super) fn damage(&self) -> Vec<String> {
        let refused = self.refused;
        let sentence = || {
            format!(
                "topics and definitions that claim more bytes than the file has; rows left out: {refused}"
            )
        };
        (refused > 0).then(sentence).into_iter().collect()
    }
}

/// A definition as the table `message_definitions` has it.
pub(super) fn definition(encoding: String, text: String, type_hash: String) -> MessageDefinition {
    // rosbag2 writes "unknown" where it found no text.
    let encoding = if text.is_empty() { String::new() } else { encoding };
    MessageDefinition { encoding, text, type_hash }
}

/// Reads all topics of a file of `len` bytes. The inner error says why its table is not read.
pub(super) fn read(database: &Database, len: u64) -> rusqlite::Result<Result<Schema, Unfit>> {
    let table = match database.table_with("topics", &["name", "type", "serialization_format"])? {
        Ok(table) => table,
        Err(unfit) => return Ok(Err(unfit)),
    };
    let mut schema = Schema::default();
    let mut budget = Budget::new(len);
    let definitions = read_definitions(database, &mut budget).unwrap_or_else(|error| {
        schema.damage.push(format!("the message definitions cannot be read: {error}"));
        BTreeMap::new()
    });
    let mut describer = Describer::new(definitions);
    let or_nothing = |column| if table.has(column) { column } else { "''" };
    let (qos, hash) = (or_nothing("offered_qos_profiles"), or_nothing("type_description_hash"));
    let columns = ["name", "type", "serialization_format", qos, hash];
    let mut unnamed = Vec::new();
    let ended = for_each_row(database, "topics", columns, &mut budget, |id, texts| {
        let [Some(name), type_name, format, qos, type_hash] = texts else {
            unnamed.push(id);
            return;
        };
        let [type_name, format, qos, type_hash] =
            [type_name, format, qos, type_hash].map(Option::unwrap_or_default);
        schema.topics.insert(id, describer.topic(TopicTexts { name, type_name, format, qos, type_hash }));
    })?;
    schema.damage.extend(unnamed.iter().map(|id| format!("topic {id} has no name")));
    schema.damage.extend(ended);
    schema.damage.extend(describer.damage());
    schema.damage.extend(budget.damage());
    Ok(Ok(schema))
}

/// Definitions by type; none where the table is missing.
fn read_definitions(
    database: &Database,
    budget: &mut Budget,
) -> rusqlite::Result<BTreeMap<String, MessageDefinition>> {
    let needed = ["topic_type", "encoding", "encoded_message_definition", "type_description_hash"];
    let Ok(_) = database.table_with("message_definitions", &needed)? else { return Ok(BTreeMap::new()) };
    let mut definitions = BTreeMap::new();
    for_each_row(database, "message_definitions", needed, budget, |_, texts| {
        let [type_name, encoding, text, type_hash] = texts.map(Option::unwrap_or_default);
        definitions.insert(type_name, definition(encoding, text, type_hash));
    })?;
    Ok(definitions)
}

/// Hands the texts of each row to `take`, `None` where there is something else. The sizes are looked at first. Returns why
/// it ended early.
fn for_each_row<const N: usize>(
    database: &Database,
    table: &str,
    columns: [&str; N],
    budget: &mut Budget,
    mut take: impl FnMut(i64, [Option<String>; N]),
) -> rusqlite::Result<Option<String>> {
    let sizes = columns.map(|column| format!("coalesce(octet_length({column}), 0)")).join(" + ");
    let mut sizes = database.prepare(&format!("SELECT id, {sizes} FROM {table} NOT INDEXED ORDER BY id"))?;
    let texts = format!("SELECT {} FROM {table} NOT INDEXED WHERE id = ?1", columns.join(", "));
    let mut texts = database.prepare(&texts)?;
    let mut rows = sizes.query([])?;
    let mut last = None;
    let mut count = 0;
    while let Some(row) = rows.next()? {
        let id: i64 = row.get(0)?;
        if last.is_some_and(|last| last >= id) {
            return Ok(Some(format!("the table of {} leads back into itself", table.replace('_', " "))));
        }
        last = Some(id);
        count += 1;
        if count > MOST_TOPICS {
            return Ok(Some(format!("more than {MOST_TOPICS} {}", table.replace('_', " "))));
        }
        if !budget.take(u64::try_from(row.get::<_, i64>(1)?).unwrap_or(u64::MAX)) {
            continue;
        }
        let mut found = texts.query([id])?;
        if let Some(found) = found.next()? {
            let mut values = [const { None }; N];
            for (at, value) in values.iter_mut().enumerate() {
                let stored = found.get_ref(at)?;
                *value = matches!(stored, ValueRef::Text(_)).then(|| text(stored));
            }
            take(id, values);
        }
    }
    Ok(None)
}
