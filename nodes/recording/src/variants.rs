//! Which channels of a recording are one topic.
//!
//! The files of a recording number their channels anew, and publishers of a topic can have a channel each: those are one
//! topic when name, type, encoding and definition are the same. CDR carries no names, so that messages of another
//! definition mean something else although their topic and type are called the same.

use std::collections::BTreeMap;

use sha2::{Digest as _, Sha256};

use crate::MessageDefinition;
use crate::messages::fields_of;
use crate::topic::{RecordedTopic, Topic};

/// The topics found so far.
#[derive(Debug, Default)]
pub(crate) struct Variants(BTreeMap<Key, OfKey>);

/// Name, type and encoding.
type Key = (String, String, String);
/// A definition: what its text says, whatever its comments.
type Fields = [u8; 32];

/// Topics that differ in their definitions alone. The numbers are those of the topics.
#[derive(Debug, Default)]
struct OfKey {
    first: Option<usize>,
    by_fields: BTreeMap<Fields, usize>,
    /// Without a text, by the hash of the type.
    without: BTreeMap<String, usize>,
}

impl Variants {
    /// Adds a topic of a file to the `topics` of the recording, and says its number there.
    pub(crate) fn add(&mut self, topics: &mut Vec<RecordedTopic>, added: RecordedTopic) -> usize {
        let Topic { name, type_name, serialization_format, definition, .. } = &added.topic;
        let fields = fields(type_name, definition);
        let key = (name.clone(), type_name.clone(), serialization_format.clone());
        let known = self.0.entry(key).or_default();
        let hash = definition.type_hash.clone();
        let first = known.first.filter(|first| {
            topics.get(*first).is_some_and(|topic| may_agree(&topic.topic.definition, definition))
        });
        let same = match &fields {
            Some(fields) => known.by_fields.get(fields).or_else(|| known.without.get(&hash)),
            None => known.without.get(&hash),
        };
        let place = same.copied().or(first).unwrap_or(topics.len());
        known.first.get_or_insert(place);
        match fields {
            Some(fields) => known.by_fields.entry(fields).or_insert(place),
            None => known.without.entry(hash).or_insert(place),
        };
        match topics.get_mut(place) {
            Some(found) => {
                found.message_count = found.message_count.saturating_add(added.message_count);
                complete(&mut found.topic.definition, added.topic.definition);
            }
            None => topics.push(added),
        }
        place
    }
}

/// Whether two definitions can both be right when their texts cannot be compared: one is missing or of another kind.
fn may_agree(one: &MessageDefinition, other: &MessageDefinition) -> bool {
    let comparable = !one.text.is_empty() && !other.text.is_empty() && one.encoding == other.encoding;
    let (one, other) = (&one.type_hash, &other.type_hash);
    !comparable && (one.is_empty() || other.is_empty() || one == other)
}

/// Takes what is missing in `definition`.
fn complete(definition: &mut MessageDefinition, other: MessageDefinition) {
    if definition.text.is_empty() {
        (definition.encoding, definition.text) = (other.encoding, other.text);
    }
    if definition.type_hash.is_empty() {
        definition.type_hash = other.type_hash;
    }
}

/// What a text says; `None` without one.
fn fields(type_name: &str, definition: &MessageDefinition) -> Option<Fields> {
    let MessageDefinition { encoding, text, .. } = definition;
    if text.trim().is_empty() {
        return None;
    }
    let mut hash = Sha256::new();
    hash.update(encoding.as_bytes());
    match encoding.as_str() {
        "ros2msg" => fields_of(type_name, text, |word| {
            hash.update(word.as_bytes());
            hash.update(b"\n");
        }),
        _ => hash.update(text.as_bytes()),
    }
    Some(hash.finalize().into())
}
