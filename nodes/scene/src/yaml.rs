//! YAML text to a tree that keeps duplicate keys, value types and, for every node, its place in the document.
//!
//! serde does not hand out line numbers. Every node therefore gets its ordinal in document order; when a line is
//! needed for a message the document is read again and the reader stops with an error at that ordinal, whose
//! location the YAML parser knows. Lines are needed only once something is wrong, so reading twice costs nothing.

use std::cell::Cell;
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};

/// One node of the document.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tree {
    /// Ordinal in document order, counted from 0; keys count too.
    pub(crate) node: usize,
    pub(crate) content: Content,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Content {
    Null,
    Bool(bool),
    Integer(i64),
    Double(f64),
    Text(String),
    List(Vec<Tree>),
    /// In file order, duplicates kept.
    Map(Vec<(Tree, Tree)>),
}

impl Content {
    /// The type in words, with its article.
    pub(crate) fn type_in_words(&self) -> &'static str {
        match self {
            Content::Null => "empty",
            Content::Bool(_) => "a boolean",
            Content::Integer(_) => "an integer",
            Content::Double(_) => "a number",
            Content::Text(_) => "a string",
            Content::List(_) => "a list",
            Content::Map(_) => "a group of parameters",
        }
    }
}

/// As a person would write it, shortened when long.
impl fmt::Display for Content {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Content::Null => f.write_str("nothing"),
            Content::Bool(v) => write!(f, "{v}"),
            Content::Integer(v) => write!(f, "{v}"),
            Content::Double(v) if v.is_nan() => f.write_str(".nan"),
            Content::Double(v) if v.is_infinite() => f.write_str(if *v > 0.0 { ".inf" } else { "-.inf" }),
            Content::Double(v) => write!(f, "{v:?}"),
            Content::Text(v) => write!(f, "{v:?}"),
            Content::List(items) => {
                f.write_str("[")?;
                for (i, item) in items.iter().take(8).enumerate() {
                    write!(f, "{}{}", if i > 0 { ", " } else { "" }, item.content)?;
                }
                f.write_str(if items.len() > 8 { ", ...]" } else { "]" })
            }
            Content::Map(_) => f.write_str("{...}"),
        }
    }
}

/// Why a text is not one YAML document.
pub(crate) struct SyntaxError {
    pub(crate) line: Option<usize>,
    pub(crate) message: String,
}

/// Brackets this deep are no parameter file, and cost the YAML parser time with the square of their depth.
const DEEPEST: usize = 1000;

/// Reads one document.
pub(crate) fn parse(text: &str) -> Result<Tree, SyntaxError> {
    if let Some(line) = line_of_depth(text, DEEPEST) {
        let message = format!("brackets are open {DEEPEST} deep; accepted: a few");
        return Err(SyntaxError { line: Some(line), message });
    }
    let reader = Reader { next: &Cell::new(0), stop_at: None };
    reader.deserialize(serde_yaml::Deserializer::from_str(text)).map_err(|error| SyntaxError {
        line: error.location().map(|place| place.line()),
        message: error.to_string(),
    })
}

/// The line where `depth` brackets are open, if there is one. Brackets in texts and comments count too: nobody has a
/// thousand of those open either.
fn line_of_depth(text: &str, depth: usize) -> Option<usize> {
    let (mut open, mut line) = (0_usize, 1);
    for byte in text.bytes() {
        match byte {
            b'\n' => line += 1,
            b'[' | b'{' => open += 1,
            b']' | b'}' => open = open.saturating_sub(1),
            _ => {}
        }
        if open >= depth {
            return Some(line);
        }
    }
    None
}

/// Line, counted from 1, of the `node`-th node of a document that [`parse`] accepts.
pub(crate) fn line_of_node(text: &str, node: usize) -> Option<usize> {
    place_of_node(text, node).map(|place| place.line())
}

/// Whether the `node`-th node is a text in quotes.
pub(crate) fn is_quoted(text: &str, node: usize) -> bool {
    // The parser counts characters, not bytes.
    place_of_node(text, node)
        .and_then(|place| text.chars().nth(place.index()))
        .is_some_and(|c| matches!(c, '"' | '\''))
}

fn place_of_node(text: &str, node: usize) -> Option<serde_yaml::Location> {
    let reader = Reader { next: &Cell::new(0), stop_at: Some(node) };
    reader.deserialize(serde_yaml::Deserializer::from_str(text)).err()?.location()
}

#[derive(Clone, Copy)]
struct Reader<'a> {
    next: &'a Cell<usize>,
    stop_at: Option<usize>,
}

impl<'de> DeserializeSeed<'de> for Reader<'_> {
    type Value = Tree;

    fn deserialize<D: Deserializer<'de>>(self, source: D) -> Result<Tree, D::Error> {
        let node = self.next.get();
        self.next.set(node + 1);
        let content = source.deserialize_any(Node { reader: self, stop: self.stop_at == Some(node) })?;
        Ok(Tree { node, content })
    }
}

struct Node<'a> {
    reader: Reader<'a>,
    stop: bool,
}

impl Node<'_> {
    fn give<E: Error>(self, content: Content) -> Result<Content, E> {
        if self.stop { Err(E::custom("here")) } else { Ok(content) }
    }
}

impl<'de> Visitor<'de> for Node<'_> {
    type Value = Content;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a boolean, a number, a string, a list or a map")
    }

    fn visit_unit<E: Error>(self) -> Result<Content, E> {
        self.give(Content::Null)
    }

    // What an empty document is to the YAML reader.
    fn visit_none<E: Error>(self) -> Result<Content, E> {
        self.give(Content::Null)
    }

    fn visit_bool<E: Error>(self, v: bool) -> Result<Content, E> {
        self.give(Content::Bool(v))
    }

    fn visit_i64<E: Error>(self, v: i64) -> Result<Content, E> {
        self.give(Content::Integer(v))
    }

    fn visit_u64<E: Error>(self, v: u64) -> Result<Content, E> {
        // Beyond i64 ROS 2 reads a number with a decimal point.
        self.give(i64::try_from(v).map_or(Content::Double(v as f64), Content::Integer))
    }

    fn visit_i128<E: Error>(self, v: i128) -> Result<Content, E> {
        self.give(Content::Double(v as f64))
    }

    fn visit_u128<E: Error>(self, v: u128) -> Result<Content, E> {
        self.give(Content::Double(v as f64))
    }

    fn visit_f64<E: Error>(self, v: f64) -> Result<Content, E> {
        self.give(Content::Double(v))
    }

    fn visit_str<E: Error>(self, v: &str) -> Result<Content, E> {
        self.give(Content::Text(v.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Content, A::Error> {
        if self.stop {
            return Err(A::Error::custom("here"));
        }
        let mut items = Vec::new();
        while let Some(item) = list.next_element_seed(self.reader)? {
            items.push(item);
        }
        Ok(Content::List(items))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Content, A::Error> {
        if self.stop {
            return Err(A::Error::custom("here"));
        }
        let mut entries = Vec::new();
        while let Some(key) = map.next_key_seed(self.reader)? {
            entries.push((key, map.next_value_seed(self.reader)?));
        }
        Ok(Content::Map(entries))
    }
}
