//! The example firmware, compiled for this machine, as a device of the backend.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::os::fd::OwnedFd;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use devices::serial::{Settings, open};
use devices::{Device, MotorsOff, Wrench};
use glam::{DVec2, DVec3};

use crate::{HEADER, PARTS, compiled};

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
