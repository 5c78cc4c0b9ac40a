//! The Haply backend against the double of its service: what the hand feels is read from the double's record.
#![cfg(feature = "haply")]
#![expect(clippy::unwrap_used, clippy::expect_used, reason = "tests, their helpers too")]

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use assert_no_alloc::{AllocDisabler, assert_no_alloc};
use devices::haply::{self, HaplyDevice, Settings};
use devices::{Device, DeviceError, DeviceState, MotorsOff, Wrench, monotonic_ns};
use glam::{DQuat, DVec3};

#[global_allocator]
static ALLOCATOR: AllocDisabler = AllocDisabler;

const MS: u64 = 1_000_000;

/// The service as a process.
struct Double {
    process: Child,
    url: String,
    directory: tempfile::TempDir,
}

impl Double {
    fn start(options: &[&str]) -> Double {
        let directory = tempfile::tempdir().unwrap();
        let mut process = Command::new(env!("CARGO_BIN_EXE_haply_double"))
            .args(options)
            .arg("--record")
            .arg(directory.path().join("record.csv"))
            .args(["--attached", "yes"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(process.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let url = line.trim().strip_prefix("ready: ").unwrap().to_owned();
        Double { process, url, directory }
    }

    fn settings(&self) -> Settings {
        Settings { url: self.url.clone(), ..Settings::default() }
    }

    fn open(&self) -> HaplyDevice {
        haply::open(self.settings()).unwrap()
    }

    fn signal(&self, name: &str) {
        signal(&self.process, name);
    }

    /// Time, event and force of each line of the record so far.
    fn record(&self) -> Vec<(u64, String, DVec3)> {
        let text = std::fs::read_to_string(self.directory.path().join("record.csv")).unwrap();
        let whole = text.rsplit_once('\n').map_or("", |(lines, _)| lines);
        whole
            .lines()
            .skip(1)
            .map(|line| {
                let words: Vec<&str> = line.split(',').collect();
                let force = [2, 3, 4].map(|column| words[column].parse::<f64>().unwrap());
                (words[0].parse().unwrap(), words[1].to_owned(), DVec3::from(force))
            })
            .collect()
    }
}

/// A process that ends with the test, however the test ends.
struct Ended(Child);

impl Drop for Ended {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

impl Drop for Double {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

fn signal(process: &Child, name: &str) {
    assert!(
        Command::new("kill")
            .arg(format!("-{name}"))
            .arg(process.id().to_string())
            .status()
            .unwrap()
            .success()
    );
}

/// A motor loop in short: reads and commands once a millisecond.
fn press(device: &mut HaplyDevice, force_n: DVec3, milliseconds: u32) -> DeviceState {
    let mut state = device.read().unwrap();
    for _ in 0..milliseconds {
        state = device.read().unwrap();
        device.command(&Wrench::of_force(force_n)).unwrap();
        std::thread::sleep(Duration::from_millis(1));
    }
    state
}

/// Waits until something is so; much longer than it takes.
fn eventually(what: &str, mut is_so: impl FnMut() -> bool) {
    let begin = Instant::now();
    while !is_so() {
        assert!(begin.elapsed() < Duration::from_secs(10), "{what} never came");
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn refusal(settings: Settings) -> String {
    let begin = Instant::now();
    let error = haply::open(settings).err().expect("opened");
    assert!(begin.elapsed() < Duration::from_secs(6), "{error} came late");
    error.to_string()
}

#[test]
fn a_push_forward_arrives_as_the_services_y_whichever_key_it_understands() {
    for service in ["3.5", "3.4"] {
        let double = Double::start(&["--service", service]);
        let mut device = double.open();
        device.enable().unwrap();
        press(&mut device, DVec3::new(1.0, 0.25, -0.5), 50);
        let expected = DVec3::new(-0.25, 1.0, -0.5);
        let pushed = double
            .record()
            .iter()
            .filter(|(_, event, force)| event == "command" && *force == expected)
            .count();
        assert!(pushed > 10, "{service}: {pushed} commands with the force");
    }
}

#[test]
fn a_place_of_the_service_is_turned_into_the_device_frame_and_its_velocity_too() {
    // The hand rests at x 0.1 (right), y 0.2 (forward), z 0.3.
    let double = Double::start(&["--from", "0.1,0.2,0.3", "--to", "0.1,0.2,0.3"]);
    let mut device = double.open();
    let state = press(&mut device, DVec3::ZERO, 20);
    assert!((state.pose.translation - DVec3::new(0.2, -0.1, 0.3)).length() < 1e-9);
    assert_eq!(state.pose.rotation, DQuat::IDENTITY);
    drop((device, double));
    // It moves with 0.05 m/s along the service's x, which is -y.
    let double = Double::start(&["--to", "0.3,0,0", "--during", "6"]);
    let mut device = double.open();
    let state = press(&mut device, DVec3::ZERO, 1000);
    assert!((state.linear_velocity_m_per_s - DVec3::new(0.0, -0.05, 0.0)).length() < 1e-3, "{state:?}");
}

#[test]
fn the_grip_turns_the_handle_and_has_the_buttons() {
    let double = Double::start(&["--grips", "61548"]);
    let mut device = double.open();
    assert_eq!(device.description().buttons, ["a", "b", "c", "home"]);
    let state = press(&mut device, DVec3::ZERO, 300);
    assert_eq!(state.buttons, 0b0101);
    // It turns about the service's y with 0.5 rad/s: about forward, which is x.
    assert!((state.angular_velocity_rad_per_s - DVec3::new(0.5, 0.0, 0.0)).length() < 0.05, "{state:?}");
    let (axis, angle) = state.pose.rotation.to_axis_angle();
    assert!(angle > 0.1 && (axis - DVec3::X).length() < 1e-6, "{axis} {angle}");
    let battery = device.description().status_names.iter().position(|name| *name == "grip_battery_percent");
    assert_eq!(state.status[battery.unwrap()], 50);
}

#[test]
fn the_force_moves_the_hand_as_far_as_its_spring_lets_it() {
    let double = Double::start(&["--stiffness", "100", "--damping", "10"]);
    let mut device = double.open();
    device.enable().unwrap();
    let state = press(&mut device, DVec3::new(0.0, 0.0, 1.0), 1500);
    assert!(
        (state.pose.translation - DVec3::new(0.0, 0.0, 0.01)).length() < 1e-4,
        "{}",
        state.pose.translation
    );
}

#[test]
fn after_opening_and_after_disabling_no_command_moves_the_motors() {
    let double = Double::start(&[]);
    let mut device = double.open();
    press(&mut device, DVec3::X, 50);
    assert!(double.record().iter().all(|(_, _, force)| *force == DVec3::ZERO), "off after opening");
    device.enable().unwrap();
    press(&mut device, DVec3::X, 50);
    device.disable().unwrap();
    device.disable().unwrap();
    eventually("off", || double.record().last().unwrap().1 == "off");
    let lines = double.record().len();
    press(&mut device, DVec3::X, 50);
    assert_eq!(double.record().len(), lines, "no force after disabling");
    device.enable().unwrap();
    press(&mut device, DVec3::Y, 50);
    assert_eq!(double.record().last().unwrap().2, -DVec3::X, "and again after enabling");
}

#[test]
fn enabling_begins_without_a_force_whatever_was_commanded_before() {
    let double = Double::start(&[]);
    let mut device = double.open();
    device.command(&Wrench::of_force(DVec3::X)).unwrap();
    device.enable().unwrap();
    eventually("a command", || double.record().last().is_some_and(|line| line.1 == "command"));
    std::thread::sleep(Duration::from_millis(60));
    assert!(double.record().iter().all(|(_, _, force)| *force == DVec3::ZERO));
}

#[test]
fn dropping_the_device_takes_the_force_away_before_the_tick_does() {
    let double = Double::start(&[]);
    let mut device = double.open();
    device.enable().unwrap();
    press(&mut device, DVec3::X, 30);
    drop(device);
    eventually("off", || double.record().last().unwrap().1 == "off");
}

#[test]
fn a_motor_loop_that_hangs_loses_its_force_after_20_ms() {
    let double = Double::start(&["--tick-ms", "1000"]);
    let mut device = double.open();
    device.enable().unwrap();
    press(&mut device, DVec3::X, 30);
    let hang_ns = monotonic_ns();
    eventually("off", || double.record().last().unwrap().1 == "off");
    let (off_ns, ..) = double.record().last().unwrap().clone();
    // By the service's clock; the thread looks every millisecond, and the machine may be busy.
    assert!(off_ns - hang_ns < 60 * MS, "{} ms", (off_ns - hang_ns) / MS);
    assert!(device.read().is_ok(), "it still reads");
    press(&mut device, DVec3::X, 30);
    assert_eq!(double.record().last().unwrap().2, DVec3::Y, "and pushes again when the loop goes on");
}

/// What the next test starts: a driver that presses until it is killed.
#[test]
#[ignore = "a part of another test"]
fn driver() {
    let Ok(url) = std::env::var("HAPLY_URL") else { return };
    let mut device = haply::open(Settings { url, ..Settings::default() }).unwrap();
    device.enable().unwrap();
    loop {
        press(&mut device, DVec3::X, 1000);
    }
}

#[test]
fn a_driver_that_is_killed_or_stopped_loses_its_force_at_the_tick() {
    for name in ["KILL", "STOP"] {
        let double = Double::start(&[]);
        let driver = Command::new(std::env::current_exe().unwrap())
            .args(["driver", "--exact", "--ignored"])
            .env("HAPLY_URL", &double.url)
            .stdout(Stdio::null())
            .spawn()
            .map(Ended)
            .unwrap();
        eventually("pressing", || double.record().last().is_some_and(|line| line.2 == DVec3::Y));
        signal(&driver.0, name);
        let signalled_ns = monotonic_ns();
        eventually("the tick", || double.record().last().unwrap().1 == "watchdog");
        let record = double.record();
        let [.., (command_ns, event, force), (tick_ns, ..)] = record.as_slice() else { panic!() };
        assert_eq!((event.as_str(), *force), ("command", DVec3::Y));
        println!("{name}: without a force {} us after the last command", (tick_ns - command_ns) / 1000);
        // The tick is 20 ms; what is beyond is the double's own clock of half a millisecond and a busy machine.
        assert!((20 * MS..60 * MS).contains(&(tick_ns - command_ns)), "{} ms", (tick_ns - command_ns) / MS);
        assert!(*command_ns < signalled_ns + 20 * MS);
    }
}

#[test]
fn an_unplugged_device_is_lost_without_a_force_and_opens_again_when_it_is_back() {
    for unplug in ["device", "service"] {
        let double = Double::start(&["--unplug", unplug]);
        let mut device = double.open();
        device.enable().unwrap();
        press(&mut device, DVec3::X, 20);
        double.signal("USR1");
        let mut lost = None;
        eventually("loss", || {
            lost = device.command(&Wrench::of_force(DVec3::X)).and(device.read().map(drop)).err();
            lost.is_some()
        });
        let reason = lost.unwrap().to_string();
        let expected = if unplug == "device" { "lists the device no more" } else { "closed the connection" };
        assert!(reason.contains(expected), "{reason}");
        assert!(device.disable().is_err(), "it does not come back by itself");
        drop(device);
        eventually("off", || double.record().last().is_some_and(|line| line.2 == DVec3::ZERO));
        if unplug == "device" {
            assert!(refusal(double.settings()).contains("lists no Inverse3"));
        }
        double.signal("USR2");
        eventually("return", || haply::open(double.settings()).is_ok());
        let lines = double.record().len();
        let mut device = double.open();
        press(&mut device, DVec3::X, 20);
        assert!(
            double.record()[lines..].iter().all(|(_, _, force)| *force == DVec3::ZERO),
            "off after reopening"
        );
    }
}

#[test]
fn reading_and_commanding_allocate_nothing() {
    let double = Double::start(&["--grips", "61548"]);
    let mut device = double.open();
    device.enable().unwrap();
    for _ in 0..500 {
        assert_no_alloc(|| {
            device.read().unwrap();
            device.command(&Wrench::of_force(DVec3::X)).unwrap();
        });
        std::thread::sleep(Duration::from_micros(500));
    }
    assert!(double.record().len() > 50);
}

#[test]
fn two_devices_need_a_serial_and_the_long_id_is_one_too() {
    let double = Double::start(&["--devices", "049D,04C3"]);
    match haply::open(double.settings()).err() {
        Some(DeviceError::Ambiguous { found, .. }) => assert_eq!(found, ["049D", "04C3"]),
        other => panic!("{other:?}"),
    }
    for serial in ["04c3", "9ab19c4b5e655e32b4f00f8a59fd04C3"] {
        let device = haply::open(Settings { serial: serial.to_owned(), ..double.settings() }).unwrap();
        assert_eq!(device.description().serial, "04C3");
    }
    let text = refusal(Settings { serial: "FFFF".to_owned(), ..double.settings() });
    assert!(text.contains("FFFF") && text.contains("049D, 04C3"), "{text}");
    let serials: Vec<String> =
        haply::list(&double.settings()).unwrap().into_iter().map(|found| found.serial).collect();
    assert_eq!(serials, ["049D", "04C3"]);
}

#[test]
fn two_grips_need_a_choice() {
    let double = Double::start(&["--grips", "A1,B2"]);
    let text = refusal(double.settings());
    assert!(text.contains("haply.grip") && text.contains("A1, B2"), "{text}");
    assert!(haply::open(Settings { grip: "b2".to_owned(), ..double.settings() }).is_ok());
    let text = refusal(Settings { grip: "C3".to_owned(), ..double.settings() });
    assert!(text.contains("haply.grip") && text.contains("C3"), "{text}");
}

#[test]
fn what_cannot_be_opened_says_why_and_what_to_do() {
    let port = {
        let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
        listener.local_addr().unwrap().port()
    };
    let text = refusal(Settings { url: format!("ws://127.0.0.1:{port}"), ..Settings::default() });
    assert!(text.contains("no service listens") && text.contains("start the Haply service"), "{text}");
    for (fault, said, remedy) in [
        ("not-websocket", "no WebSocket service", "10001"),
        ("mute", "no WebSocket service", "10001"),
        ("silent", "does not answer", "10001"),
        ("pings", "does not answer", "10001"),
        ("close", "closed the connection", "10001"),
        ("not-json", "not the service's JSON", "10001"),
        ("other-json", "not the service's JSON", "10001"),
        ("legacy", "not the service's JSON", "10000 is the format"),
        ("half", "not the service's JSON", "10001"),
        ("no-number", "not the service's JSON", "10001"),
        ("too-large", "not the service's JSON", "10001"),
        ("binary", "no WebSocket text", "10001"),
        ("endless", "without an end", "10001"),
        ("fragments", "without an end", "10001"),
        ("drip", "does not answer", "10001"),
        ("no-device", "lists no Inverse3", "switch it on"),
        ("uncalibrated", "not calibrated", "calibrate it"),
        ("basis", "XZY", "set the basis"),
    ] {
        let double = Double::start(&["--fault", fault]);
        let text = refusal(double.settings());
        assert!(text.contains(said) && text.contains(remedy), "{fault}: {text}");
    }
}

#[test]
fn limits_that_are_none_are_refused() {
    for max_force_n in [0.0, -1.0, f64::NAN, f64::INFINITY, 100.0] {
        let text = refusal(Settings { max_force_n, ..Settings::default() });
        assert!(text.contains("haply.max_force"), "{text}");
    }
}

#[test]
fn a_service_that_goes_wrong_while_pressing_is_a_lost_device_and_the_force_ends() {
    for (fault, said) in [
        ("not-json", "not its own JSON"),
        ("no-number", "not its own JSON"),
        ("too-large", "not its own JSON"),
        ("half", "not its own JSON"),
        ("no-device", "lists the device no more"),
        ("silent", "does not answer"),
        ("endless", "without an end"),
        ("fragments", "without an end"),
        ("drip", "does not answer"),
        ("binary", "no WebSocket text"),
        ("close", "closed the connection"),
    ] {
        let double = Double::start(&["--fault", fault, "--fault-after", "100"]);
        let mut device = double.open();
        device.enable().unwrap();
        let begin = Instant::now();
        let error = loop {
            assert!(begin.elapsed() < Duration::from_secs(10), "{fault}: never lost");
            match device.command(&Wrench::of_force(DVec3::X)).and_then(|()| device.read()) {
                Ok(state) => assert!(state.is_finite()),
                Err(error) => break error,
            }
            std::thread::sleep(Duration::from_millis(1));
        };
        assert!(matches!(error, DeviceError::Lost { .. }), "{fault}: {error}");
        assert!(error.to_string().contains(said), "{fault}: {error}");
        drop(device);
        eventually("no force", || double.record().last().unwrap().2 == DVec3::ZERO);
    }
}

#[test]
fn a_device_that_idles_by_itself_or_has_no_power_says_that_its_motors_are_off() {
    for fault in ["idle", "no-power"] {
        let double = Double::start(&["--fault", fault, "--fault-after", "100"]);
        let mut device = double.open();
        device.enable().unwrap();
        assert_eq!(device.read().unwrap().motors_off, None);
        eventually("motors off", || press(&mut device, DVec3::X, 5).motors_off == Some(MotorsOff::Other));
    }
}
