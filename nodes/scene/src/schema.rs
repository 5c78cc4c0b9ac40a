//! The single table of every parameter of every node: name, type, unit, default, accepted range, meaning.
//!
//! What checks a YAML file, what a node declares, what `rhombus parameters` prints and what the README shows all come
//! from here. One file for each group; a new parameter is one more row.

mod backends;
mod body;
mod chains;
mod check;
mod device;
mod recording;
mod row;
mod safety;
mod session;
mod simulated;
mod surface;
mod viewer;
mod visualization;

pub use check::{Check, Length};

use crate::Value;

/// One of the node executables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Node {
    /// `haptic_device`: the driver of one device.
    HapticDevice,
    /// `deformation`: the model.
    Deformation,
    /// `visualization`: what RViz and browsers show.
    Visualization,
    /// `bag_replay`: recordings.
    BagReplay,
}

impl Node {
    /// Every node, in the order of a session.
    pub const ALL: [Node; 4] = [Node::HapticDevice, Node::Deformation, Node::Visualization, Node::BagReplay];

    /// The node's default ROS name, which is also the name of its executable.
    pub fn name(self) -> &'static str {
        match self {
            Node::HapticDevice => "haptic_device",
            Node::Deformation => "deformation",
            Node::Visualization => "visualization",
            Node::BagReplay => "bag_replay",
        }
    }
}

/// The ROS type of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// `true` or `false`.
    Bool,
    /// A whole number.
    Integer,
    /// A number; an integer is accepted for it.
    Double,
    /// Text.
    String,
    /// An array of whole numbers.
    IntegerArray,
    /// An array of numbers, each written with a decimal point.
    DoubleArray,
    /// An array of text.
    StringArray,
}

impl Kind {
    /// As documentation names it: "number", "array of integers".
    pub fn in_words(self) -> &'static str {
        match self {
            Kind::Bool => "boolean",
            Kind::Integer => "integer",
            Kind::Double => "number",
            Kind::String => "string",
            Kind::IntegerArray => "array of integers",
            Kind::DoubleArray => "array of numbers",
            Kind::StringArray => "array of strings",
        }
    }
}

/// What a parameter is when nobody sets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DefaultValue {
    /// There is none: the parameter is required by the nodes that use it.
    Required,
    /// It follows from other parameters; the text says how.
    Computed(&'static str),
    /// A boolean.
    Bool(bool),
    /// An integer.
    Integer(i64),
    /// A number.
    Double(f64),
    /// Text.
    String(&'static str),
    /// Numbers.
    Doubles(&'static [f64]),
    /// Texts.
    Strings(&'static [&'static str]),
}

impl DefaultValue {
    /// The default as a parameter value; none when it is required or computed.
    pub fn value(&self) -> Option<Value> {
        match *self {
            DefaultValue::Required | DefaultValue::Computed(_) => None,
            DefaultValue::Bool(v) => Some(Value::Bool(v)),
            DefaultValue::Integer(v) => Some(Value::Integer(v)),
            DefaultValue::Double(v) => Some(Value::Double(v)),
            DefaultValue::String(v) => Some(Value::String(v.to_owned())),
            DefaultValue::Doubles(v) => Some(Value::DoubleArray(v.to_vec())),
            DefaultValue::Strings(v) => Some(Value::StringArray(v.iter().map(|s| (*s).to_owned()).collect())),
        }
    }
}

/// One row of the table.
#[derive(Clone, Copy, Debug)]
pub struct ParameterSpec {
    /// Full dotted name.
    pub name: &'static str,
    /// Type.
    pub kind: Kind,
    /// SI unit as text; empty for a number without unit and for text.
    pub unit: &'static str,
    /// Value when nobody sets it.
    pub default: DefaultValue,
    /// What each number or text may be.
    pub check: Check,
    /// How many entries an array may have.
    pub length: Length,
    /// May be set while the node runs.
    pub live: bool,
    /// The nodes that use it.
    pub owners: &'static [Node],
    /// One sentence: what it means.
    pub help: &'static str,
}

impl ParameterSpec {
    /// What is accepted, in words: type, length and range, as error messages and the README say it.
    pub fn accepted(&self) -> String {
        let mut text = self.kind.in_words().to_owned();
        let range = self.range();
        if !range.is_empty() {
            text.push_str(&format!(", {range}"));
        }
        if !self.unit.is_empty() {
            text.push_str(&format!(" [{}]", self.unit));
        }
        text
    }

    /// Length of an array and range of its entries in words; empty when anything of the type is accepted.
    pub fn range(&self) -> String {
        let parts = [self.length.in_words(), self.check.to_string()];
        parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ")
    }

    /// Whether `node` uses the parameter.
    pub fn used_by(&self, node: Node) -> bool {
        self.owners.contains(&node)
    }
}

/// Every parameter of every node, in the order in which documentation lists them.
pub fn schema() -> impl Iterator<Item = &'static ParameterSpec> {
    [
        body::PARAMETERS,
        chains::PARAMETERS,
        surface::PARAMETERS,
        session::PARAMETERS,
        device::PARAMETERS,
        safety::PARAMETERS,
        backends::PARAMETERS,
        simulated::PARAMETERS,
        visualization::PARAMETERS,
        viewer::PARAMETERS,
        recording::PARAMETERS,
    ]
    .into_iter()
    .flatten()
}

/// The row of one parameter.
pub fn spec(name: &str) -> Option<&'static ParameterSpec> {
    schema().find(|spec| spec.name == name)
}

/// The known name most like `name`, when one is near enough to be what was meant.
pub fn nearest_name(name: &str) -> Option<&'static str> {
    schema()
        .map(|spec| (strsim::jaro_winkler(spec.name, name), spec.name))
        .filter(|(similarity, _)| *similarity > 0.6)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}
