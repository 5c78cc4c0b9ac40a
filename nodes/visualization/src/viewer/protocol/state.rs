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

/// What is known of one device, in the body's frame. What was not heard lately, or comes in a frame that nothing
/// connects to the body, is none.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct DeviceState {
    pub(crate) contact: Option<ContactState>,
    /// Force on the hand, N.
    pub(crate) force_n: Option<DVec3>,
    /// The device's handle.
    pub(crate) handle: Option<Pose>,
    /// Hz, as the driver says; none unknown.
    pub(crate) pose_rate_hz: Option<f32>,
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
        | bit(device.force_n.is_some(), FORCE)
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
    put_vector(state, device.force_n.unwrap_or_default());
    put_f32(state, contact.map_or(0.0, |contact| contact.depth_m));
    put_f32(state, contact.map_or(0.0, |contact| contact.force_n));
    put_f32(state, contact.map_or(0.0, |contact| contact.stiffness_n_per_m));
    put_f32(state, contact.and_then(|contact| contact.latency_s).unwrap_or(f64::NAN));
    put_f32(state, device.pose_rate_hz.map_or(f64::NAN, f64::from));
    put_vector(state, device.handle.map_or(DVec3::ZERO, |handle| handle.translation));
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
        let force_n = Some(DVec3::new(0.0, 0.0, 0.5));
        let devices = [
            DeviceState { contact: Some(contact()), force_n, ..DeviceState::default() },
            DeviceState::default(),
        ];
        let bytes = at_page(&state(7, 20.0, &devices), 11);
        assert_eq!(bytes.len(), 24 + 2 * 128);
        assert_eq!(bytes[..8], [3, 0, 0, 0, 7, 0, 0, 0]);
        assert_eq!(bytes[8..16], 20.0_f64.to_le_bytes());
        assert_eq!(bytes[16..24], [11, 0, 0, 0, 2, 0, 0, 0]);
        let left = &bytes[24..152];
        assert_eq!(left[..2], [2, 0b01011]);
        let float = |at: usize| f32::from_le_bytes(left[at..at + 4].try_into().unwrap());
        assert_eq!(left[8..16], 3.5_f64.to_le_bytes());
        assert_eq!([float(16), float(20), float(24)], [1.0, 2.0, 3.0], "probe");
        assert_eq!([float(28), float(40)], [0.0, 1.0], "quaternion x and w");
        assert_eq!([float(44), float(64), float(76)], [1.0, 1.0, 0.5], "proxy x, normal z, force z");
        assert_eq!([float(80), float(84), float(88), float(92)], [0.004, 0.5, 120.0, 0.001]);
        assert!(float(96).is_nan(), "the pose rate is not known");
        assert_eq!(bytes[152..154], [0, 0], "nothing is known of the right one");
    }
}
