//! The ROS 2 value of a YAML node: scalars, and lists whose entries all have one type.

use crate::schema::ParameterSpec;
use crate::yaml::{Content, Tree};
use crate::{Problem, Value};

/// The ROS value of a scalar or of a list whose entries all have one type.
pub(crate) fn value_of(content: &Content) -> Option<Value> {
    match content {
        Content::Null | Content::Map(_) => None,
        Content::Bool(v) => Some(Value::Bool(*v)),
        Content::Integer(v) => Some(Value::Integer(*v)),
        Content::Double(v) => Some(Value::Double(*v)),
        Content::Text(v) => Some(Value::String(v.clone())),
        Content::List(items) => {
            fn all<T>(items: &[Tree], take: impl Fn(&Content) -> Option<T>) -> Option<Vec<T>> {
                items.iter().map(|item| take(&item.content)).collect()
            }
            all(items, |c| if let Content::Double(v) = c { Some(*v) } else { None })
                .map(Value::DoubleArray)
                .or_else(|| {
                    all(items, |c| if let Content::Integer(v) = c { Some(*v) } else { None })
                        .map(Value::IntegerArray)
                })
                .or_else(|| {
                    all(items, |c| if let Content::Text(v) = c { Some(v.clone()) } else { None })
                        .map(Value::StringArray)
                })
                .or_else(|| {
                    all(items, |c| if let Content::Bool(v) = c { Some(*v) } else { None })
                        .map(Value::BoolArray)
                })
        }
    }
}

/// Why a list has no ROS value.
pub(crate) fn mixed(items: &[Tree], spec: &ParameterSpec, list: &Content) -> Problem {
    let first = items.first().map_or("nothing", |item| item.content.type_in_words());
    let other = items.iter().map(|item| item.content.type_in_words()).find(|words| *words != first);
    match other {
        Some(other) => {
            Problem::MixedArray { value: list.to_string(), first, other, accepted: spec.accepted() }
        }
        None => Problem::WrongType {
            value: list.to_string(),
            found: "an array whose entries are not scalars",
            accepted: spec.accepted(),
            hint: "",
        },
    }
}
