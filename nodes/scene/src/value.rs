//! A parameter value as ROS 2 knows it.

use std::fmt;

/// What a parameter file, a node or a service call gives for one parameter: the value types of
/// `rcl_interfaces/msg/ParameterValue` that this project uses.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// `true` or `false`.
    Bool(bool),
    /// A whole number.
    Integer(i64),
    /// A number with a decimal point or an exponent.
    Double(f64),
    /// Text.
    String(String),
    /// An array of `true` and `false`.
    BoolArray(Vec<bool>),
    /// An array of whole numbers.
    IntegerArray(Vec<i64>),
    /// An array of numbers with a decimal point or an exponent.
    DoubleArray(Vec<f64>),
    /// An array of text.
    StringArray(Vec<String>),
}

impl Value {
    /// The type in words, with its article: "an integer", "an array of strings".
    pub fn type_in_words(&self) -> &'static str {
        match self {
            Value::Bool(_) => "a boolean",
            Value::Integer(_) => "an integer",
            Value::Double(_) => "a number",
            Value::String(_) => "a string",
            Value::BoolArray(_) => "an array of booleans",
            Value::IntegerArray(_) => "an array of integers",
            Value::DoubleArray(_) => "an array of numbers",
            Value::StringArray(_) => "an array of strings",
        }
    }

    /// Number of entries of an array; none for a scalar.
    pub fn array_length(&self) -> Option<usize> {
        match self {
            Value::BoolArray(v) => Some(v.len()),
            Value::IntegerArray(v) => Some(v.len()),
            Value::DoubleArray(v) => Some(v.len()),
            Value::StringArray(v) => Some(v.len()),
            _ => None,
        }
    }
}

/// As a parameter file would write it; reading it back gives the same value and type.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fn array<T>(
            f: &mut fmt::Formatter<'_>,
            items: &[T],
            one: impl Fn(&T, &mut fmt::Formatter<'_>) -> fmt::Result,
        ) -> fmt::Result {
            f.write_str("[")?;
            for (i, item) in items.iter().enumerate() {
                if i > 0 {
                    f.write_str(", ")?;
                }
                one(item, f)?;
            }
            f.write_str("]")
        }
        match self {
            Value::Bool(v) => write!(f, "{v}"),
            Value::Integer(v) => write!(f, "{v}"),
            // Debug keeps the ".0" that tells a float from an integer, and round-trips.
            Value::Double(v) => write!(f, "{v:?}"),
            Value::String(v) => write!(f, "{v:?}"),
            Value::BoolArray(v) => array(f, v, |x, f| write!(f, "{x}")),
            Value::IntegerArray(v) => array(f, v, |x, f| write!(f, "{x}")),
            Value::DoubleArray(v) => array(f, v, |x, f| write!(f, "{x:?}")),
            Value::StringArray(v) => array(f, v, |x, f| write!(f, "{x:?}")),
        }
    }
}
