//! `force_dimension.*`, `haply.*`, `serial.*`, `spacemouse.*`, `pointer.*`: what the backends need to know. The hand of the
//! pointer is that of `simulated.*`.

use super::row::{integer, number, text};
use super::{Check, ParameterSpec};

pub(super) const PARAMETERS: &[ParameterSpec] = &[
    text("force_dimension.sdk", "", "Folder of the Force Dimension SDK that is looked into first."),
    text("haply.url", "ws://localhost:10001", "Address of the Haply Inverse service."),
    text(
        "haply.grip",
        "",
        "Id of the handle whose orientation and buttons are used; \"\": the only one, if there is one.",
    ),
    number(
        "haply.max_force",
        "N",
        2.0,
        Check::Within(0.01, 20.0),
        "The largest force of this device, which its service does not say.",
    ),
    text(
        "serial.port",
        "",
        "Serial port of a self-built device, or a folder of ports; \"\": the only USB serial port at which one answers.",
    ),
    integer(
        "serial.baud",
        921_600,
        Check::Within(57_600.0, 12_000_000.0),
        "Speed of the serial port, bits per second; without meaning where the port is USB throughout.",
    ),
    number(
        "spacemouse.linear_speed",
        "m/s",
        0.05,
        Check::Within(0.0, 1.0),
        "Speed of the virtual handle at full deflection.",
    ),
    number(
        "spacemouse.angular_speed",
        "rad/s",
        0.8,
        Check::Within(0.0, 10.0),
        "Angular speed of the virtual handle at full deflection.",
    ),
    number(
        "spacemouse.full_scale",
        "",
        350.0,
        Check::Within(1.0, 32767.0),
        "Reading of an axis at full deflection.",
    ),
    number(
        "spacemouse.deadband",
        "",
        0.03,
        Check::WithinBelow(0.0, 1.0),
        "Share of full deflection below which an axis is taken as released.",
    ),
    number(
        "pointer.max_speed",
        "m/s",
        0.5,
        Check::Within(0.001, 1.0),
        "The hand follows pointer_target no faster than this; less than safety.max_speed.",
    ),
    number(
        "pointer.timeout",
        "s",
        0.3,
        Check::Within(0.02, 10.0),
        "A target on pointer_target counts for this long after its stamp; then the hand lets go.",
    ),
];
