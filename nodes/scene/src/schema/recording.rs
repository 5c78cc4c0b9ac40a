//! `recording.*` and `replay.*`: what is written to and played from recordings.

use super::{Check, DefaultValue, Kind, Length, Node, ParameterSpec};

const RECORDER: &[Node] = &[Node::BagReplay];

pub(super) const PARAMETERS: &[ParameterSpec] = &[
    ParameterSpec {
        name: "recording.directory",
        kind: Kind::String,
        unit: "",
        default: DefaultValue::String("recordings"),
        check: Check::Any,
        length: Length::Any,
        live: false,
        owners: RECORDER,
        help: "Folder that gets one sub-folder for each recording.",
    },
    ParameterSpec {
        name: "recording.topics",
        kind: Kind::StringArray,
        unit: "",
        default: DefaultValue::Strings(&[""]),
        check: Check::Any,
        length: Length::AtLeastOne,
        live: false,
        owners: RECORDER,
        help: "Topics to record; [\"\"] records every topic of the session.",
    },
    ParameterSpec {
        name: "replay.path",
        kind: Kind::String,
        unit: "",
        default: DefaultValue::String(""),
        check: Check::Any,
        length: Length::Any,
        live: false,
        owners: RECORDER,
        help: "Recording to play: a folder with metadata.yaml, or an .mcap file.",
    },
    ParameterSpec {
        name: "replay.rate",
        kind: Kind::Double,
        unit: "",
        default: DefaultValue::Double(1.0),
        check: Check::Within(0.01, 100.0),
        length: Length::Any,
        live: false,
        owners: RECORDER,
        help: "Speed of replay; 1 plays at the recorded speed.",
    },
];
