//! `rhombus_serial.h` and the backend speak the same bytes, and firmware made with it is a device.

#![expect(clippy::unwrap_used, reason = "helpers of tests, outside the test functions")]

use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::os::fd::OwnedFd;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use devices::serial::wire::{self, Frame, Hello, HelloRequest, PROTOCOL_VERSION, State, capability};
use devices::serial::{Settings, open};
use devices::{Device, MotorsOff, Wrench};
use glam::{DVec2, DVec3};

const HEADER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../nodes/devices/serial_device");
const PARTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/serial_header");

fn compiled(folder: &Path, compiler: &str, options: &[&str], sources: &[PathBuf]) -> PathBuf {
    let program = folder.join("program");
    let status = Command::new(compiler)
        .args(["-O1", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-I", HEADER, "-I", PARTS])
        .args(options)
        .args(sources)
        .arg("-o")
        .arg(&program)
        .arg("-lm")
        .status()
        .unwrap();
    assert!(status.success());
    program
}

/// One of the C programs beside this file.
fn c_program(folder: &Path, name: &str) -> PathBuf {
    compiled(folder, "cc", &["-std=c99", "-Wconversion"], &[Path::new(PARTS).join(name)])
}

/// What a program answers to all of its input.
fn answer(program: &Path, input: &[u8]) -> Vec<u8> {
    let mut child = Command::new(program).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let mut stdin = child.stdin.take().unwrap();
    std::thread::scope(|scope| {
        std::thread::Builder::new().spawn_scoped(scope, move || stdin.write_all(input).unwrap()).unwrap();
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success());
        output.stdout
    })
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

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

/// A device by the header, which a script drives.
struct Scripted(Vec<String>);

impl Scripted {
    fn at(mut self, time_us: u32, frame: &Frame) -> Scripted {
        self.0.push(format!("{time_us} {}", hex(frame.bytes())));
        self
    }

    fn nothing_at(mut self, time_us: u32) -> Scripted {
        self.0.push(format!("{time_us} ."));
        self
    }

    fn off_at(mut self, time_us: u32) -> Scripted {
        self.0.push(format!("{time_us} off 5"));
        self
    }

    /// After each step: motors on, cause, commanded, lost commands, force x, action.
    fn run(self) -> Vec<[f64; 6]> {
        let folder = tempfile::tempdir().unwrap();
        let said = answer(&c_program(folder.path(), "device.c"), (self.0.join("\n") + "\n").as_bytes());
        let lines = String::from_utf8(said).unwrap();
        let numbers = |line: &str| line.split(' ').map(|n| n.parse().unwrap()).collect::<Vec<f64>>();
        lines.lines().map(numbers).map(|n| [n[1], n[2], n[3], n[4], n[6], n[13]]).collect()
    }
}

fn push(sequence: u16, flags: u8, force_x: f32) -> Frame {
    wire::Command { flags, sequence, force_n: [force_x, 0.0, 0.0], ..Default::default() }.frame()
}

#[test]
fn a_device_by_the_header_takes_the_force_away_after_20_ms_and_wants_to_be_asked_again() {
    let hello = HelloRequest { version: 1 }.frame();
    // Its clock wraps around on the way.
    let start = u32::MAX - 10_000;
    let at = |us: u32| start.wrapping_add(us);
    let said = Scripted(Vec::new())
        .at(at(0), &hello)
        .at(at(1000), &push(0, 1, 5.0))
        .nothing_at(at(20_999))
        .nothing_at(at(21_000))
        .at(at(22_000), &push(1, 1, 5.0))
        .at(at(23_000), &push(2, 0, 0.0))
        .at(at(24_000), &push(3, 1, 5.0))
        .off_at(at(25_000))
        .at(at(26_000), &push(4, 1, 5.0))
        .at(at(27_000), &hello)
        .run();
    let [off, command, watchdog, dead_man] = [0.0, 1.0, 2.0, 5.0];
    assert_eq!(
        said,
        [
            [0.0, off, 0.0, 0.0, 0.0, 1.0],
            [1.0, off, 1.0, 0.0, 5.0, 2.0],
            [1.0, off, 1.0, 0.0, 5.0, 0.0],
            [0.0, watchdog, 1.0, 0.0, 0.0, 0.0],
            [0.0, watchdog, 1.0, 0.0, 0.0, 2.0],
            [0.0, command, 1.0, 0.0, 0.0, 2.0],
            [1.0, off, 1.0, 0.0, 5.0, 2.0],
            [0.0, dead_man, 1.0, 0.0, 0.0, 0.0],
            [0.0, dead_man, 1.0, 0.0, 0.0, 2.0],
            [0.0, off, 0.0, 0.0, 0.0, 1.0],
        ]
    );
}

#[test]
fn a_device_by_the_header_gives_no_force_after_a_bad_frame_and_never_more_than_its_limit() {
    let bad = Frame::new(b"no message").unwrap();
    let said = Scripted(Vec::new())
        .at(0, &push(0, 1, 25.0))
        .at(1000, &bad)
        .at(2000, &push(1, 1, 5.0))
        .at(3000, &push(2, 1, f32::NAN))
        .at(4000, &push(5, 1, 5.0))
        .at(5000, &push(6, 1, f32::INFINITY))
        .at(6000, &push(7, 1, -f32::MAX))
        .run();
    let forces: Vec<f64> = said.iter().map(|said| said[4]).collect();
    assert_eq!(forces, [10.0, 0.0, 5.0, 0.0, 5.0, 0.0, 0.0]);
    let lost: Vec<f64> = said.iter().map(|said| said[3]).collect();
    // 2 was not taken, 3 and 4 never came.
    assert_eq!(lost, [0.0, 0.0, 0.0, 0.0, 3.0, 3.0, 3.0]);
    assert!(said.iter().all(|said| said[0] > 0.0), "the motors stay on");
}

/// The example firmware on a pseudo-terminal, and what it writes to its pins.
struct Pantograph {
    child: Child,
    pins: BufReader<std::process::ChildStderr>,
    port: String,
    _host: OwnedFd,
    _folder: tempfile::TempDir,
}

impl Pantograph {
    fn start() -> Pantograph {
        use rustix::pty::{OpenptFlags, grantpt, ioctl_tiocgptpeer, openpt, ptsname, unlockpt};
        let folder = tempfile::tempdir().unwrap();
        let sources = [
            Path::new(HEADER).join("examples/pantograph/pantograph.ino"),
            Path::new(PARTS).join("arduino.cpp"),
        ];
        let options = ["-std=c++11", "-x", "c++", "-include", "Arduino.h"];
        let program = compiled(folder.path(), "c++", &options, &sources);
        let flags = OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC;
        let device = openpt(flags).unwrap();
        grantpt(&device).unwrap();
        unlockpt(&device).unwrap();
        let port = ptsname(&device, Vec::new()).unwrap().into_string().unwrap();
        let host = ioctl_tiocgptpeer(&device, flags).unwrap();
        let mut settings = rustix::termios::tcgetattr(&host).unwrap();
        settings.make_raw();
        rustix::termios::tcsetattr(&host, rustix::termios::OptionalActions::Now, &settings).unwrap();
        let device = File::from(device);
        let mut child = Command::new(program)
            .stdin(device.try_clone().unwrap())
            .stdout(device)
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let pins = BufReader::new(child.stderr.take().unwrap());
        Pantograph { child, pins, port, _host: host, _folder: folder }
    }

    /// The next write to a pin that changes it.
    fn next_pin(&mut self) -> (u8, i32) {
        let mut line = String::new();
        self.pins.read_line(&mut line).unwrap();
        let words: Vec<&str> = line.trim().split(' ').collect();
        (words[1].parse().unwrap(), words[2].parse().unwrap())
    }
}

impl Drop for Pantograph {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Where the example's handle is, by the cosine rule: upper arms 60 mm, lower arms 90 mm, motors 40 mm apart.
fn handle(angles: [f64; 2]) -> DVec2 {
    let elbow = |x: f64, angle: f64| DVec2::new(x, 0.0) + 0.06 * DVec2::from_angle(angle);
    let (left, right) = (elbow(-0.02, angles[0]), elbow(0.02, angles[1]));
    let along = (right - left).normalize_or_zero();
    let half = 0.5 * left.distance(right);
    left + half * along + (0.09f64.powi(2) - half * half).sqrt() * along.perp()
}

#[test]
fn the_example_firmware_is_a_device_whose_motors_do_the_work_of_the_force() {
    let mut pantograph = Pantograph::start();
    let settings = Settings { port: pantograph.port.clone(), baud: 921_600, serial: "1".to_owned() };
    let mut device = open(settings).unwrap();
    assert_eq!(device.description().model, "Pantograph");
    assert_eq!(device.description().limits.max_force_n, Some(3.0));
    assert_eq!(device.description().limits.max_torque_n_m, None);
    assert_eq!(device.description().watchdog, Some(Duration::from_millis(20)));

    let rest = [2.6, 0.54];
    let state = device.read().unwrap();
    assert!((state.pose.translation.truncate() - handle(rest)).length() < 1e-6);
    assert!((state.joints[0] - rest[0]).abs() < 1e-6 && (state.joints[1] - rest[1]).abs() < 1e-6);

    // Its clock wraps around; ours does not.
    let (mut last_ns, start_ns) = (state.device_time_ns, state.device_time_ns);
    while last_ns - start_ns < 2_500_000_000 {
        std::thread::sleep(Duration::from_millis(1));
        let now_ns = device.read().unwrap().device_time_ns;
        assert!(now_ns >= last_ns && now_ns - last_ns < 2_000_000_000, "{last_ns} then {now_ns}");
        last_ns = now_ns;
    }

    // The work of the force on a small way of the handle is the work of the torques on the way of the motors.
    let force = DVec2::new(0.25, 1.0);
    let torque = [0, 1].map(|motor| {
        let moved = |by: f64| {
            let mut angles = rest;
            angles[motor] += by;
            handle(angles)
        };
        force.dot(moved(1e-6) - moved(-1e-6)) / 2e-6
    });
    device.enable().unwrap();
    let mut pins = std::collections::BTreeMap::new();
    // pwm 9 and 10, direction 7 and 8, enable 6.
    while pins.get(&6) != Some(&1) || !pins.contains_key(&9) || !pins.contains_key(&10) {
        device.command(&Wrench::of_force(force.extend(0.0))).unwrap();
        std::thread::sleep(Duration::from_millis(1));
        device.read().unwrap();
        // The direction of the pins changes first, so nothing is waited for that does not come.
        let (pin, value) = pantograph.next_pin();
        pins.insert(pin, value);
    }
    for motor in [0u8, 1] {
        let torque = torque[usize::from(motor)];
        let share = f64::from(pins[&(9 + motor)]) / 255.0;
        assert!(
            (share - torque.abs() / 0.15).abs() < 0.005,
            "motor {motor}: {share} of 0.15 N m, {torque} N m"
        );
        assert_eq!(pins.get(&(7 + motor)).copied().unwrap_or(0) == 1, torque > 0.0);
    }

    // No more commands.
    loop {
        std::thread::sleep(Duration::from_millis(1));
        if device.read().unwrap().motors_off == Some(MotorsOff::Watchdog) {
            break;
        }
    }
    while pins[&6] != 0 || pins[&9] != 0 || pins[&10] != 0 {
        let (pin, value) = pantograph.next_pin();
        pins.insert(pin, value);
    }
    assert_eq!(device.read().unwrap().linear_velocity_m_per_s, DVec3::ZERO);
}
