//! The driver as a process that is killed or stopped while it presses: the device's own watchdog takes the force away.

use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use devices::force_dimension::{Settings, WATCHDOG, list, open};
use devices::{Device, Wrench};
use glam::DVec3;

use crate::double::{Double, Line};

const PUSH: Wrench = Wrench::of_force(DVec3::new(0.0, 0.0, 7.0));

/// Set by the tests below: the SDK that the driver process finds, and the device that it takes.
const SDK: &str = "FORCEDIM_SDK";
const SERIAL: &str = "RHOMBUS_TEST_SERIAL";

/// No test: the process that the tests below stop. It pushes with 1 kHz, and enables again what the watchdog took while
/// this machine was busy.
#[test]
#[ignore = "the driver process of the tests in this file"]
fn driver_process() {
    let serial = std::env::var(SERIAL).unwrap_or_default();
    let settings = Settings { serial, sdk: PathBuf::new(), period_s: 1e-3 };
    let mut device = open(settings).unwrap();
    device.enable().unwrap();
    let end = Instant::now() + Duration::from_secs(20);
    while Instant::now() < end {
        let state = device.read().unwrap();
        if state.motors_off.is_some() {
            device.enable().unwrap();
        }
        device.command(&PUSH).unwrap();
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn driver(double: &Double, serial: &str) -> Child {
    Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "--ignored", "stopped::driver_process"])
        .env(SDK, double.sdk())
        .env(SERIAL, serial)
        .stdout(Stdio::null())
        .spawn()
        .unwrap()
}

/// A driver process that has pushed for a while.
fn pushing(double: &Double) -> Child {
    let driver = driver(double, "");
    let end = Instant::now() + Duration::from_secs(10);
    while double.record().iter().filter(|line| line.wrench == PUSH).count() < 50 {
        assert!(Instant::now() < end, "the driver does not push: {:?}", double.record().last());
        std::thread::sleep(Duration::from_millis(5));
    }
    driver
}

/// The time from the last command at the motors to the end of the force, once there is one.
fn end_of_force(double: &Double) -> Duration {
    let end = Instant::now() + Duration::from_secs(5);
    loop {
        let record = double.record();
        if let [.., Line { t_ns: commanded, event: last, wrench }, Line { t_ns: gone, event, wrench: now }] =
            &record[..]
            && event == "watchdog"
        {
            assert_eq!((last.as_str(), wrench, now), ("command", &PUSH, &Wrench::ZERO));
            return Duration::from_nanos(gone - commanded);
        }
        assert!(Instant::now() < end, "still a force: {:?}", record.last());
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn ends_force(signal: &str) {
    let mut worst = Duration::ZERO;
    for _ in 0..5 {
        let double = Double::start(&["--device", "omega.3"]);
        let mut driver = pushing(&double);
        let sent = Command::new("kill").args([signal, &driver.id().to_string()]).status().unwrap();
        assert!(sent.success());
        let took = end_of_force(&double);
        driver.kill().unwrap();
        driver.wait().unwrap();
        assert!(took >= WATCHDOG, "{took:?}: earlier than the controller's own time");
        worst = worst.max(took);
    }
    eprintln!("{signal}: force gone {worst:?} after the last command, worst of 5");
    // The watchdog's time, and what the double's own process may be late with noticing it.
    assert!(worst <= Duration::from_millis(50), "{worst:?}");
}

#[test]
fn a_killed_driver_leaves_no_force() {
    ends_force("-KILL");
}

#[test]
fn a_stopped_driver_leaves_no_force() {
    ends_force("-STOP");
}

#[test]
fn the_device_of_a_killed_driver_opens_again() {
    let double = Double::start(&["--device", "omega.3:501"]);
    let mut driver = pushing(&double);
    assert!(open(double.settings("501")).err().unwrap().to_string().contains("in use"));
    driver.kill().unwrap();
    driver.wait().unwrap();
    let mut device = open(double.settings("501")).unwrap();
    assert_eq!(device.read().unwrap().motors_off, None);
    assert_eq!(double.last().wrench, Wrench::ZERO, "opening has switched off what was left");
}

#[test]
fn two_drivers_that_start_together_get_their_devices() {
    // Each looks at both devices for a moment to find its own.
    for _ in 0..5 {
        let double = Double::start(&["--device", "omega.3:501", "--device", "omega.3:502"]);
        let mut drivers = ["501", "502"].map(|serial| driver(&double, serial));
        let end = Instant::now() + Duration::from_secs(10);
        let in_use =
            || list(&double.settings("")).unwrap().iter().filter(|found| found.serial.is_empty()).count();
        while in_use() < 2 {
            assert!(Instant::now() < end, "a driver has not got its device");
            std::thread::sleep(Duration::from_millis(200));
        }
        std::thread::sleep(Duration::from_millis(100));
        for driver in &mut drivers {
            assert_eq!(driver.try_wait().unwrap(), None, "still driving");
            driver.kill().unwrap();
            driver.wait().unwrap();
        }
    }
}
