//! A ROS 2 parameter file: which sections there are, which of them apply, and what they set.
//!
//! The rules are those of the nodes' own reader: the sections `/**`, `**`, a node's full name and its bare name
//! apply, in file order. What would be ignored without a word there is refused here: other wildcards, full names without
//! their first slash, and a full name that lacks the namespace of the node that reads.

use std::collections::BTreeMap;
use std::path::Path;

use crate::drivers;
use crate::parameters::check;
use crate::schema::{Kind, Node, ParameterSpec, nearest_name, spec};
use crate::yaml::{self, Content, Tree};
use crate::yaml_value::{mixed, value_of};
use crate::{Origin, Parameters, Problem, SceneError, Value};

const SHAPE: &str = "a ROS 2 parameter file has a section (/**: or a node's name), in it ros__parameters:, and in \
                     that the parameters";

/// Who reads a parameter file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reader<'a> {
    /// Somebody who wants the whole scene: the wildcard sections and every section named after one of our nodes. A
    /// parameter that two sections set differently is an error. Sections of single drivers (`/left/haptic_device`) are
    /// checked and set nothing: see [`Parameters::drivers_in_file`].
    Everything,
    /// The node with this full name, like `/left/deformation`: what its own reader would apply; later sections win.
    Node(&'a str),
}

impl Parameters {
    /// Reads and checks a parameter file.
    ///
    /// # Errors
    /// The file cannot be read, is not YAML, is not a parameter file, or says something that is not accepted.
    pub fn from_file(path: &Path, reader: Reader<'_>) -> Result<Parameters, SceneError> {
        let (origin, tree) = read_file(path)?;
        Parameters::from_tree(&tree, origin, reader)
    }

    pub(crate) fn from_text(
        text: &str,
        origin: Origin,
        reader: Reader<'_>,
    ) -> Result<Parameters, SceneError> {
        let tree = parsed(text, &origin)?;
        Parameters::from_tree(&tree, origin, reader)
    }

    fn from_tree(tree: &Tree, origin: Origin, reader: Reader<'_>) -> Result<Parameters, SceneError> {
        let file = File { origin: &origin };
        let sections = file.sections(tree)?;
        if let Reader::Node(full_name) = reader {
            file.refuse_other_namespaces(full_name, &sections)?;
        }
        let mut parameters = Parameters::defaults(origin.clone());
        let mut set_by: BTreeMap<String, (&str, Value)> = BTreeMap::new();
        for section in sections.iter().filter(|section| section.applies_to(reader)) {
            for (key, leaf, value) in file.values(section)? {
                if reader == Reader::Everything
                    && let Some((other_section, other)) = set_by.get(&key)
                    && *other != value
                {
                    let problem = Problem::Conflict {
                        value: value.to_string(),
                        other: other.to_string(),
                        other_section: (*other_section).to_owned(),
                    };
                    return Err(origin.error(Some(&key), Some(leaf), problem));
                }
                parameters.set(&key, value.clone(), Some(leaf))?;
                set_by.insert(key, (&section.name, value));
            }
        }
        if reader == Reader::Everything {
            drivers::check(&file, &sections, &parameters)?;
        }
        Ok(parameters)
    }
}

/// A parameter file as a tree, and where it comes from.
pub(crate) fn read_file(path: &Path) -> Result<(Origin, Tree), SceneError> {
    let bytes = std::fs::read(path)
        .map_err(|error| Origin::file(path, "").error(None, None, Problem::Unreadable(error)))?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let line = error.as_bytes().iter().take(valid).filter(|byte| **byte == b'\n').count() + 1;
        SceneError {
            file: path.display().to_string(),
            line: Some(line),
            key: None,
            problem: Box::new(Problem::Syntax("not UTF-8 text".to_owned())),
        }
    })?;
    let origin = Origin::file(path, &text);
    let tree = parsed(&text, &origin)?;
    Ok((origin, tree))
}

fn parsed(text: &str, origin: &Origin) -> Result<Tree, SceneError> {
    let tree = yaml::parse(text).map_err(|error| SceneError {
        file: origin.name().to_owned(),
        line: error.line,
        key: None,
        problem: Box::new(Problem::Syntax(error.message)),
    })?;
    if tree.content == Content::Null {
        return Err(origin.error(None, None, Problem::Empty { accepted: SHAPE }));
    }
    Ok(tree)
}

pub(crate) struct Section<'a> {
    pub(crate) name: String,
    parameters: &'a Tree,
}

impl Section<'_> {
    pub(crate) fn applies_to(&self, reader: Reader<'_>) -> bool {
        if matches!(self.name.as_str(), "/**" | "**") {
            return true;
        }
        let (_, bare) = self.name.rsplit_once('/').unwrap_or(("", &self.name));
        match reader {
            Reader::Everything => {
                !drivers::is_of_one_driver(&self.name) && Node::ALL.iter().any(|node| node.name() == bare)
            }
            Reader::Node(full) => self.name == full || Some(self.name.as_str()) == full.rsplit('/').next(),
        }
    }
}

pub(crate) struct File<'a> {
    pub(crate) origin: &'a Origin,
}

impl File<'_> {
    fn layout(&self, tree: &Tree, message: String) -> SceneError {
        self.origin.error(None, Some(tree.node), Problem::Layout(message))
    }

    pub(crate) fn sections<'t>(&self, root: &'t Tree) -> Result<Vec<Section<'t>>, SceneError> {
        let mut sections = Vec::new();
        self.collect_sections("", root, &mut sections)?;
        for (i, section) in sections.iter().enumerate() {
            if sections.iter().take(i).any(|earlier| earlier.name == section.name) {
                let message = format!("section {} is there twice; one section is accepted", section.name);
                return Err(self.layout(section.parameters, message));
            }
            if section.name.contains('*') && !matches!(section.name.as_str(), "/**" | "**") {
                let message = format!(
                    "section {} would be ignored by the nodes; accepted: /**, a node's name, or its full name",
                    section.name
                );
                return Err(self.layout(section.parameters, message));
            }
            if section.name.contains('/') && !section.name.starts_with('/') {
                let name = &section.name;
                let message = format!(
                    "section {name} would be ignored by the nodes; accepted: /{name}, with its first slash"
                );
                return Err(self.layout(section.parameters, message));
            }
        }
        Ok(sections)
    }

    /// A full name that fits the reader but for a namespace in front is a mistake, unless the reader has its own section.
    fn refuse_other_namespaces(&self, full_name: &str, sections: &[Section<'_>]) -> Result<(), SceneError> {
        let has_its_own = sections.iter().any(|section| section.name == full_name);
        let misses =
            |section: &&Section<'_>| section.name.starts_with('/') && full_name.ends_with(&section.name);
        match sections.iter().find(misses) {
            Some(section) if !has_its_own => {
                let message = format!(
                    "section {} would be ignored by {full_name}; accepted: the full name, or a node's bare name",
                    section.name
                );
                Err(self.layout(section.parameters, message))
            }
            _ => Ok(()),
        }
    }

    /// Namespaces may be nested as maps: `/left: {deformation: {ros__parameters: ...}}` is `/left/deformation`.
    fn collect_sections<'t>(
        &self,
        prefix: &str,
        tree: &'t Tree,
        sections: &mut Vec<Section<'t>>,
    ) -> Result<(), SceneError> {
        let Content::Map(entries) = &tree.content else {
            let message = match prefix {
                "" => format!("found {}; {SHAPE}", tree.content),
                _ => format!("no ros__parameters: above {prefix}; {SHAPE}"),
            };
            return Err(self.layout(tree, message));
        };
        for (key, value) in entries {
            let Content::Text(key_text) = &key.content else {
                return Err(self.layout(key, format!("{} is not a name; {SHAPE}", key.content)));
            };
            if key_text == "ros__parameters" {
                if prefix.is_empty() {
                    return Err(self.layout(key, format!("ros__parameters: is in no section; {SHAPE}")));
                }
                sections.push(Section { name: prefix.to_owned(), parameters: value });
            } else {
                let name = match prefix {
                    "" => key_text.clone(),
                    _ => format!("{}/{}", prefix.trim_end_matches('/'), key_text.trim_matches('/')),
                };
                self.collect_sections(&name, value, sections)?;
            }
        }
        Ok(())
    }

    /// What a section sets, in file order: dotted name, place, value with the right type.
    pub(crate) fn values(&self, section: &Section<'_>) -> Result<Vec<(String, usize, Value)>, SceneError> {
        let mut leaves = Vec::new();
        self.collect_leaves("", section.parameters, &mut leaves)?;
        let mut first_places: BTreeMap<&str, usize> = BTreeMap::new();
        for (key, leaf) in &leaves {
            if let Some(first) = first_places.insert(key, leaf.node) {
                let first_line = self.origin.line(Some(first)).unwrap_or_default();
                return Err(self.origin.error(Some(key), Some(leaf.node), Problem::Duplicate { first_line }));
            }
        }
        leaves
            .into_iter()
            .map(|(key, leaf)| {
                let value = match spec(&key) {
                    None => Err(Problem::UnknownKey { nearest: nearest_name(&key) }),
                    Some(spec) => self.value(spec, leaf).and_then(|value| check(spec, value)),
                }
                .map_err(|problem| self.origin.error(Some(&key), Some(leaf.node), problem))?;
                Ok((key, leaf.node, value))
            })
            .collect()
    }

    fn collect_leaves<'t>(
        &self,
        prefix: &str,
        tree: &'t Tree,
        leaves: &mut Vec<(String, &'t Tree)>,
    ) -> Result<(), SceneError> {
        match &tree.content {
            Content::Map(entries) if spec(prefix).is_none() => {
                for (key, value) in entries {
                    let Content::Text(key_text) = &key.content else {
                        return Err(self.layout(key, format!("{} is not a parameter name", key.content)));
                    };
                    let name = match prefix {
                        "" => key_text.clone(),
                        _ => format!("{prefix}.{key_text}"),
                    };
                    self.collect_leaves(&name, value, leaves)?;
                }
            }
            Content::Null if prefix.is_empty() => {}
            content if prefix.is_empty() => {
                return Err(self.layout(tree, format!("ros__parameters: holds {content}; {SHAPE}")));
            }
            _ => leaves.push((prefix.to_owned(), tree)),
        }
        Ok(())
    }

    fn value(&self, spec: &ParameterSpec, leaf: &Tree) -> Result<Value, Problem> {
        if let Content::Text(text) = &leaf.content
            && spec.kind == Kind::String
            && self.is_boolean_to_ros(text, leaf)
        {
            return Err(Problem::WrongType {
                value: text.clone(),
                found: "a boolean to ROS 2",
                accepted: spec.accepted(),
                hint: "; write it in quotes",
            });
        }
        value_of(&leaf.content).ok_or_else(|| match &leaf.content {
            Content::List(items) => mixed(items, spec, &leaf.content),
            content => Problem::WrongType {
                value: content.to_string(),
                found: content.type_in_words(),
                accepted: spec.accepted(),
                hint: "",
            },
        })
    }

    /// Without quotes these words are text to this reader and booleans to rcl.
    fn is_boolean_to_ros(&self, text: &str, leaf: &Tree) -> bool {
        const WORDS: [&str; 8] = ["y", "n", "yes", "no", "on", "off", "true", "false"];
        WORDS.contains(&text.to_ascii_lowercase().as_str()) && !self.origin.is_quoted(leaf.node)
    }
}
