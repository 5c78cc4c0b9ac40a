//! Prints a recording as JSON lines: `print_recording PATH`. First the topics, then each message with its values where
//! this crate knows the type.
#![expect(clippy::print_stdout, reason = "printing is what it is for")]

use recording::Recording;
use recording::cdr::{CdrError, Message, decode};
use recording::messages::*;
use serde::Serialize;
use serde_json::{Value, json};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("usage: print_recording PATH")?;
    let recording = Recording::open(path)?;
    for damage in recording.damage() {
        println!("{}", json!({ "damage": damage.to_string() }));
    }
    for found in recording.topics() {
        let topic = &found.topic;
        println!(
            "{}",
            json!({
                "topic": topic.name, "type": topic.type_name, "count": found.message_count, "qos": topic.offered_qos,
                "hash": topic.definition.type_hash, "definition": topic.definition.text,
            })
        );
    }
    for message in recording.messages() {
        let message = message?;
        let topic = recording.topics().get(message.topic).ok_or("a message without a topic")?;
        let value = values(&topic.topic.type_name, &message.data)?;
        println!("{}", json!({ "on": topic.topic.name, "log_time_ns": message.log_time_ns, "value": value }));
    }
    Ok(())
}

/// The fields of a message; `null` for types this crate does not know.
fn values(type_name: &str, data: &[u8]) -> Result<Value, CdrError> {
    fn of<M: Message + Serialize>(data: &[u8]) -> Result<Value, CdrError> {
        decode::<M>(data).map(|message| json!(message))
    }
    match type_name {
        PoseStamped::TYPE_NAME => of::<PoseStamped>(data),
        WrenchStamped::TYPE_NAME => of::<WrenchStamped>(data),
        Joy::TYPE_NAME => of::<Joy>(data),
        JointState::TYPE_NAME => of::<JointState>(data),
        Bool::TYPE_NAME => of::<Bool>(data),
        ContactState::TYPE_NAME => of::<ContactState>(data),
        SurfaceDisplacement::TYPE_NAME => of::<SurfaceDisplacement>(data),
        _ => Ok(Value::Null),
    }
}
