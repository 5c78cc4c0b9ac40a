//! Lines on standard input that change a running device: its number, a verb, and a value. Each is answered by `done: LINE`.
//!
//! `unplug`, `plug`, `press BUTTON`, `release BUTTON` (from 0), `gripper RAD`, `garbage KIND`, `force-button` (somebody
//! switches the forces off at the device).

use std::io;

use rhombus_doubles::{Event, monotonic_ns};

use crate::hardware::{Hardware, cause};
use crate::{Shared, lock};

pub(crate) fn follow(lines: impl Iterator<Item = io::Result<String>>, shared: &Shared) {
    for line in lines.map_while(Result::ok) {
        match obey(&line, shared) {
            Ok(()) => println!("done: {line}"),
            Err(why) => println!("refused: {line}: {why}"),
        }
    }
}

fn obey(line: &str, shared: &Shared) -> Result<(), String> {
    let mut words = line.split_whitespace();
    let (number, verb) = (words.next().unwrap_or_default(), words.next().unwrap_or_default());
    let number: usize = number.parse().map_err(|_| "first comes the device's number".to_owned())?;
    let mut bus = lock(shared);
    let hardware = bus.devices.get_mut(number).ok_or("there is no such device")?;
    change(hardware, verb, words.next().unwrap_or_default())
}

fn change(hardware: &mut Hardware, verb: &str, value: &str) -> Result<(), String> {
    let now_ns = monotonic_ns();
    let recorded = |written: io::Result<()>| written.map_err(|error| error.to_string());
    let button = || match value.parse::<u32>() {
        Ok(button) if button < u32::BITS => Ok(1 << button),
        _ => Err("a button is 0 to 31".to_owned()),
    };
    match verb {
        "unplug" => recorded(hardware.plug(now_ns, false)),
        "plug" => recorded(hardware.plug(now_ns, true)),
        "force-button" => recorded(hardware.switch_off(now_ns, Event::Off, cause::BUTTON)),
        "press" => {
            hardware.buttons |= button()?;
            Ok(())
        }
        "release" => {
            hardware.buttons &= !button()?;
            Ok(())
        }
        "gripper" => {
            hardware.device.gripper_rad = value.parse().map_err(|_| "an angle is a number".to_owned())?;
            Ok(())
        }
        "garbage" => {
            hardware.device.garbage = value.parse()?;
            Ok(())
        }
        _ => Err("verbs are unplug, plug, press, release, gripper, garbage, force-button".to_owned()),
    }
}
