//! What an MCAP file says its channels are: topics, types, encodings and qualities of service.
//!
//! A file can describe the same channel in each of its chunks, and a small one can unpack to gigabytes of texts. So records
//! are looked at where they lie, the first one of a number is kept, and what is kept altogether is bounded.

use std::collections::BTreeMap;

use mcap::records::op;

use crate::fit::Fields;
use crate::qos::{self, Qos};
use crate::topic::{RecordedTopic, Topic};
use crate::{MessageDefinition, fit};

/// What the definitions of a file may take. A type has a few kB, and each of its topics has its own copy.
const MOST_BYTES: usize = 32 << 20;
/// Longest text of a quality of service. One publisher has 300 bytes, and reading YAML takes fifty times its size.
const QOS_BYTES: usize = 1 << 18;
/// The different ones of a file ...
const ALL_QOS_BYTES: usize = 4 << 20;
/// ... and the publishers of all its topics.
const MOST_OFFERS: usize = 100_000;

/// A record that describes something, still where it lies.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Definition<'a> {
    Schema { id: u16, name: &'a str, encoding: &'a str, text: &'a [u8] },
    Channel { id: u16, schema: u16, topic: &'a str, encoding: &'a str, qos: &'a str, type_hash: &'a str },
}

/// The text of a type as the file has it.
#[derive(Debug, Clone)]
struct Schema {
    name: String,
    encoding: String,
    text: String,
}

/// A topic with one type.
#[derive(Debug, Clone)]
struct Channel {
    schema: u16,
    topic: String,
    encoding: String,
    qos: String,
    type_hash: String,
}

/// Types and channels by their numbers.
#[derive(Debug, Clone)]
pub(crate) struct Definitions {
    schemas: BTreeMap<u16, Schema>,
    channels: BTreeMap<u16, Channel>,
    /// Bytes that may still come.
    left: usize,
    /// More came than that.
    is_over: bool,
}

impl<'a> Definition<'a> {
    /// Reads the content of a record of kind `opcode`.
    ///
    /// # Errors
    /// What is wrong with it, without the place.
    pub(crate) fn parse(opcode: u8, content: &'a [u8]) -> Result<Self, &'static str> {
        const CUT: &str = "a field is longer than the record";
        const NO_TEXT: &str = "a text is not UTF-8";
        if fit::size_of_content(opcode, content).is_none_or(|size| size > content.len() as u64) {
            return Err(CUT);
        }
        let mut fields = Fields::new(content);
        let id = fields.number().ok_or(CUT)?;
        let text = |bytes: Option<&'a [u8]>| std::str::from_utf8(bytes.ok_or(CUT)?).map_err(|_| NO_TEXT);
        if opcode == op::SCHEMA {
            let (name, encoding) = (text(fields.block())?, text(fields.block())?);
            return Ok(Self::Schema { id, name, encoding, text: fields.block().ok_or(CUT)? });
        }
        let schema = fields.number().ok_or(CUT)?;
        let (topic, encoding) = (text(fields.block())?, text(fields.block())?);
        let mut pairs = Fields::new(fields.block().ok_or(CUT)?);
        let (mut qos, mut type_hash) = ("", "");
        while let (Some(key), Some(value)) = (pairs.block(), pairs.block()) {
            match key {
                b"offered_qos_profiles" => qos = text(Some(value))?,
                b"topic_type_hash" => type_hash = text(Some(value))?,
                _ => {}
            }
        }
        Ok(Self::Channel { id, schema, topic, encoding, qos, type_hash })
    }
}

impl Default for Definitions {
    fn default() -> Self {
        Self { schemas: BTreeMap::new(), channels: BTreeMap::new(), left: MOST_BYTES, is_over: false }
    }
}

impl Definitions {
    /// Takes a definition. The first one of a number counts: others are the same or damaged.
    pub(crate) fn add(&mut self, definition: Definition<'_>) {
        match definition {
            Definition::Schema { id, name, encoding, text } => {
                if self.schemas.contains_key(&id) || !self.pay(name.len() + encoding.len()) {
                    return;
                }
                let fits = text.len() <= self.left;
                let text = if fits { String::from_utf8_lossy(text).into_owned() } else { String::new() };
                // What is not UTF-8 grows. A type without its text still has its name.
                let text = if fits && self.pay(text.len()) { text } else { String::new() };
                self.is_over |= !fits;
                let (name, encoding) = (name.to_owned(), encoding.to_owned());
                self.schemas.insert(id, Schema { name, encoding, text });
            }
            Definition::Channel { id, schema, topic, encoding, qos, type_hash } => {
                // A QoS nobody can read is one that is not known.
                let qos = if qos.len() <= QOS_BYTES.min(self.left) { qos } else { "" };
                let size = topic.len() + encoding.len() + qos.len() + type_hash.len();
                if self.channels.contains_key(&id) || !self.pay(size) {
                    return;
                }
                let [topic, encoding, qos, type_hash] = [topic, encoding, qos, type_hash].map(str::to_owned);
                self.channels.insert(id, Channel { schema, topic, encoding, qos, type_hash });
            }
        }
    }

    /// Takes what is missing here from others.
    pub(crate) fn complete_from(&mut self, others: &Self) {
        for (id, schema) in &others.schemas {
            self.schemas.entry(*id).or_insert_with(|| schema.clone());
        }
        for (id, channel) in &others.channels {
            self.channels.entry(*id).or_insert_with(|| channel.clone());
        }
        self.is_over |= others.is_over;
    }

    /// The numbers of the channels.
    pub(crate) fn channels(&self) -> impl Iterator<Item = u16> {
        self.channels.keys().copied()
    }

    /// How many types and channels there are.
    pub(crate) fn counts(&self) -> (usize, usize) {
        (self.schemas.len(), self.channels.len())
    }

    /// The topics by the numbers of their channels, with `counts` of their messages; and what was left out of them.
    pub(crate) fn topics(
        &self,
        counts: &BTreeMap<u16, u64>,
    ) -> (BTreeMap<u32, RecordedTopic>, Option<String>) {
        let mut left = MOST_BYTES;
        let mut is_over = self.is_over;
        let mut offers = Offers::default();
        let topics = self.channels.iter().map(|(id, channel)| {
            let schema = self.schemas.get(&channel.schema);
            let of_schema = |get: fn(&Schema) -> &String| schema.map(get).cloned().unwrap_or_default();
            let size = schema.map_or(0, |schema| schema.text.len());
            let fits = left.checked_sub(size);
            left = fits.unwrap_or(left);
            is_over |= fits.is_none();
            let topic = Topic {
                name: channel.topic.clone(),
                type_name: of_schema(|schema| &schema.name),
                serialization_format: channel.encoding.clone(),
                offered_qos: offers.of(&channel.qos),
                definition: MessageDefinition {
                    encoding: of_schema(|schema| &schema.encoding),
                    text: fits.map(|_| of_schema(|schema| &schema.text)).unwrap_or_default(),
                    type_hash: channel.type_hash.clone(),
                },
            };
            (u32::from(*id), RecordedTopic { topic, message_count: counts.get(id).copied().unwrap_or(0) })
        });
        let topics = topics.collect();
        let reason = format!("definitions of more than {MOST_BYTES} bytes altogether; some are left out");
        (topics, is_over.then_some(reason))
    }

    /// Whether there is still room for so many bytes, which then are taken.
    fn pay(&mut self, bytes: usize) -> bool {
        let left = self.left.checked_sub(bytes);
        self.left = left.unwrap_or(self.left);
        self.is_over |= left.is_none();
        left.is_some()
    }
}

/// Qualities of service, each text read once.
struct Offers<'a> {
    known: BTreeMap<&'a str, Vec<Qos>>,
    /// Bytes of texts and publishers that may still come.
    bytes_left: usize,
    left: usize,
}

impl Default for Offers<'_> {
    fn default() -> Self {
        Self { known: BTreeMap::new(), bytes_left: ALL_QOS_BYTES, left: MOST_OFFERS }
    }
}

impl<'a> Offers<'a> {
    /// A QoS nobody can read is one that is not known.
    fn of(&mut self, text: &'a str) -> Vec<Qos> {
        if !self.known.contains_key(text) {
            let left = self.bytes_left.checked_sub(text.len());
            self.bytes_left = left.unwrap_or(self.bytes_left);
            let read = left.and_then(|_| qos::from_yaml(text).ok()).unwrap_or_default();
            self.known.insert(text, read);
        }
        let offers = self.known.get(text).filter(|offers| offers.len() <= self.left);
        let offers = offers.cloned().unwrap_or_default();
        self.left -= offers.len();
        offers
    }
}
