//! What can be wrong with the device.

use devices::serial::wire::{Hello, State};

/// One thing that is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    None,
    /// Sends noise instead of frames.
    Garbage,
    /// Loses the second half of every frame but its end.
    HalfFrames,
    /// Never says a word.
    Silent,
    /// Says states, never hello.
    NoHello,
    /// Says hello, never a state.
    NoStates,
    /// Speaks an earlier version of the protocol.
    OldProtocol,
    ZeroForce,
    NanForce,
    ZeroWorkspace,
    /// Has motors and no watchdog.
    NoWatchdog,
    /// A serial number that is no text.
    NoText,
    ZeroQuaternion,
    NanPosition,
    /// Has another number of joints in its states than in its hello.
    OtherJoints,
    /// Every 10th state gets lost.
    Dropped,
    /// Every 10th state comes after the next.
    Reordered,
    /// Every 10th state comes twice.
    Repeated,
    /// Every 10th command arrives with a wrong byte.
    BadCommands,
    /// Sends no more states once the motors are on.
    Mute,
}

impl Fault {
    const ALL: [(&'static str, Fault); 20] = [
        ("none", Fault::None),
        ("garbage", Fault::Garbage),
        ("half-frames", Fault::HalfFrames),
        ("silent", Fault::Silent),
        ("no-hello", Fault::NoHello),
        ("no-states", Fault::NoStates),
        ("old-protocol", Fault::OldProtocol),
        ("zero-force", Fault::ZeroForce),
        ("nan-force", Fault::NanForce),
        ("zero-workspace", Fault::ZeroWorkspace),
        ("no-watchdog", Fault::NoWatchdog),
        ("no-text", Fault::NoText),
        ("zero-quaternion", Fault::ZeroQuaternion),
        ("nan-position", Fault::NanPosition),
        ("other-joints", Fault::OtherJoints),
        ("dropped", Fault::Dropped),
        ("reordered", Fault::Reordered),
        ("repeated", Fault::Repeated),
        ("bad-commands", Fault::BadCommands),
        ("mute", Fault::Mute),
    ];
    pub(crate) const NAMES: &str = "none garbage half-frames silent no-hello no-states old-protocol zero-force \
        nan-force zero-workspace no-watchdog no-text zero-quaternion nan-position other-joints dropped reordered \
        repeated bad-commands mute";

    pub(crate) fn named(name: &str) -> Option<Fault> {
        Fault::ALL.iter().find(|(known, _)| *known == name).map(|(_, fault)| *fault)
    }

    pub(crate) fn spoil_hello(self, hello: &mut Hello) {
        match self {
            Fault::OldProtocol => hello.version = 0,
            Fault::ZeroForce => hello.max_force_n = 0.0,
            Fault::NanForce => hello.max_force_n = f32::NAN,
            Fault::ZeroWorkspace => hello.workspace_radius_m = 0.0,
            Fault::NoWatchdog => hello.watchdog_ms = 0,
            Fault::NoText => hello.serial = [0xfe; 32],
            _ => {}
        }
    }

    pub(crate) fn spoil_state(self, state: &mut State) {
        match self {
            Fault::ZeroQuaternion => state.orientation = [0.0; 4],
            Fault::NanPosition => state.position_m[1] = f32::NAN,
            _ => {}
        }
    }

    /// What becomes of a frame on its way to the host.
    pub(crate) fn spoil_frame(self, frame: &[u8]) -> Vec<u8> {
        match self {
            Fault::Silent => Vec::new(),
            Fault::Garbage => frame.iter().map(|byte| byte.wrapping_mul(167) ^ 0x5a).collect(),
            Fault::HalfFrames => [&frame[..frame.len() / 2], &[0]].concat(),
            _ => frame.to_vec(),
        }
    }
}
