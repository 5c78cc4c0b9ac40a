//! STATE: where probe, proxy and force of every device are, and what the contact is like.

use glam::DVec3;
use rhombus_chain::Pose;

use super::{HEADER_BYTES, Kind, message, put_f32, put_f64, put_u32, put_vector};
use crate::device_view::Mode;

/// Bytes of one device.
const DEVICE_BYTES: usize = 128;
/// Where the message says how many updates this page has not got.
const DROPPED_AT: usize = HEADER_BYTES + 8;

const CONTACT: u8 = 1;
const FORCE: u8 = 1 << 1;
const POSE: u8 = 1 << 2;
const SATURATED: u8 = 1 << 3;
const CLUTCHED: u8 = 1 << 4;
const APPLIED: u8 = 1 << 5;
const COMMANDED: u8 = 1 << 6;

/// What is known of one device, in the body's frame. What was not heard lately, or comes in a frame that nothing
/// connects to the body, is none.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct DeviceState {
    pub(crate) contact: Option<ContactState>,
    pub(crate) force: Option<Force>,
    /// What the model commands, N.
    pub(crate) commanded_n: Option<DVec3>,
    /// The device's handle.
    pub(crate) handle: Option<Pose>,
    /// Hz, as the driver says; none unknown.
    pub(crate) pose_rate_hz: Option<f32>,
}

/// The force on the hand, N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Force {
    /// What the motors apply, as their driver says.
    Applied(DVec3),
    /// What the model commands, where no driver says what motors apply.
    Commanded(DVec3),
}

/// The contact as the model sees it, in the body's frame.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ContactState {
    pub(crate) mode: Mode,
    pub(crate) saturated: bool,
    pub(crate) clutched: bool,
    pub(crate) stamp_s: f64,
    pub(crate) probe: Pose,
    pub(crate) proxy_m: DVec3,
    pub(crate) normal: DVec3,
    pub(crate) depth_m: f64,
    pub(crate) force_n: f64,
    pub(crate) stiffness_n_per_m: f64,
    /// Age of the pose when its contact was heard; none when the stamps are of another clock.
    pub(crate) latency_s: Option<f64>,
}

/// The message, for a page that got every update; [`at_page`] makes it one page's own.
pub(crate) fn state(sequence: u32, server_time_s: f64, devices: &[DeviceState]) -> Vec<u8> {
    let mut state = message(Kind::State, sequence, 16 + DEVICE_BYTES * devices.len());
    put_f64(&mut state, server_time_s);
    put_u32(&mut state, 0);
    put_u32(&mut state, u32::try_from(devices.len()).unwrap_or(u32::MAX));
    for device in devices {
        let end = state.len() + DEVICE_BYTES;
        put_device(&mut state, device);
        state.resize(end, 0);
    }
    state
}

/// The message as it goes to a page that has not got `dropped` updates so far.
pub(crate) fn at_page(state: &[u8], dropped: u32) -> Vec<u8> {
    let mut state = state.to_vec();
    if let Some(place) = state.get_mut(DROPPED_AT..DROPPED_AT + 4) {
        place.copy_from_slice(&dropped.to_le_bytes());
    }
    state
}

fn put_device(state: &mut Vec<u8>, device: &DeviceState) {
    let bit = |set: bool, bit: u8| if set { bit } else { 0 };
    let contact = device.contact.as_ref();
    let mode = match contact.map(|contact| contact.mode) {
        None | Some(Mode::None) => 0,
        Some(Mode::Touch) => 1,
        Some(Mode::Grasp) => 2,
    };
    let flags = bit(contact.is_some(), CONTACT)
        | bit(device.force.is_some(), FORCE)
        | bit(matches!(device.force, Some(Force::Applied(_))), APPLIED)
        | bit(device.commanded_n.is_some(), COMMANDED)
        | bit(device.handle.is_some(), POSE)
        | bit(contact.is_some_and(|contact| contact.saturated), SATURATED)
        | bit(contact.is_some_and(|contact| contact.clutched), CLUTCHED);
    state.extend_from_slice(&[mode, flags, 0, 0]);
    put_u32(state, 0);
    put_f64(state, contact.map_or(0.0, |contact| contact.stamp_s));
    let probe = contact.map(|contact| contact.probe).or(device.handle).unwrap_or(Pose::IDENTITY);
    put_vector(state, probe.translation);
    probe.rotation.to_array().into_iter().for_each(|number| put_f32(state, number));
    put_vector(state, contact.map_or(DVec3::ZERO, |contact| contact.proxy_m));
    put_vector(state, contact.map_or(DVec3::ZERO, |contact| contact.normal));
    put_vector(
        state,
        device.force.map_or(DVec3::ZERO, |force| match force {
            Force::Applied(newtons) | Force::Commanded(newtons) => newtons,
        }),
    );
    put_f32(state, contact.map_or(0.0, |contact| contact.depth_m));
    put_f32(state, contact.map_or(0.0, |contact| contact.force_n));
    put_f32(state, contact.map_or(0.0, |contact| contact.stiffness_n_per_m));
    put_f32(state, contact.and_then(|contact| contact.latency_s).unwrap_or(f64::NAN));
    put_f32(state, device.pose_rate_hz.map_or(f64::NAN, f64::from));
    put_vector(state, device.handle.map_or(DVec3::ZERO, |handle| handle.translation));
    put_vector(state, device.commanded_n.unwrap_or_default());
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    fn contact() -> ContactState {
        ContactState {
            mode: Mode::Grasp,
            saturated: true,
            clutched: false,
            stamp_s: 3.5,
            probe: Pose { translation: DVec3::new(1.0, 2.0, 3.0), rotation: DQuat::IDENTITY },
            proxy_m: DVec3::X,
            normal: DVec3::Z,
            depth_m: 0.004,
            force_n: 0.5,
            stiffness_n_per_m: 120.0,
            latency_s: Some(0.001),
        }
    }

    #[test]
    fn every_device_has_128_bytes_with_its_values_where_the_protocol_says() {
        let force = Some(Force::Applied(DVec3::new(0.0, 0.0, 0.5)));
        let commanded_n = Some(DVec3::new(0.0, 0.0, 0.75));
        let devices = [
            DeviceState { contact: Some(contact()), force, commanded_n, ..DeviceState::default() },
            DeviceState::default(),
        ];
        let bytes = at_page(&state(7, 20.0, &devices), 11);
        assert_eq!(bytes.len(), 24 + 2 * 128);
        assert_eq!(bytes[..8], [3, 0, 0, 0, 7, 0, 0, 0]);
        assert_eq!(bytes[8..16], 20.0_f64.to_le_bytes());
        assert_eq!(bytes[16..24], [11, 0, 0, 0, 2, 0, 0, 0]);
        let left = &bytes[24..152];
        assert_eq!(left[..2], [2, 0b110_1011]);
        let float = |at: usize| f32::from_le_bytes(left[at..at + 4].try_into().unwrap());
        assert_eq!(left[8..16], 3.5_f64.to_le_bytes());
        assert_eq!([float(16), float(20), float(24)], [1.0, 2.0, 3.0], "probe");
        assert_eq!([float(28), float(40)], [0.0, 1.0], "quaternion x and w");
        assert_eq!([float(44), float(64), float(76)], [1.0, 1.0, 0.5], "proxy x, normal z, force z");
        assert_eq!([float(80), float(84), float(88), float(92)], [0.004, 0.5, 120.0, 0.001]);
        assert!(float(96).is_nan(), "the pose rate is not known");
        assert_eq!(
            [float(112), float(120), float(124)],
            [0.0, 0.75, 0.0],
            "what is commanded, and nothing behind it"
        );
        assert_eq!(bytes[152..154], [0, 0], "nothing is known of the right one");
    }

    #[test]
    fn a_command_in_place_of_a_force_that_nobody_measures_is_marked_as_one() {
        let force = DVec3::new(0.0, 0.0, 0.5);
        let device = DeviceState {
            force: Some(Force::Commanded(force)),
            commanded_n: Some(force),
            ..DeviceState::default()
        };
        let bytes = state(1, 0.0, &[device]);
        assert_eq!(bytes[25], FORCE | COMMANDED);
        assert_eq!(bytes[24 + 76..24 + 80], bytes[24 + 120..24 + 124]);
    }
}
