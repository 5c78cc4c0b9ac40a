//! Which of the devices that the service lists is meant, and whether it can be used.

use super::message::{Arm, Message};
use super::request::Spelling;
use super::{BACKEND, Settings};
use crate::{DeviceError, Found};

/// The Inverse3 that `device.serial` selects: by its id or its long id, in upper or lower case; without a serial the only
/// one.
pub(super) fn arm<'m, 'a>(message: &'m Message<'a>, settings: &Settings) -> Result<&'m Arm<'a>, DeviceError> {
    let arms = message.arms();
    let ids = || arms.iter().map(|arm| arm.device_id.to_string()).collect::<Vec<_>>();
    let chosen = if settings.serial.is_empty() {
        match arms {
            [] => None,
            [arm] => Some(arm),
            _ => return Err(DeviceError::Ambiguous { device: BACKEND, found: ids() }),
        }
    } else {
        arms.iter().find(|arm| is_called(arm, &settings.serial))
    };
    let arm = chosen.ok_or_else(|| DeviceError::NotFound {
        device: BACKEND,
        looked: if settings.serial.is_empty() {
            format!("the service at {} lists no Inverse3", settings.url)
        } else {
            let listed = if arms.is_empty() { "none".to_owned() } else { ids().join(", ") };
            format!("the service at {} lists no Inverse3 {:?}, but {listed}", settings.url, settings.serial)
        },
        remedy: "connect the device, switch it on, and look whether Haply Hub shows it".to_owned(),
    })?;
    usable(arm)?;
    Ok(arm)
}

fn is_called(arm: &Arm, serial: &str) -> bool {
    let uuid = arm.config.as_ref().and_then(|config| config.device_info.as_ref()?.uuid.as_deref());
    arm.device_id.eq_ignore_ascii_case(serial) || uuid.is_some_and(|uuid| uuid.eq_ignore_ascii_case(serial))
}

fn usable(arm: &Arm) -> Result<(), DeviceError> {
    let refuse = |what: String, remedy: &str| {
        Err(DeviceError::Protocol { device: BACKEND, what, remedy: remedy.to_owned() })
    };
    let id = &arm.device_id;
    if arm.status.calibrated == Some(false) {
        return refuse(
            format!("the Inverse3 {id} is not calibrated"),
            "put its arm on the rest, switch it off and on, and calibrate it in Haply Hub",
        );
    }
    let permutation = arm.config.as_ref().and_then(|config| config.basis.as_ref()?.permutation.as_deref());
    if let Some(permutation) = permutation.filter(|axes| *axes != "XYZ") {
        return refuse(
            format!("the service is set to the axes {permutation} for the Inverse3 {id}; forces would turn"),
            "set the basis of the device to XYZ in Haply Hub",
        );
    }
    if arm.state.cursor_position.is_none() {
        return refuse(
            format!("the service gives no position of the Inverse3 {id}"),
            "update the Haply service to 3.1 or newer",
        );
    }
    Ok(())
}

/// The grip that `haply.grip` names; without a name the only one. None: the service knows no grip.
pub(super) fn grip(message: &Message, settings: &Settings) -> Result<Option<String>, DeviceError> {
    let ids: Vec<String> = message.grips().iter().map(|grip| grip.device_id.to_string()).collect();
    let refused = |accepted: String| {
        Err(DeviceError::Setting { name: "haply.grip", value: format!("{:?}", settings.grip), accepted })
    };
    if settings.grip.is_empty() {
        return match ids.as_slice() {
            [] => Ok(None),
            [id] => Ok(Some(id.clone())),
            _ => refused(format!("one of {}, for the service lists {} grips", ids.join(", "), ids.len())),
        };
    }
    match ids.iter().find(|id| id.eq_ignore_ascii_case(&settings.grip)) {
        Some(id) => Ok(Some(id.clone())),
        None if ids.is_empty() => {
            refused("\"\", for the service lists no grip; pair it in Haply Hub".to_owned())
        }
        None => refused(format!("one of {}, which the service lists", ids.join(", "))),
    }
}

/// How the service spells a force, judged by what its inventory has: `current_cursor_force` and `preset` came with 3.5, as
/// did `vector`.
pub(super) fn spelling(arm: &Arm) -> Spelling {
    let preset = arm.config.as_ref().is_some_and(|config| config.preset.is_some());
    if preset || arm.state.current_cursor_force.is_some() { Spelling::Vector } else { Spelling::Values }
}

/// The maker's name of the model.
pub(super) fn model(arm: &Arm) -> String {
    let kind = arm.config.as_ref().and_then(|config| config.kind.as_deref());
    match kind {
        None | Some("inverse3") => "Inverse3".to_owned(),
        Some("inverse3x") => "Inverse3x".to_owned(),
        Some("minverse") => "Minverse".to_owned(),
        Some(other) => other.to_owned(),
    }
}

/// Versions, as far as the service says them.
pub(super) fn firmware(arm: &Arm) -> String {
    let Some(config) = &arm.config else { return String::new() };
    let mut parts = Vec::new();
    if let Some(info) = &config.device_info
        && let (Some(major), Some(minor)) = (info.major_version, info.minor_version)
    {
        parts.push(format!("hardware {major}.{minor}"));
    }
    if let Some(firmware) = &config.extended_firmware_version {
        parts.push(format!("firmware {firmware}"));
    }
    parts.join(", ")
}

/// A line for `rhombus device list`.
pub(super) fn found(arm: &Arm) -> Found {
    let mut what = format!("{} {}", model(arm), arm.device_id);
    if let Some(port) = arm.config.as_ref().and_then(|config| config.port.as_deref()) {
        what.push_str(&format!(" on {port}"));
    }
    what.push_str(match (arm.status.calibrated, arm.status.in_use) {
        (Some(false), _) => ", not calibrated",
        (_, Some(true)) => ", in use by another session",
        _ => "",
    });
    Found { backend: BACKEND, serial: arm.device_id.to_string(), what }
}
