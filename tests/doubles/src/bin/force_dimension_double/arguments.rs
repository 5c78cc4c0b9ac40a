//! The command line.
//!
//! Options of a device: the hand's (`--from --to --after --during --mass --stiffness --damping`), `--record FILE`,
//! `--gripper RAD`, `--max-force N`, `--max-torque N M`, `--max-gripper-force N` (what `dhdGetMax...` answers, any float),
//! `--peak-force N` (where the motors saturate), `--threshold M/S` (its speed limit), `--firmware-watchdog none|UNITS`
//! (it has none, or answers this whatever was set), `--garbage KIND`, `--refuse CODE` (opening fails with this error number
//! of the SDK), `--unhomed`, `--homing S`, `--homing-fails`.

use std::path::PathBuf;

use rhombus_doubles::HandArguments;

use crate::hardware::Garbage;

/// All of it.
pub(crate) struct Arguments {
    pub(crate) sdk: PathBuf,
    pub(crate) version: [i32; 4],
    pub(crate) only_dhd: bool,
    pub(crate) control: bool,
    pub(crate) devices: Vec<Device>,
}

/// What one device is.
#[derive(Clone, Debug)]
pub(crate) struct Device {
    pub(crate) kind: Kind,
    pub(crate) serial: u16,
    pub(crate) hand: HandArguments,
    pub(crate) record: Option<PathBuf>,
    pub(crate) gripper_rad: f64,
    pub(crate) max_wrench: [f64; 3],
    pub(crate) peak_force_n: f64,
    pub(crate) threshold_m_per_s: f64,
    pub(crate) firmware_watchdog: FirmwareWatchdog,
    pub(crate) garbage: Garbage,
    pub(crate) refuse: Option<i32>,
    pub(crate) homed: bool,
    pub(crate) homing_s: f64,
    pub(crate) homing_fails: bool,
}

/// How the controller takes a watchdog.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FirmwareWatchdog {
    Settable,
    None,
    Answers(u8),
}

/// What the device has, by the number of `dhdGetSystemType`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Kind {
    pub(crate) number: i32,
    pub(crate) wrist: bool,
    pub(crate) active_wrist: bool,
    pub(crate) gripper: bool,
    pub(crate) left: bool,
}

impl Kind {
    const fn new(number: i32, wrist: bool, active_wrist: bool, gripper: bool, left: bool) -> Kind {
        Kind { number, wrist, active_wrist, gripper, left }
    }

    /// By its name, or by a number of which nothing more is known.
    fn named(name: &str) -> Result<Kind, String> {
        Ok(match name {
            "delta.3" => Kind::new(63, false, false, false, false),
            "omega.3" => Kind::new(33, false, false, false, false),
            "omega.6-right" => Kind::new(34, true, false, false, false),
            "omega.6-left" => Kind::new(36, true, false, false, true),
            "omega.7-right" => Kind::new(35, true, false, true, false),
            "omega.7-left" => Kind::new(37, true, false, true, true),
            "sigma.3" => Kind::new(206, false, false, false, false),
            "sigma.7-right" => Kind::new(104, true, true, true, false),
            "sigma.7-left" => Kind::new(105, true, true, true, true),
            "lambda.3" => Kind::new(203, false, false, false, false),
            "lambda.6-right" => Kind::new(131, true, true, false, false),
            "lambda.6-left" => Kind::new(132, true, true, false, true),
            "lambda.7-right" => Kind::new(108, true, true, true, false),
            "lambda.7-left" => Kind::new(109, true, true, true, true),
            "falcon" => Kind::new(60, false, false, false, false),
            other => match other.parse() {
                Ok(number) => Kind::new(number, false, false, false, false),
                Err(_) => {
                    return Err(format!(
                        "--device {name:?}: accepted is delta.3, omega.7-left, ... or a type number"
                    ));
                }
            },
        })
    }
}

impl Device {
    fn new(serial: u16) -> Device {
        Device {
            kind: Kind::new(63, false, false, false, false),
            serial,
            hand: HandArguments::default(),
            record: None,
            gripper_rad: 0.3,
            max_wrench: [-1.0; 3],
            peak_force_n: 25.0,
            threshold_m_per_s: 2.0,
            firmware_watchdog: FirmwareWatchdog::Settable,
            garbage: Garbage::None,
            refuse: None,
            homed: true,
            homing_s: 0.2,
            homing_fails: false,
        }
    }
}

impl Arguments {
    /// Reads the options in order.
    pub(crate) fn parse(mut options: impl Iterator<Item = String>) -> Result<Arguments, String> {
        let (mut sdk, mut version) = (None, rhombus_sdk_double::VERSION);
        let (mut only_dhd, mut control) = (false, false);
        let (mut devices, mut named) = (Vec::new(), false);
        let mut device = Device::new(10_000);
        while let Some(option) = options.next() {
            match option.as_str() {
                "--only-dhd" => only_dhd = true,
                "--control" => control = true,
                "--unhomed" => device.homed = false,
                "--homing-fails" => device.homing_fails = true,
                _ => {
                    let value = options.next().ok_or(format!("{option} needs a value"))?;
                    match option.as_str() {
                        "--sdk" => sdk = Some(PathBuf::from(value)),
                        "--sdk-version" => version = dotted(&value)?,
                        "--device" => {
                            if named {
                                let next = Device::new(10_001 + devices.len() as u16);
                                devices.push(std::mem::replace(&mut device, next));
                            }
                            named = true;
                            let (name, serial) = value.split_once(':').unwrap_or((&value, ""));
                            device.kind = Kind::named(name)?;
                            if !serial.is_empty() {
                                device.serial = number(&option, serial)?;
                            }
                        }
                        _ => device.take(&option, &value)?,
                    }
                }
            }
        }
        devices.push(device);
        Ok(Arguments { sdk: sdk.ok_or("--sdk FOLDER is needed")?, version, only_dhd, control, devices })
    }
}

impl Device {
    fn take(&mut self, option: &str, value: &str) -> Result<(), String> {
        match option {
            "--record" => self.record = Some(PathBuf::from(value)),
            "--gripper" => self.gripper_rad = number(option, value)?,
            "--max-force" => self.max_wrench[0] = number(option, value)?,
            "--max-torque" => self.max_wrench[1] = number(option, value)?,
            "--max-gripper-force" => self.max_wrench[2] = number(option, value)?,
            "--peak-force" => self.peak_force_n = number(option, value)?,
            "--threshold" => self.threshold_m_per_s = number(option, value)?,
            "--firmware-watchdog" if value == "none" => self.firmware_watchdog = FirmwareWatchdog::None,
            "--firmware-watchdog" => {
                self.firmware_watchdog = FirmwareWatchdog::Answers(number(option, value)?)
            }
            "--garbage" => self.garbage = value.parse()?,
            "--refuse" => self.refuse = Some(number(option, value)?),
            "--homing" => self.homing_s = number(option, value)?,
            _ if self.hand.take(option, value)? => {}
            _ => return Err(format!("{option} is not an option")),
        }
        Ok(())
    }
}

fn dotted(value: &str) -> Result<[i32; 4], String> {
    let parts: Result<Vec<i32>, _> = value.split('.').map(str::parse).collect();
    match parts.as_deref() {
        Ok(&[major, minor, release, revision]) => Ok([major, minor, release, revision]),
        _ => Err(format!("--sdk-version {value:?}: accepted is four numbers, such as 3.17.5.0")),
    }
}

fn number<T: std::str::FromStr>(option: &str, value: &str) -> Result<T, String> {
    value.parse().map_err(|_| format!("{option} {value:?}: accepted is a number"))
}
