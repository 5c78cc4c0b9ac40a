//! The one error of this crate: where (file, line, key), what was found, what is accepted.

use std::fmt;

/// Why a parameter file, a set of parameter values or a mesh file was refused.
///
/// Displayed as `file:line: key: what is wrong`, with the value and what is accepted in the last part.
#[derive(Debug, thiserror::Error)]
pub struct SceneError {
    /// The file, or what the caller named as the source of the values.
    pub file: String,
    /// Line in the file, counted from 1, where it is known.
    pub line: Option<usize>,
    /// Dotted parameter name, where one parameter is to blame.
    pub key: Option<String>,
    /// What is wrong.
    pub problem: Box<Problem>,
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.file)?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        if let Some(key) = &self.key {
            write!(f, ": {key}")?;
        }
        write!(f, ": {}", self.problem)
    }
}

/// What is wrong, without the place.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(std::io::Error),
    /// The file has no content.
    #[error("the file is empty; {accepted}")]
    Empty {
        /// What the file has to contain.
        accepted: &'static str,
    },
    /// The text is not YAML.
    #[error("not valid YAML: {0}")]
    Syntax(String),
    /// YAML, but not the shape of a ROS 2 parameter file.
    #[error("{0}")]
    Layout(String),
    /// A parameter that no node has.
    #[error("unknown parameter{}; `rhombus parameters` lists all", did_you_mean(*nearest))]
    UnknownKey {
        /// The known name most like it.
        nearest: Option<&'static str>,
    },
    /// The value is of another type.
    #[error("{value} is {found}; accepted: {accepted}{hint}")]
    WrongType {
        /// The value as written.
        value: String,
        /// Its type in words.
        found: &'static str,
        /// What the parameter accepts.
        accepted: String,
        /// What to write instead, where that is known; starts with a separator.
        hint: &'static str,
    },
    /// An array with entries of several types.
    #[error("{value} mixes {first} with {other}, which ROS 2 refuses; accepted: {accepted}")]
    MixedArray {
        /// The value as written.
        value: String,
        /// Type of the first entry.
        first: &'static str,
        /// Type of the entry that differs.
        other: &'static str,
        /// What is accepted.
        accepted: String,
    },
    /// The value has the right type and is not in the range.
    #[error("{value} is not accepted{}; accepted: {accepted}", entry(*index))]
    OutOfRange {
        /// The value, or the entry of an array that is out of range.
        value: String,
        /// Which entry of an array, counted from 0.
        index: Option<usize>,
        /// What the parameter accepts.
        accepted: String,
    },
    /// The array has another number of entries than it must have.
    #[error("{value} has {found} entries; accepted: {accepted}")]
    Length {
        /// The value as written.
        value: String,
        /// Its number of entries.
        found: usize,
        /// What the parameter accepts.
        accepted: String,
    },
    /// The arrays of `chains.*` do not have one entry for each chain.
    #[error(
        "has {found} entries and {reference} has {expected}; every chains.* array has one entry for each chain"
    )]
    UnequalLengths {
        /// Entries of the array to blame.
        found: usize,
        /// The array it is compared with.
        reference: &'static str,
        /// Entries of that one.
        expected: usize,
    },
    /// A required parameter is not given.
    #[error("missing; it has no default; accepted: {accepted}")]
    Missing {
        /// What the parameter accepts.
        accepted: String,
    },
    /// The same parameter twice in one section.
    #[error("given twice in one section; the first is in line {first_line}")]
    Duplicate {
        /// Line of the first.
        first_line: usize,
    },
    /// Two sections give different values.
    #[error("{value} here and {other} in section {other_section}; one value is accepted for all sections")]
    Conflict {
        /// The value as written here.
        value: String,
        /// The value as written in the other section.
        other: String,
        /// The other section's name.
        other_section: String,
    },
    /// A driver's own section sets what only other nodes read.
    #[error(
        "in section {section}, but read by {owners} only; accepted in /** or in the section of one of those"
    )]
    OtherNodes {
        /// The driver's section.
        section: String,
        /// Who reads the parameter.
        owners: String,
    },
    /// A driver's own section differs from what other nodes read.
    #[error(
        "{value} in section {section}, but {with} would take {theirs}; one value is accepted for all who read it"
    )]
    Shared {
        /// The driver's section.
        section: String,
        /// The value as written there.
        value: String,
        /// The other readers.
        with: String,
        /// What they read.
        theirs: String,
    },
    /// A driver's own section is in front of one that says otherwise.
    #[error(
        "{value} in section {section} would be overruled by {other} in section {other_section}, which comes later in the \
         file; accepted: in the reverse order"
    )]
    Overruled {
        /// The driver's section.
        section: String,
        /// The value as written there.
        value: String,
        /// The later section.
        other_section: String,
        /// The value as written in it.
        other: String,
    },
    /// The values are each accepted, but not together.
    #[error("{0}")]
    Model(String),
    /// A mesh file that is not a closed triangle surface.
    #[error("{0}")]
    Mesh(String),
    /// A stiffness map that does not fit its mesh, or is none.
    #[error("{0}")]
    Stiffness(String),
    /// A calibrated body that does not fit its mesh or its chains, or is none.
    #[error("{0}")]
    Response(String),
}

fn did_you_mean(nearest: Option<&'static str>) -> String {
    nearest.map(|name| format!("; did you mean {name}?")).unwrap_or_default()
}

fn entry(index: Option<usize>) -> String {
    index.map(|i| format!(" (entry {i}, counted from 0)")).unwrap_or_default()
}
