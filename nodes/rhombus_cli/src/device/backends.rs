//! From the command line to a backend, and back from its errors to a sentence with a remedy.

use std::path::PathBuf;
use std::time::Duration;

use anyhow::bail;
use clap::{Args, ValueHint};
use devices::simulated::{Flaws, HandSettings, Phase, Script, Segment};
use devices::{Backend, DeviceError, Listed, force_dimension, haply, pointer, serial, simulated, spacemouse};

/// Backends of real devices, in the order in which they are asked.
pub(super) const REAL: [&str; 4] = ["force_dimension", "haply", "serial", "spacemouse"];
/// The scripted hand.
pub(super) const SIMULATED: &str = "simulated";
/// The hand that a pointer leads. Both are always there.
pub(super) const POINTER: &str = "pointer";

/// Where backends look for their devices.
#[derive(Args)]
pub(super) struct Places {
    /// Folder of the Force Dimension SDK, looked into first
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    sdk: Option<PathBuf>,
    /// Address of the Haply service
    #[arg(long, value_name = "URL", default_value = haply::DEFAULT_URL)]
    url: String,
    /// Serial port of a self-built device, or a folder of ports; by default every USB serial port
    #[arg(long, value_name = "PATH", value_hint = ValueHint::AnyPath)]
    port: Option<String>,
    /// Bits per second of a serial port that is a UART
    #[arg(long, value_name = "BIT/S", default_value_t = 921_600)]
    baud: u32,
}

impl Places {
    /// The backend of this name, to open the device with this serial number at this rate.
    pub(super) fn backend(&self, name: &str, serial: &str, rate_hz: f64) -> anyhow::Result<Backend> {
        Ok(match name {
            SIMULATED | POINTER if !serial.is_empty() => {
                bail!("the {name} device has no serial number; leave out {serial:?}");
            }
            SIMULATED => Backend::Simulated(resting_hand(rate_hz)?),
            POINTER => Backend::Pointer(hand_without_a_pointer(rate_hz)),
            "force_dimension" => Backend::ForceDimension(self.force_dimension(serial, rate_hz)),
            "haply" => Backend::Haply(self.haply(serial)),
            "serial" => Backend::Serial(self.serial(serial)),
            "spacemouse" => Backend::SpaceMouse(spacemouse(serial)),
            other => bail!("{other:?} is no device; accepted: {}, {SIMULATED}, {POINTER}", REAL.join(", ")),
        })
    }

    /// The devices of one of [`REAL`] that are connected, and why there may be more.
    pub(super) fn list(&self, name: &str) -> Listed {
        let listed = match name {
            "force_dimension" => force_dimension::list(&self.force_dimension("", 1000.0)).map(Listed::from),
            "haply" => haply::list(&self.haply("")).map(Listed::from),
            "serial" => serial::list(&self.serial("")),
            _ => spacemouse::list(&spacemouse("")).map(Listed::from),
        };
        listed.unwrap_or_else(|problem| Listed { found: Vec::new(), problems: vec![problem] })
    }

    /// What a backend that found nothing can say all the same: where it looked.
    pub(super) fn looked(&self, name: &str) -> String {
        match (name, &self.port) {
            ("force_dimension", _) => "the SDK finds none".to_owned(),
            ("haply", _) => format!("the service at {} lists none", self.url),
            ("serial", Some(port)) => format!("nothing at {port} answers"),
            ("serial", None) => "no USB serial port, or none that answers; --port names a port".to_owned(),
            _ => "no HID device of this kind".to_owned(),
        }
    }

    fn force_dimension(&self, serial: &str, rate_hz: f64) -> force_dimension::Settings {
        force_dimension::Settings {
            serial: serial.to_owned(),
            sdk: self.sdk.clone().unwrap_or_default(),
            period_s: 1.0 / rate_hz,
        }
    }

    fn haply(&self, serial: &str) -> haply::Settings {
        haply::Settings { url: self.url.clone(), serial: serial.to_owned(), ..haply::Settings::default() }
    }

    fn serial(&self, serial: &str) -> serial::Settings {
        serial::Settings {
            port: self.port.clone().unwrap_or_default(),
            baud: self.baud,
            serial: serial.to_owned(),
        }
    }
}

fn spacemouse(serial: &str) -> spacemouse::Settings {
    spacemouse::Settings { serial: serial.to_owned(), ..spacemouse::Settings::default() }
}

const HAND: HandSettings = HandSettings { mass_kg: 0.3, stiffness_n_per_m: 500.0, damping_n_s_per_m: 20.0 };

/// A hand that nobody leads: it resists by its damper.
fn hand_without_a_pointer(rate_hz: f64) -> pointer::Settings {
    pointer::Settings {
        hand: HAND,
        start: glam::DVec3::ZERO,
        max_speed_m_per_s: 0.5,
        period_s: 1.0 / rate_hz,
        targets: pointer::Targets::new(),
    }
}

/// A hand that stays in the middle of the workspace.
fn resting_hand(rate_hz: f64) -> anyhow::Result<simulated::Settings> {
    let rest =
        Segment { phase: Phase::Hold, duration_s: 1.0, path: vec![glam::DVec3::ZERO], gripper_rad: 0.5 };
    Ok(simulated::Settings {
        hand: HAND,
        script: Script::new(vec![rest])?,
        period_s: 1.0 / rate_hz,
        flaws: Flaws::default(),
    })
}

/// An error as what was found and what to do.
pub(super) fn told(error: &DeviceError, backend: &str) -> (String, String) {
    let text = error.to_string();
    let own = match error {
        DeviceError::NotFound { remedy, .. }
        | DeviceError::Permission { remedy, .. }
        | DeviceError::Library { remedy, .. }
        | DeviceError::Protocol { remedy, .. } => Some(remedy.clone()),
        DeviceError::Busy { .. } => Some("end that program, then try again".to_owned()),
        _ => None,
    };
    if let Some(remedy) = own {
        let found = text.strip_suffix(&format!("; {remedy}")).unwrap_or(&text);
        return (found.to_owned(), remedy);
    }
    let remedy = match error {
        DeviceError::Ambiguous { found, .. } => match found.first() {
            Some(serial) => format!("choose one, for example `rhombus device check {backend}:{serial}`"),
            None => String::new(),
        },
        DeviceError::Lost { .. } => "check cable and power, then run this again".to_owned(),
        _ => String::new(),
    };
    (text, remedy)
}

/// A rate from the command line.
pub(super) fn rate(text: &str) -> Result<f64, String> {
    let accepted = |rate_hz: &f64| (10.0..=4000.0).contains(rate_hz);
    text.parse().ok().filter(accepted).ok_or_else(|| "accepted: 10 to 4000 Hz".to_owned())
}

/// A time from the command line.
pub(super) fn seconds(text: &str) -> Result<Duration, String> {
    let refused = || "accepted: 0.1 to 60 s".to_owned();
    let seconds: f64 = text.parse().map_err(|_| refused())?;
    let duration = Duration::try_from_secs_f64(seconds).map_err(|_| refused())?;
    if (0.1..=60.0).contains(&seconds) { Ok(duration) } else { Err(refused()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_found_and_what_to_do_are_told_apart_and_nothing_is_lost() {
        let remedy = || "do this".to_owned();
        let what = || "that".to_owned();
        for error in [
            DeviceError::NotFound { device: "serial", looked: what(), remedy: remedy() },
            DeviceError::Permission { what: what(), remedy: remedy() },
            DeviceError::Library { what: what(), remedy: remedy() },
            DeviceError::Protocol { device: "serial", what: what(), remedy: remedy() },
            DeviceError::Busy { what: what() },
        ] {
            let (found, remedy) = told(&error, "serial");
            assert_eq!(format!("{found}; {remedy}"), error.to_string());
        }
    }

    #[test]
    fn every_error_of_an_open_or_a_choice_has_a_remedy() {
        for error in [
            DeviceError::Ambiguous { device: "haply", found: vec!["A".to_owned(), "B".to_owned()] },
            DeviceError::Lost { device: "haply", reason: "the cable is out" },
        ] {
            let (found, remedy) = told(&error, "haply");
            assert_eq!(found, error.to_string());
            assert!(!remedy.is_empty());
        }
        let (_, remedy) =
            told(&DeviceError::Ambiguous { device: "haply", found: vec!["A".to_owned()] }, "haply");
        assert!(remedy.contains("haply:A"), "{remedy}");
    }
}
