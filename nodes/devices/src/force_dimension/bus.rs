//! Choosing and opening one device among those on the bus. Not RT safe.

use std::ffi::c_int;
use std::sync::PoisonError;
use std::time::Duration;

use super::failure::Failure;
use super::model::Model;
use super::sdk::{Id, Sdk};
use super::{BACKEND, usb};
use crate::{DeviceError, Found};

/// Another driver that starts at the same moment looks at every device for a moment too; so one in use is asked for
/// again, this often.
const TRIES: u32 = 10;
const BETWEEN_TRIES: Duration = Duration::from_millis(50);

const UDEV_REMEDY: &str =
    "install config/udev/70-rhombus-haptics.rules (its first lines say how) and plug the device in again";

/// A device that is open; it closes when dropped.
pub(super) struct Opened {
    pub(super) sdk: &'static Sdk,
    pub(super) id: Id,
    pub(super) serial: u16,
}

impl Drop for Opened {
    fn drop(&mut self) {
        let mut open = self.sdk.open.lock().unwrap_or_else(PoisonError::into_inner);
        open.retain(|&(id, _)| id != self.id);
        self.sdk.close(self.id);
    }
}

/// Opens the device with this serial number, or the only one.
pub(super) fn open(sdk: &'static Sdk, wanted: Option<u16>) -> Result<Opened, DeviceError> {
    for _ in 1..TRIES {
        match try_open(sdk, wanted) {
            Err(DeviceError::Busy { .. }) => std::thread::sleep(BETWEEN_TRIES),
            answer => return answer,
        }
    }
    try_open(sdk, wanted)
}

fn try_open(sdk: &'static Sdk, wanted: Option<u16>) -> Result<Opened, DeviceError> {
    let mut open = sdk.open.lock().unwrap_or_else(PoisonError::into_inner);
    let count = count(sdk)?;
    if count == 0 {
        return Err(nothing_there(sdk));
    }
    let what = wanted.map_or_else(
        || "the Force Dimension device".to_owned(),
        |serial| format!("the Force Dimension device {serial}"),
    );
    let (mut serials, mut refused) = (Vec::new(), None);
    for index in 0..count {
        match sdk.open_id(index) {
            Ok(id) => {
                // A second opening in this process gives the same device again.
                let ours = open.iter().any(|&(other, _)| other == id);
                let serial = sdk.serial_number(id);
                let is_wanted = wanted.map_or(count == 1, |wanted| serial == Ok(wanted));
                if is_wanted && !ours {
                    let serial = serial.unwrap_or(u16::MAX);
                    open.push((id, serial));
                    return Ok(Opened { sdk, id, serial });
                }
                if !ours {
                    sdk.close(id);
                } else if is_wanted {
                    return Err(DeviceError::Busy { what });
                }
                serials.push(
                    serial.map_or_else(|_| "one without a number".to_owned(), |serial| serial.to_string()),
                );
            }
            Err(failure) => {
                let error = refusal(sdk, failure, &what);
                serials.push("one in use or refused".to_owned());
                refused.get_or_insert(error);
            }
        }
    }
    match (wanted, refused) {
        // The one that did not open may be it.
        (Some(_), Some(error)) => Err(error),
        (Some(wanted), None) => Err(DeviceError::NotFound {
            device: BACKEND,
            looked: format!("looked for device.serial {wanted}, there is {}", serials.join(", ")),
            remedy: "correct device.serial, or connect and power that device".to_owned(),
        }),
        (None, Some(error)) if count == 1 => Err(error),
        (None, _) => Err(DeviceError::Ambiguous { device: BACKEND, found: serials }),
    }
}

/// Every device on the bus, those in use too.
pub(super) fn list(sdk: &'static Sdk) -> Result<Vec<Found>, DeviceError> {
    let open = sdk.open.lock().unwrap_or_else(PoisonError::into_inner);
    let count = count(sdk)?;
    if count == 0 {
        return match nothing_there(sdk) {
            DeviceError::NotFound { .. } => Ok(Vec::new()),
            error => Err(error),
        };
    }
    Ok((0..count)
        .map(|index| match sdk.open_id(index) {
            Ok(id) => {
                let serial =
                    sdk.serial_number(id).map_or_else(|_| String::new(), |serial| serial.to_string());
                let ours = open.iter().any(|&(other, _)| other == id);
                let what = match sdk.system_type(id).map(Model::of_type) {
                    Ok(Ok(model)) if ours => format!("{}, open in this program", model.name),
                    Ok(Ok(model)) => model.name.to_owned(),
                    Ok(Err(why)) => format!("cannot be driven: {why}"),
                    Err(failure) => failure.text().to_owned(),
                };
                if !ours {
                    sdk.close(id);
                }
                Found { backend: BACKEND, serial, what }
            }
            Err(failure) => {
                let what = refusal(sdk, failure, &format!("device {index} on the bus")).to_string();
                Found { backend: BACKEND, serial: String::new(), what }
            }
        })
        .collect())
}

fn count(sdk: &Sdk) -> Result<c_int, DeviceError> {
    sdk.device_count().map_err(|failure| DeviceError::Protocol {
        device: BACKEND,
        what: format!("{} cannot count the devices: {}", sdk.text(), failure.text()),
        remedy: "check that libusb-1.0 is installed and that /dev/bus/usb is there (in a container: mapped)"
            .to_owned(),
    })
}

/// Why the SDK sees nothing: nothing there, or nothing that this user may open.
fn nothing_there(sdk: &Sdk) -> DeviceError {
    let usb = usb::devices();
    if let Some(device) = usb.iter().find(|device| !device.permitted) {
        return permission(&device.node.display().to_string());
    }
    let on_usb = match usb.len() {
        0 => "USB shows none of Force Dimension (1451) or Novint (0403:cb48)".to_owned(),
        some => format!("although USB shows {some}"),
    };
    DeviceError::NotFound {
        device: BACKEND,
        looked: format!("{} finds none, {on_usb}", sdk.text()),
        remedy: "connect the device and switch its power on".to_owned(),
    }
}

/// Why a device did not open.
fn refusal(sdk: &Sdk, failure: Failure, what: &str) -> DeviceError {
    let words = sdk.last_words();
    if failure.is_busy() {
        return DeviceError::Busy { what: what.to_owned() };
    }
    if failure == Failure::NO_DRIVER_FOUND {
        return permission(what);
    }
    if let Some(device) = usb::devices().iter().find(|device| !device.permitted) {
        return permission(&device.node.display().to_string());
    }
    // Counted, but not available: that is how the SDK speaks of devices that other programs have.
    if let (Ok(all), Ok(available)) = (sdk.device_count(), sdk.available_count())
        && available < all
    {
        return DeviceError::Busy { what: what.to_owned() };
    }
    DeviceError::Protocol {
        device: BACKEND,
        what: format!("{what} does not open: {} ({words})", failure.text()),
        remedy: "switch the device off and on again, and try another cable or USB port".to_owned(),
    }
}

fn permission(what: &str) -> DeviceError {
    DeviceError::Permission { what: what.to_owned(), remedy: UDEV_REMEDY.to_owned() }
}
