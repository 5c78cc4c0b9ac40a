//! Parameter values checked one by one against the schema: types, ranges, array lengths, unknown names, defaults.

use std::collections::BTreeMap;

use crate::schema::{Check, Kind, ParameterSpec, nearest_name, schema, spec};
use crate::{Origin, Problem, SceneError, Value};

/// A set of parameter values in which every name is known, every value has the right type and is in its range, and
/// everything that has a default is there.
#[derive(Clone, Debug)]
pub struct Parameters {
    origin: Origin,
    entries: BTreeMap<&'static str, Entry>,
}

#[derive(Clone, Debug)]
struct Entry {
    value: Value,
    /// Ordinal in the YAML document.
    node: Option<usize>,
    given: bool,
}

impl Parameters {
    /// Checks values that did not come from a file of ours: a node's, a test's.
    ///
    /// # Errors
    /// The first name or value, in alphabetical order, that is not accepted.
    pub fn from_values(
        values: impl IntoIterator<Item = (String, Value)>,
        origin: Origin,
    ) -> Result<Parameters, SceneError> {
        let mut parameters = Parameters::defaults(origin);
        let values: BTreeMap<String, Value> = values.into_iter().collect();
        for (name, value) in values {
            parameters.set(&name, value, None)?;
        }
        Ok(parameters)
    }

    /// Nothing given: every default, and nothing for what has none.
    pub fn defaults(origin: Origin) -> Parameters {
        let entries = schema()
            .filter_map(|spec| {
                Some((spec.name, Entry { value: spec.default.value()?, node: None, given: false }))
            })
            .collect();
        Parameters { origin, entries }
    }

    /// These values with one changed, for setting a parameter of a running node.
    ///
    /// # Errors
    /// The name is unknown or the value not accepted. Whether the values fit together is
    /// [`Scene::from_parameters`](crate::Scene::from_parameters)' question.
    pub fn with(&self, name: &str, value: Value) -> Result<Parameters, SceneError> {
        let mut changed = self.clone();
        changed.set(name, value, None)?;
        Ok(changed)
    }

    pub(crate) fn set(&mut self, name: &str, value: Value, node: Option<usize>) -> Result<(), SceneError> {
        let checked = match spec(name) {
            Some(spec) => check(spec, value).map(|value| (spec.name, value)),
            None => Err(Problem::UnknownKey { nearest: nearest_name(name) }),
        };
        let (name, value) = checked.map_err(|problem| self.origin.error(Some(name), node, problem))?;
        self.entries.insert(name, Entry { value, node, given: true });
        Ok(())
    }

    /// Takes over what was given there, without its places in that text.
    pub(crate) fn take_given(&mut self, other: Parameters) {
        let given = other.entries.into_iter().filter(|(_, entry)| entry.given);
        self.entries.extend(given.map(|(name, entry)| (name, Entry { node: None, ..entry })));
    }

    /// Where the values come from.
    pub fn origin(&self) -> &Origin {
        &self.origin
    }

    /// Value of a parameter: the given one or the default. None when it is required or computed and not given.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.entries.get(name).map(|entry| &entry.value)
    }

    /// Whether somebody gave the parameter, rather than leaving its default.
    pub fn is_given(&self, name: &str) -> bool {
        self.entries.get(name).is_some_and(|entry| entry.given)
    }

    /// A boolean.
    ///
    /// # Errors
    /// The parameter is missing and has no default.
    pub fn bool(&self, name: &str) -> Result<bool, SceneError> {
        self.typed(name, |value| if let Value::Bool(v) = value { Some(*v) } else { None })
    }

    /// An integer.
    ///
    /// # Errors
    /// The parameter is missing and has no default.
    pub fn integer(&self, name: &str) -> Result<i64, SceneError> {
        self.typed(name, |value| if let Value::Integer(v) = value { Some(*v) } else { None })
    }

    /// A number.
    ///
    /// # Errors
    /// The parameter is missing and has no default.
    pub fn double(&self, name: &str) -> Result<f64, SceneError> {
        self.typed(name, |value| if let Value::Double(v) = value { Some(*v) } else { None })
    }

    /// A text.
    ///
    /// # Errors
    /// The parameter is missing and has no default.
    pub fn text(&self, name: &str) -> Result<&str, SceneError> {
        self.typed(name, |value| if let Value::String(v) = value { Some(v.as_str()) } else { None })
    }

    /// An array of integers.
    ///
    /// # Errors
    /// The parameter is missing and has no default.
    pub fn integers(&self, name: &str) -> Result<&[i64], SceneError> {
        self.typed(name, |value| if let Value::IntegerArray(v) = value { Some(v.as_slice()) } else { None })
    }

    /// An array of numbers.
    ///
    /// # Errors
    /// The parameter is missing and has no default.
    pub fn doubles(&self, name: &str) -> Result<&[f64], SceneError> {
        self.typed(name, |value| if let Value::DoubleArray(v) = value { Some(v.as_slice()) } else { None })
    }

    /// An array of texts.
    ///
    /// # Errors
    /// The parameter is missing and has no default.
    pub fn texts(&self, name: &str) -> Result<&[String], SceneError> {
        self.typed(name, |value| if let Value::StringArray(v) = value { Some(v.as_slice()) } else { None })
    }

    fn typed<'a, T>(&'a self, name: &str, take: impl Fn(&'a Value) -> Option<T>) -> Result<T, SceneError> {
        self.get(name).and_then(take).ok_or_else(|| {
            let accepted = spec(name).map(ParameterSpec::accepted).unwrap_or_default();
            self.error(name, Problem::Missing { accepted })
        })
    }

    /// An error about one parameter, with its place in the file.
    pub(crate) fn error(&self, name: &str, problem: Problem) -> SceneError {
        let node = self.entries.get(name).and_then(|entry| entry.node);
        self.origin.error(Some(name), node, problem)
    }
}

/// The value as the parameter keeps it, when it is accepted.
pub(crate) fn check(spec: &ParameterSpec, value: Value) -> Result<Value, Problem> {
    let value = match (spec.kind, value) {
        (Kind::Double, Value::Integer(v)) => Value::Double(v as f64),
        // An empty array has no type of its own.
        (kind, value) if value.array_length() == Some(0) => empty_array(kind).unwrap_or(value),
        (_, value) => value,
    };
    let right_type = matches!(
        (spec.kind, &value),
        (Kind::Bool, Value::Bool(_))
            | (Kind::Integer, Value::Integer(_))
            | (Kind::Double, Value::Double(_))
            | (Kind::String, Value::String(_))
            | (Kind::IntegerArray, Value::IntegerArray(_))
            | (Kind::DoubleArray, Value::DoubleArray(_))
            | (Kind::StringArray, Value::StringArray(_))
    );
    if !right_type {
        return Err(Problem::WrongType {
            found: value.type_in_words(),
            hint: hint(spec.kind, &value),
            value: value.to_string(),
            accepted: spec.accepted(),
        });
    }
    if let Some(found) = value.array_length()
        && !spec.length.accepts(found)
    {
        return Err(Problem::Length { value: value.to_string(), found, accepted: spec.accepted() });
    }
    match out_of_range(spec.check, &value) {
        None => Ok(value),
        Some((index, value)) => Err(Problem::OutOfRange { value, index, accepted: spec.accepted() }),
    }
}

fn empty_array(kind: Kind) -> Option<Value> {
    match kind {
        Kind::IntegerArray => Some(Value::IntegerArray(Vec::new())),
        Kind::DoubleArray => Some(Value::DoubleArray(Vec::new())),
        Kind::StringArray => Some(Value::StringArray(Vec::new())),
        Kind::Bool | Kind::Integer | Kind::Double | Kind::String => None,
    }
}

/// What to write instead, for the slips that are easy to make.
fn hint(kind: Kind, found: &Value) -> &'static str {
    match (kind, found) {
        (Kind::DoubleArray, Value::IntegerArray(_)) => "; write every entry with a decimal point, like 1.0",
        (Kind::IntegerArray | Kind::Integer, Value::DoubleArray(_) | Value::Double(_)) => {
            "; write whole numbers without a decimal point"
        }
        (
            Kind::IntegerArray | Kind::DoubleArray | Kind::StringArray,
            Value::Integer(_) | Value::Double(_) | Value::String(_),
        ) => "; write an array of one entry in brackets, like [x]",
        (Kind::Bool, Value::String(_)) => "; write true or false without quotes",
        (Kind::Integer | Kind::Double, Value::String(_)) => "; write the number without quotes or unit",
        (Kind::String, _) => "; write it in quotes",
        _ => "",
    }
}

/// The first entry that is out of range: its index in an array, and itself.
fn out_of_range(check: Check, value: &Value) -> Option<(Option<usize>, String)> {
    fn first<T>(items: &[T], bad: impl Fn(&T) -> bool) -> Option<(usize, &T)> {
        items.iter().enumerate().find(|(_, item)| bad(item))
    }
    match value {
        Value::Integer(v) => (!check.accepts_number(*v as f64)).then(|| (None, v.to_string())),
        Value::Double(v) => (!check.accepts_number(*v)).then(|| (None, format!("{v:?}"))),
        Value::String(v) => (!check.accepts_text(v)).then(|| (None, format!("{v:?}"))),
        Value::IntegerArray(v) => {
            first(v, |x| !check.accepts_number(*x as f64)).map(|(i, x)| (Some(i), x.to_string()))
        }
        Value::DoubleArray(v) => match first(v, |x| !check.accepts_number(*x)) {
            Some((i, x)) => Some((Some(i), format!("{x:?}"))),
            None if check == Check::Pose && !is_pose(v) => Some((None, value.to_string())),
            None => None,
        },
        Value::StringArray(v) => {
            first(v, |x| !check.accepts_text(x)).map(|(i, x)| (Some(i), format!("{x:?}")))
        }
        Value::Bool(_) | Value::BoolArray(_) => None,
    }
}

fn is_pose(entries: &[f64]) -> bool {
    <[f64; 7]>::try_from(entries).is_ok_and(|pose| rhombus_chain::Pose::from_array(pose).is_ok())
}
