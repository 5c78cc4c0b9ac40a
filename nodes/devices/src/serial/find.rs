//! Which of the devices that answer is meant.

use std::thread;

use super::{BACKEND, Port, SerialDevice, Settings, port};
use crate::{Device, DeviceError, Found, Listed};

/// A port that was tried, and what came of it.
pub(super) type Tried = (String, Result<SerialDevice<Port>, DeviceError>);

/// Says hello at every candidate at once.
pub(super) fn try_all(settings: &Settings) -> Result<Vec<Tried>, DeviceError> {
    let candidates = port::candidates(&settings.port)?;
    let attempt = |path: &str| SerialDevice::greet(Port::open(path, settings.baud)?, path);
    Ok(thread::scope(|scope| {
        let attempts: Vec<_> = candidates
            .iter()
            .map(|path| {
                let named = thread::Builder::new().name("serial hello".to_owned());
                (path, named.spawn_scoped(scope, || attempt(path)))
            })
            .collect();
        let finished = attempts.into_iter().map(|(path, thread)| {
            // Without a thread, or without its answer, the port is tried here.
            let result = thread.ok().and_then(|thread| thread.join().ok()).unwrap_or_else(|| attempt(path));
            (path.clone(), result)
        });
        finished.collect()
    }))
}

/// The one device that `serial` selects.
pub(super) fn choose(tried: Vec<Tried>, serial: &str) -> Result<SerialDevice<Port>, DeviceError> {
    let (mut meant, mut others, mut errors) = (Vec::new(), Vec::new(), Vec::new());
    for (path, result) in tried {
        match result {
            Ok(device) if serial.is_empty() || device.description().serial == serial => {
                meant.push((path, device));
            }
            Ok(device) => others.push(format!("{} at {path}", device.description().serial)),
            Err(error) => errors.push((path, error)),
        }
    }
    match (meant.len(), errors.len(), others.is_empty()) {
        (1, ..) => {}
        (2.., ..) => return Err(ambiguous(&meant)),
        (_, 1, true) => return Err(errors.remove(0).1),
        _ => return Err(none(serial, &others, &errors)),
    }
    Ok(meant.remove(0).1)
}

/// What answers, for people, and what stands in the way of the rest. A port with nothing to say belongs to something else.
pub(super) fn listed(tried: Vec<Tried>) -> Listed {
    let mut listed = Listed::default();
    for (path, result) in tried {
        match result {
            Ok(device) => {
                let description = device.description();
                let (model, firmware) = (&description.model, &description.firmware);
                let what =
                    format!("{model} at {path}, firmware {firmware}, {} states/s", device.state_rate_hz());
                listed.found.push(Found { backend: BACKEND, serial: description.serial.clone(), what });
            }
            Err(DeviceError::NotFound { .. }) => {}
            Err(problem) => listed.problems.push(problem),
        }
    }
    listed
}

fn ambiguous(meant: &[(String, SerialDevice<Port>)]) -> DeviceError {
    let mut serials: Vec<String> =
        meant.iter().map(|(_, device)| device.description().serial.clone()).collect();
    serials.sort();
    let alike = serials.windows(2).any(|pair| pair[0] == pair[1]);
    if alike || serials.iter().any(String::is_empty) {
        // A serial number that is not one chooses nothing; the port does.
        let places: Vec<String> =
            meant.iter().map(|(path, device)| format!("{path} ({})", device.description().model)).collect();
        return DeviceError::Setting {
            name: "serial.port",
            value: "\"\"".to_owned(),
            accepted: format!("one of {}: their serial numbers do not tell them apart", places.join(", ")),
        };
    }
    DeviceError::Ambiguous { device: BACKEND, found: serials }
}

fn none(serial: &str, others: &[String], errors: &[(String, DeviceError)]) -> DeviceError {
    let mut looked = match serial {
        "" => "none of the ports answers as one".to_owned(),
        serial => format!("none with serial number {serial}"),
    };
    if !others.is_empty() {
        looked += &format!("; found {}", others.join(", "));
    }
    for (path, error) in errors {
        looked += &format!("; {path}: {error}");
    }
    let remedy = match others.is_empty() {
        true => "see to one of these, or name the port with serial.port",
        false => "set device.serial to one that was found, or plug the other in",
    };
    DeviceError::NotFound { device: BACKEND, looked, remedy: remedy.to_owned() }
}
