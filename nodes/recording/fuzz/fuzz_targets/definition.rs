//! Any text as the recorded definition of each type.
#![no_main]

use libfuzzer_sys::fuzz_target;
use recording::messages::same_definition;

const TYPES: [&str; 6] = [
    "geometry_msgs/msg/PoseStamped",
    "tf2_msgs/msg/TFMessage",
    "sensor_msgs/msg/Joy",
    "shape_msgs/msg/Mesh",
    "rhombus_haptics_msgs/msg/ContactState",
    "rhombus_haptics_msgs/msg/ContactLaw",
];

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes);
    for name in TYPES {
        let _ = same_definition(name, &text, "ros2msg");
    }
});
