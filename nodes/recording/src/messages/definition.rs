//! Whether a recorded definition of a type is the one this crate reads and writes.
//!
//! CDR carries no names: a message of another definition decodes into nonsense, or just fits. So the text in the recording
//! is compared, field by field, with the structs here; and where there is none in `ros2msg`, the hash of the type.

use std::collections::BTreeMap;

use super::hashes::same_hash;
use super::shape_of;
use crate::MessageDefinition;
use crate::cdr::Shape;

/// Whether a recorded definition of a type this crate knows is the one here: by its text, or by its hash where there is no
/// text in `ros2msg`. `false` where neither tells, and for a type this crate does not know.
///
/// # Errors
/// A sentence that says what differs.
pub fn is_same(type_name: &str, recorded: &MessageDefinition) -> Result<bool, String> {
    let MessageDefinition { encoding, text, type_hash } = recorded;
    if shape_of(type_name).is_none() {
        return Ok(false);
    }
    if encoding != IDL && !text.trim().is_empty() {
        return same_definition(type_name, text, encoding).map(|()| true);
    }
    match same_hash(type_name, type_hash) {
        Some(Ok(())) => Ok(true),
        Some(Err(known)) => {
            Err(format!("the type hash of {type_name} is {type_hash} in the recording; accepted: {known}"))
        }
        None => Ok(false),
    }
}

/// The other language of definitions, which is not compared.
const IDL: &str = "ros2idl";

/// Whether a recorded definition of a type this crate knows has the same fields in the same order, nested types included.
/// Comments, blank lines, constants, defaults and bounds do not count: they change nothing on the wire.
///
/// A type this crate does not know, an empty text and `ros2idl` are accepted without a look.
///
/// # Errors
/// A sentence that names the type and the field.
pub fn same_definition(type_name: &str, recorded_text: &str, encoding: &str) -> Result<(), String> {
    let Some(shape) = shape_of(type_name) else { return Ok(()) };
    if recorded_text.trim().is_empty() {
        return Ok(());
    }
    match encoding {
        "" | "ros2msg" => same_message(&shape, &sections(type_name, recorded_text)),
        IDL => Ok(()),
        other => {
            Err(format!("the definition of {type_name} is written in {other:?}; accepted: ros2msg, {IDL}"))
        }
    }
}

/// The types and fields in a text, in an order that does not depend on it: what counts of a definition, whatever its type.
pub(crate) fn fields_of(type_name: &str, text: &str, mut take: impl FnMut(&str)) {
    for (name, fields) in sections(type_name, text) {
        take(&name);
        for (type_name, name) in fields {
            take(type_name);
            take(name);
        }
    }
}

/// A field as a `.msg` text has it: type and name.
type Field<'a> = (&'a str, &'a str);

/// The fields of each message in a text, by short name (`std_msgs/Header`).
fn sections<'a>(type_name: &str, text: &'a str) -> BTreeMap<String, Vec<Field<'a>>> {
    let mut sections = BTreeMap::new();
    let mut name = short(type_name);
    let mut fields = Vec::new();
    for line in text.lines() {
        if let Some(next) = line.trim().strip_prefix("MSG:") {
            // The first text of a name counts, as for every reader.
            sections.entry(std::mem::replace(&mut name, short(next.trim()))).or_insert(fields);
            fields = Vec::new();
        } else {
            fields.extend(field(line));
        }
    }
    sections.entry(name).or_insert(fields);
    sections
}

/// The field a line declares; none for a constant, a comment and the lines between two messages.
fn field(line: &str) -> Option<Field<'_>> {
    let line = line.split('#').next().unwrap_or_default().trim();
    let (type_name, rest) = line.split_once(char::is_whitespace)?;
    let rest = rest.trim_start();
    let end = rest.find(|letter: char| letter.is_whitespace() || letter == '=').unwrap_or(rest.len());
    let (name, rest) = rest.split_at(end);
    (!rest.trim_start().starts_with('=') && !type_name.starts_with('=')).then_some((type_name, name))
}

fn same_message(shape: &Shape, sections: &BTreeMap<String, Vec<Field<'_>>>) -> Result<(), String> {
    let Shape::Message { type_name, fields } = shape else { return Ok(()) };
    // A text that leaves a nested type out says its name, and that has been compared.
    let Some(recorded) = sections.get(&short(type_name)) else { return Ok(()) };
    let package = type_name.split('/').next().unwrap_or_default();
    for (number, (own_name, own)) in fields.iter().enumerate() {
        let Some((recorded_type, recorded_name)) = recorded.get(number) else {
            return Err(format!("{type_name} has no field {own_name} in the recording"));
        };
        if recorded_name != own_name || !same_type(own, recorded_type, package) {
            return Err(format!(
                "field {} of {type_name} is `{recorded_type} {recorded_name}` in the recording; accepted: `{} {own_name}`",
                number + 1,
                written(own)
            ));
        }
        same_message(element(own), sections)?;
    }
    match recorded.get(fields.len()) {
        Some((_, name)) => {
            Err(format!("{type_name} has a field {name} in the recording, which is not known here"))
        }
        None => Ok(()),
    }
}

/// Whether a type in a `.msg` text of `package` says `own`.
fn same_type(own: &Shape, text: &str, package: &str) -> bool {
    let (base, array) = text.strip_suffix(']').and_then(|text| text.split_once('[')).unzip();
    match own {
        Shape::Primitive(name) => {
            // A bound shortens a text and leaves it a text.
            let bare = text.split("<=").next().unwrap_or_default();
            array.is_none() && bare == *name || (*name == "uint8" && matches!(text, "byte" | "char"))
        }
        Shape::Message { type_name, .. } => {
            let full = match text {
                "Header" => "std_msgs/Header".to_owned(),
                text if text.contains('/') => short(text),
                text => format!("{package}/{text}"),
            };
            array.is_none() && full == short(type_name)
        }
        Shape::Sequence(own) => {
            let sequence = array.is_some_and(|size| size.is_empty() || size.starts_with("<="));
            sequence && base.is_some_and(|base| same_type(own, base, package))
        }
        Shape::Array(own, size) => {
            array.is_some_and(|text| text.parse() == Ok(*size))
                && base.is_some_and(|base| same_type(own, base, package))
        }
    }
}

/// The message in a sequence or array, if there is one.
fn element(shape: &Shape) -> &Shape {
    match shape {
        Shape::Sequence(inner) | Shape::Array(inner, _) => element(inner),
        other => other,
    }
}

fn written(shape: &Shape) -> String {
    match shape {
        Shape::Primitive(name) => (*name).to_owned(),
        Shape::Sequence(inner) => format!("{}[]", written(inner)),
        Shape::Array(inner, size) => format!("{}[{size}]", written(inner)),
        Shape::Message { type_name, .. } => short(type_name),
    }
}

/// `std_msgs/Header` for `std_msgs/msg/Header`.
fn short(type_name: &str) -> String {
    type_name.replacen("/msg/", "/", 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "\n================================================================================\n\
        MSG: std_msgs/Header\n# Comment\nbuiltin_interfaces/Time stamp\n\nstring frame_id\n\
        ================================================================================\n\
        MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";
    const JOY: &str =
        "# Reports\nuint8 LEFT = 1\nstd_msgs/Header header # when\nfloat32[] axes\nint32[<=8] buttons";

    fn joy(text: &str) -> Result<(), String> {
        same_definition("sensor_msgs/msg/Joy", &format!("{text}{HEADER}"), "ros2msg")
    }

    #[test]
    fn comments_constants_defaults_and_bounds_do_not_count() {
        assert_eq!(joy(JOY), Ok(()));
        assert_eq!(joy(&JOY.replace("float32[] axes", "std_msgs/X[] NONE=1\nfloat32[] axes [1, 2]")), Ok(()));
        assert_eq!(joy(&JOY.replace("std_msgs/Header", "Header")), Ok(()));
        assert_eq!(same_definition("sensor_msgs/msg/Joy", JOY, "ros2msg"), Ok(()), "nested texts left out");
    }

    #[test]
    fn another_name_type_order_or_number_of_fields_is_refused_with_the_field() {
        let refused = |text: &str, words: &[&str]| {
            let error = joy(text).unwrap_err();
            assert!(words.iter().all(|word| error.contains(word)), "{words:?}: {error}");
        };
        refused(&JOY.replace("axes", "axis"), &["field 2", "sensor_msgs/msg/Joy", "`float32[] axis`"]);
        refused(&JOY.replace("float32[]", "float64[]"), &["`float64[] axes`", "accepted: `float32[] axes`"]);
        refused(&JOY.replace("float32[]", "float32[3]"), &["float32[3] axes"]);
        refused(&JOY.replace("int32[<=8] buttons", ""), &["no field buttons"]);
        refused(&format!("{JOY}\nbool extra"), &["a field extra"]);
        refused("float32[] axes\nstd_msgs/Header header\nint32[] buttons", &["field 1"]);
        let nested = format!("{JOY}{}", HEADER.replace("string frame_id", "string child"));
        let error = same_definition("sensor_msgs/msg/Joy", &nested, "ros2msg").unwrap_err();
        assert!(error.contains("std_msgs/msg/Header") && error.contains("string child"), "{error}");
    }

    #[test]
    fn without_a_text_in_ros2msg_the_hash_of_the_type_tells() {
        let joy = "RIHS01_0d356c79cad3401e35ffeb75a96a96e08be3ef896b8b83841d73e890989372c5";
        let other = joy.replace("0d", "1d");
        let recorded = |encoding: &str, text: &str, hash: &str| {
            let [encoding, text, type_hash] = [encoding, text, hash].map(str::to_owned);
            is_same("sensor_msgs/msg/Joy", &MessageDefinition { encoding, text, type_hash })
        };
        for (encoding, text) in [("ros2idl", "struct Joy {};"), ("ros2msg", ""), ("", "")] {
            assert_eq!(recorded(encoding, text, joy), Ok(true));
            assert_eq!(recorded(encoding, text, ""), Ok(false));
            assert_eq!(recorded(encoding, text, "RIHS01_0d"), Ok(false), "no hash");
            let error = recorded(encoding, text, &other).unwrap_err();
            assert!(error.contains(&other) && error.contains(joy), "{error}");
        }
        assert_eq!(recorded("ros2msg", &format!("{JOY}{HEADER}"), &other), Ok(true), "the text says more");
        assert!(recorded("ros2msg", "bool data", joy).is_err());
        assert_eq!(is_same("other_msgs/msg/Thing", &MessageDefinition::default()), Ok(false));
    }

    #[test]
    fn a_type_of_others_an_empty_text_and_idl_are_accepted() {
        assert_eq!(same_definition("other_msgs/msg/Thing", "int8 a", "ros2msg"), Ok(()));
        assert_eq!(same_definition("sensor_msgs/msg/Joy", " \n", "ros2msg"), Ok(()));
        assert_eq!(same_definition("sensor_msgs/msg/Joy", "struct Joy {};", "ros2idl"), Ok(()));
        assert!(same_definition("sensor_msgs/msg/Joy", "{}", "jsonschema").is_err());
    }
}
