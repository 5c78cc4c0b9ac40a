//! Between ROS parameter values and the scene's.

use r2r::ParameterValue as Override;
use r2r::rcl_interfaces::msg::{ParameterType, ParameterValue as Message};
use scene::{Kind, Value};

const NOT_SET: u8 = ParameterType::PARAMETER_NOT_SET as u8;
const BOOL: u8 = ParameterType::PARAMETER_BOOL as u8;
const INTEGER: u8 = ParameterType::PARAMETER_INTEGER as u8;
const DOUBLE: u8 = ParameterType::PARAMETER_DOUBLE as u8;
const STRING: u8 = ParameterType::PARAMETER_STRING as u8;
const BOOL_ARRAY: u8 = ParameterType::PARAMETER_BOOL_ARRAY as u8;
const INTEGER_ARRAY: u8 = ParameterType::PARAMETER_INTEGER_ARRAY as u8;
const DOUBLE_ARRAY: u8 = ParameterType::PARAMETER_DOUBLE_ARRAY as u8;
const STRING_ARRAY: u8 = ParameterType::PARAMETER_STRING_ARRAY as u8;

/// A value that rcl read from a file or the command line; an error names the type when no parameter has it.
pub(super) fn from_override(value: &Override) -> Result<Value, &'static str> {
    Ok(match value.clone() {
        Override::Bool(v) => Value::Bool(v),
        Override::Integer(v) => Value::Integer(v),
        Override::Double(v) => Value::Double(v),
        Override::String(v) => Value::String(v),
        Override::BoolArray(v) => Value::BoolArray(v),
        Override::IntegerArray(v) => Value::IntegerArray(v),
        Override::DoubleArray(v) => Value::DoubleArray(v),
        Override::StringArray(v) => Value::StringArray(v),
        Override::ByteArray(_) => return Err("an array of bytes"),
        Override::NotSet => return Err("no value"),
    })
}

/// A value in a service request; an error names the type when no parameter has it.
pub(super) fn from_message(message: &Message) -> Result<Value, &'static str> {
    Ok(match message.type_ {
        BOOL => Value::Bool(message.bool_value),
        INTEGER => Value::Integer(message.integer_value),
        DOUBLE => Value::Double(message.double_value),
        STRING => Value::String(message.string_value.clone()),
        BOOL_ARRAY => Value::BoolArray(message.bool_array_value.clone()),
        INTEGER_ARRAY => Value::IntegerArray(message.integer_array_value.clone()),
        DOUBLE_ARRAY => Value::DoubleArray(message.double_array_value.clone()),
        STRING_ARRAY => Value::StringArray(message.string_array_value.clone()),
        NOT_SET => return Err("no value: a parameter cannot be unset"),
        _ => return Err("of a type that no parameter has"),
    })
}

/// A value for a service response; without one, "not set".
pub(super) fn to_message(value: Option<&Value>) -> Message {
    let Some(value) = value else { return Message::default() };
    let mut message = Message::default();
    match value.clone() {
        Value::Bool(v) => (message.type_, message.bool_value) = (BOOL, v),
        Value::Integer(v) => (message.type_, message.integer_value) = (INTEGER, v),
        Value::Double(v) => (message.type_, message.double_value) = (DOUBLE, v),
        Value::String(v) => (message.type_, message.string_value) = (STRING, v),
        Value::BoolArray(v) => (message.type_, message.bool_array_value) = (BOOL_ARRAY, v),
        Value::IntegerArray(v) => (message.type_, message.integer_array_value) = (INTEGER_ARRAY, v),
        Value::DoubleArray(v) => (message.type_, message.double_array_value) = (DOUBLE_ARRAY, v),
        Value::StringArray(v) => (message.type_, message.string_array_value) = (STRING_ARRAY, v),
    }
    message
}

/// The type of a parameter in rcl_interfaces' numbers.
pub(super) fn type_number(kind: Kind) -> u8 {
    match kind {
        Kind::Bool => BOOL,
        Kind::Integer => INTEGER,
        Kind::Double => DOUBLE,
        Kind::String => STRING,
        Kind::IntegerArray => INTEGER_ARRAY,
        Kind::DoubleArray => DOUBLE_ARRAY,
        Kind::StringArray => STRING_ARRAY,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_survives_a_service_call() {
        for value in [
            Value::Bool(true),
            Value::Integer(-3),
            Value::Double(0.1),
            Value::String("liver".to_owned()),
            Value::BoolArray(vec![true, false]),
            Value::IntegerArray(vec![1, 2]),
            Value::DoubleArray(vec![0.5]),
            Value::StringArray(vec![String::new(), "left".to_owned()]),
        ] {
            assert_eq!(from_message(&to_message(Some(&value))), Ok(value));
        }
        assert_eq!(to_message(None).type_, NOT_SET);
        assert!(from_message(&Message::default()).is_err());
        assert!(from_message(&Message { type_: 99, ..Message::default() }).is_err());
    }
}
