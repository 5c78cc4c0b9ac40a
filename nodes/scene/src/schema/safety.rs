//! `safety.*` and `unsafe.*`: what stands between any source of force and any motor. The ranges here are what makes sense;
//! what is safe for a hand is narrower and belongs to the safety layer, which `unsafe.parameters` overrules by name.

use super::row::{integer, number, switch};
use super::{Check, DefaultValue, Kind, Length, Node, ParameterSpec};

pub(super) const PARAMETERS: &[ParameterSpec] = &[
    number(
        "safety.slew",
        "N/s",
        2000.0,
        Check::Above(0.0),
        "The force on the hand changes no faster than this, and in no command by more than this times 2 ms.",
    ),
    number(
        "safety.torque_slew",
        "N m/s",
        50.0,
        Check::Above(0.0),
        "The torque on the hand changes no faster than this, and in no command by more than this times 2 ms.",
    ),
    number(
        "safety.gripper_slew",
        "N/s",
        1000.0,
        Check::Above(0.0),
        "The gripper's force on the fingers changes no faster than this, and in no command by more than this times 2 ms.",
    ),
    number(
        "safety.max_power",
        "W",
        10.0,
        Check::Above(0.0),
        "The motors push a moving hand with no more than this.",
    ),
    number(
        "safety.max_speed",
        "m/s",
        1.5,
        Check::Above(0.0),
        "A handle that is faster is a fault: the force goes, and stays away until a command.",
    ),
    number(
        "safety.engage_force",
        "N",
        0.2,
        Check::AtLeast(0.0),
        "After a start the force begins only when the commanded one has been smaller than this for safety.engage_ticks periods.",
    ),
    integer("safety.engage_ticks", 5, Check::Within(0.0, 100_000.0), "See safety.engage_force."),
    number(
        "safety.engage_ramp",
        "s",
        2.0,
        Check::Within(0.0, 60.0),
        "Time in which the force then grows from nothing to what is commanded.",
    ),
    number(
        "safety.servo_validity",
        "s",
        0.02,
        Check::Above(0.0),
        "A commanded force is used in full for this long.",
    ),
    number(
        "safety.law_validity",
        "s",
        0.1,
        Check::Above(0.0),
        "A contact law is used in full for this long after its pose, or as long as it says itself if that is shorter.",
    ),
    number(
        "safety.decay",
        "s",
        0.03,
        Check::AtLeast(0.0),
        "Time in which the force of a source that is no longer valid falls to nothing.",
    ),
    switch(
        "safety.passivity",
        true,
        "The contact law and a hold give the hand no more energy than it has put in; damping takes out the rest.",
    ),
    switch(
        "safety.servo_passivity",
        false,
        "The same for commanded wrenches, which then cannot guide or pull a hand: for a contact that is answered late.",
    ),
    number(
        "safety.workspace_margin",
        "m",
        0.005,
        Check::Within(0.0, 0.1),
        "Over this distance to the edge of the device's workspace forces that push outward fade.",
    ),
    number(
        "safety.ros_timeout",
        "s",
        1.0,
        Check::Above(0.0),
        "A ROS thread that has not been heard of for this long is a fault.",
    ),
    ParameterSpec {
        name: "unsafe.parameters",
        kind: Kind::StringArray,
        unit: "",
        default: DefaultValue::Strings(&[""]),
        check: Check::Any,
        length: Length::AtLeastOne,
        live: false,
        owners: &[Node::HapticDevice],
        help: "Names of safety parameters whose values may lie outside what is safe for a hand; [\"\"]: none may.",
    },
];
