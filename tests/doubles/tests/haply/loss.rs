//! Who takes the force away when the motor loop, the driver, the device or the service fails.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use devices::haply::{self, Settings};
use devices::{Device, DeviceError, MotorsOff, Wrench, monotonic_ns};
use glam::DVec3;

use crate::double::{Double, Ended, eventually, press, refusal, signal};

const MS: u64 = 1_000_000;

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
    // The loop goes on: the device reads and says why it does not push, because that would be a step.
    eventually("the cause", || {
        device.command(&Wrench::of_force(DVec3::X)).unwrap();
        device.read().unwrap().motors_off == Some(MotorsOff::Watchdog)
    });
    assert_eq!(double.record().last().unwrap().2, DVec3::ZERO);
    // Enabled anew it does.
    press(&mut device, DVec3::X, 50);
    assert_eq!(double.record().last().unwrap().2, DVec3::Y);
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
            .args(["loss::driver", "--exact", "--ignored"])
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
