//! The text of a type that this crate knows, as rosbag2 stores it, without an installed ROS 2.

use super::shape_of;
use crate::MessageDefinition;
use crate::cdr::Shape;

/// Between the text of a message and those of the messages in it.
const SEPARATOR: usize = 80;

/// The definition of a type that this crate reads and writes: the fields without comments and constants, and no hash, which
/// only an installed ROS 2 knows. `None` for other types.
pub fn own_definition(type_name: &str) -> Option<MessageDefinition> {
    let shape = shape_of(type_name)?;
    let mut text = String::new();
    fields_of(&shape, &mut text);
    let mut nested = Vec::new();
    collect(&shape, &mut nested);
    for message in nested {
        text.push_str(&"=".repeat(SEPARATOR));
        text.push_str(&format!("\nMSG: {}\n", named(message)));
        fields_of(message, &mut text);
    }
    Some(MessageDefinition { encoding: "ros2msg".to_owned(), text, type_hash: String::new() })
}

fn fields_of(shape: &Shape, text: &mut String) {
    if let Shape::Message { fields, .. } = shape {
        for (name, field) in fields {
            text.push_str(&format!("{} {name}\n", named(field)));
        }
    }
}

/// Every message in a shape once, in the order in which a reader meets them.
fn collect<'a>(shape: &'a Shape, nested: &mut Vec<&'a Shape>) {
    match shape {
        Shape::Primitive(_) => {}
        Shape::Sequence(of) | Shape::Array(of, _) => meet(of, nested),
        Shape::Message { fields, .. } => fields.iter().for_each(|(_, field)| meet(field, nested)),
    }
}

fn meet<'a>(field: &'a Shape, nested: &mut Vec<&'a Shape>) {
    if matches!(field, Shape::Message { .. }) {
        if nested.contains(&field) {
            return;
        }
        nested.push(field);
    }
    collect(field, nested);
}

/// As a `.msg` file writes the type of a field.
fn named(shape: &Shape) -> String {
    match shape {
        Shape::Primitive(name) => (*name).to_owned(),
        Shape::Sequence(of) => format!("{}[]", named(of)),
        Shape::Array(of, count) => format!("{}[{count}]", named(of)),
        Shape::Message { type_name, .. } => type_name.replacen("/msg/", "/", 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::messages::same_definition;

    #[test]
    fn a_definition_says_the_fields_of_the_type_and_of_the_types_in_it() {
        let definition = own_definition("geometry_msgs/msg/WrenchStamped").unwrap();
        let sections: Vec<&str> = definition.text.split(&"=".repeat(80)).collect();
        assert_eq!(sections[0], "std_msgs/Header header\ngeometry_msgs/Wrench wrench\n");
        assert_eq!(sections[1], "\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n");
        assert_eq!(sections.len(), 5, "Header, Time, Wrench, Vector3 once");
        assert_eq!(own_definition("elsewhere_msgs/msg/Gadget"), None);
    }

    #[test]
    fn what_is_written_is_what_is_accepted() {
        for name in ["ContactState", "ContactLaw", "SurfaceDisplacement"] {
            let name = format!("rhombus_haptics_msgs/msg/{name}");
            let definition = own_definition(&name).unwrap();
            same_definition(&name, &definition.text, &definition.encoding).unwrap();
        }
    }
}
