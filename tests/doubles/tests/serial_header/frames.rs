//! `rhombus_serial.h` against the backend's own coding.

use std::path::Path;

use devices::serial::wire::{self, Frame, Hello, HelloRequest, PROTOCOL_VERSION, State, capability};

use crate::{HEADER, answer, c_program, hex};

/// The frames of `golden_frames.txt`, made here.
fn golden() -> Vec<(&'static str, Frame)> {
    let command = wire::Command {
        flags: 1,
        sequence: 0x0201,
        force_n: [1.0, -2.5, 0.0],
        torque_n_m: [0.125, 0.0, -0.5],
        gripper_force_n: 4.0,
    };
    let hello = Hello {
        version: 1,
        buttons: 2,
        joints: 3,
        capabilities: capability::FORCE | capability::ORIENTATION | capability::NEEDS_HOMING,
        watchdog_ms: 20,
        state_rate_hz: 1000,
        max_force_n: 20.0,
        max_torque_n_m: 0.0,
        max_gripper_force_n: 0.0,
        workspace_centre_m: [0.0, 0.0, -0.25],
        workspace_radius_m: 0.125,
        workspace_height_m: 0.0625,
        model: Hello::name("Delta"),
        serial: Hello::name("A7"),
        firmware: Hello::name("1.0.0"),
    };
    let state = State {
        flags: 0b1011,
        cause: 0,
        lost_commands: 3,
        sequence: 0xfffe,
        command_sequence: 0x0201,
        time_us: 0x0403_0201,
        command_age_us: 250,
        buttons: 0b10,
        position_m: [0.5, -0.25, 0.125],
        orientation: [0.0, 0.0, 0.6, 0.8],
        linear_velocity_m_per_s: [0.0, 1.0, -1.0],
        angular_velocity_rad_per_s: [2.0, 0.0, 0.0],
        gripper_rad: 0.75,
        joints: [1.5, -1.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    };
    vec![
        ("hello_request", HelloRequest { version: PROTOCOL_VERSION }.frame()),
        ("command", command.frame()),
        ("hello", hello.frame()),
        ("state", state.frame(3)),
    ]
}

#[test]
fn the_golden_frames_are_what_backend_and_header_make() {
    let text = std::fs::read_to_string(Path::new(HEADER).join("golden_frames.txt")).unwrap();
    let committed: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
    let made: Vec<String> =
        golden().iter().map(|(name, frame)| format!("{name} {}", hex(frame.bytes()))).collect();
    assert_eq!(committed, made);

    let folder = tempfile::tempdir().unwrap();
    let stream: Vec<u8> = golden().iter().flat_map(|(_, frame)| frame.bytes().to_vec()).collect();
    assert_eq!(hex(&answer(&c_program(folder.path(), "echo.c"), &stream)), hex(&stream));
}

/// A message of any content; floats of any bits.
fn any_frame(random: &mut fastrand::Rng) -> Frame {
    let mut payload = [0; 140];
    payload.iter_mut().for_each(|byte| *byte = if random.bool() { random.u8(..) } else { 0 });
    payload[0] = *random.choice(&[0x01, 0x02, 0x81, 0x82]).unwrap();
    let length = match payload[0] {
        0x01 => 2,
        0x02 => 32,
        0x81 => 140,
        _ => 72 + 4 * random.usize(0..=8),
    };
    Frame::new(&payload[..length]).unwrap()
}

#[test]
fn the_header_reads_and_writes_every_frame_and_finds_them_between_noise() {
    let folder = tempfile::tempdir().unwrap();
    let echo = c_program(folder.path(), "echo.c");
    let mut random = fastrand::Rng::with_seed(4);
    let fault = Frame::new(&[0xff]).unwrap();
    let (mut stream, mut wanted) = (Vec::new(), Vec::new());
    for _ in 0..5000 {
        let frame = any_frame(&mut random);
        let mut sent = frame.bytes().to_vec();
        match random.u8(0..10) {
            // Half a frame, a wrong byte, noise: one fault, and the next frame is found.
            0 => drop(sent.drain(sent.len() / 2..sent.len() - 1)),
            1 => {
                let at = random.usize(1..sent.len() - 1);
                sent[at] = sent[at].wrapping_add(1).max(1);
            }
            2 => sent.splice(0..0, (0..random.usize(1..400)).map(|_| 0xa7)).for_each(drop),
            3 => sent = vec![0; 3],
            _ => {}
        }
        let (mut receiver, mut input) = (wire::Receiver::default(), &sent[..]);
        while let Some(found) = receiver.next(&mut input) {
            // What the backend makes of it is what the header makes of it.
            let again = found.ok().filter(|payload| frame.bytes() == Frame::new(payload).unwrap().bytes());
            wanted.extend(if again.is_some() { frame.bytes() } else { fault.bytes() });
        }
        stream.extend(sent);
    }
    assert!(hex(&answer(&echo, &stream)) == hex(&wanted));
}
