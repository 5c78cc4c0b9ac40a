//! What can be opened, and what is said about the rest.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::Relaxed;
use std::time::Duration;

use devices::haply::{self, Settings};
use devices::{Device, DeviceError};
use glam::DVec3;

use crate::double::{Double, eventually, refusal};

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
fn a_device_that_another_driver_has_is_in_use_until_that_one_ends() {
    // A service before 3.5 is held by forces of zero, a newer one is silent while the motors are off.
    for options in [&["--devices", "049D,04C3"][..], &["--service", "3.1", "--devices", "049D,04C3"]] {
        let double = Double::start(options);
        let one = || Settings { serial: "049D".to_owned(), ..double.settings() };
        let mut device = haply::open(one()).unwrap();
        // By another name of the same machine it is the same device.
        let numbers = Settings { url: double.url.replace("localhost", "127.0.0.1"), ..one() };
        for settings in [one(), numbers] {
            let text = refusal(settings);
            assert_eq!(
                text,
                "the Inverse3 049D is in use by another program; end that program, then try again"
            );
        }
        device.read().unwrap();
        drop(haply::open(Settings { serial: "04C3".to_owned(), ..one() }).unwrap());
        drop(device);
        drop(haply::open(one()).unwrap());
    }
}

#[test]
fn a_device_that_a_foreign_program_commands_is_in_use_until_it_stops() {
    // A busy machine may keep the foreign program from sending for longer than a service's tick.
    let double = Double::start(&["--tick-ms", "1000"]);
    let (mut socket, _) = tungstenite::connect(&double.url).unwrap();
    let goes_on = Arc::new(AtomicBool::new(true));
    let theirs = goes_on.clone();
    let foreign = std::thread::Builder::new().name("foreign".to_owned());
    let foreign = foreign
        .spawn(move || {
            let push = r#"{"inverse3":[{"device_id":"049D","commands":{"set_cursor_force":{"vector":{"x":0.5,"y":0,"z":0}}}}]}"#;
            while theirs.load(Relaxed) {
                socket.send(tungstenite::Message::text(push)).unwrap();
                socket.read().unwrap();
                std::thread::sleep(Duration::from_millis(1));
            }
        })
        .unwrap();
    eventually("pressing", || double.record().last().is_some_and(|line| line.2 != DVec3::ZERO));
    assert!(refusal(double.settings()).contains("049D is in use by another program"));
    assert!(
        double.record().iter().skip(5).all(|(_, event, force)| event != "command" || *force != DVec3::ZERO)
    );
    goes_on.store(false, Relaxed);
    foreign.join().unwrap();
    eventually("its end", || haply::open(double.settings()).is_ok());
}

#[test]
fn limits_that_are_none_are_refused() {
    for max_force_n in [0.0, -1.0, f64::NAN, f64::INFINITY, 100.0] {
        let text = refusal(Settings { max_force_n, ..Settings::default() });
        assert!(text.contains("haply.max_force"), "{text}");
    }
}
