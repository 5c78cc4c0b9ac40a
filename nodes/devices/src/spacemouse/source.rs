//! Where reports come from: the device, or a recording.

use std::ffi::{CStr, CString};
use std::io;

use hidapi::{HidApi, HidDevice};

use super::models::{self, Model};
use super::{BACKEND, RULES};
use crate::DeviceError;

/// Gives reports, one after the other.
pub(super) trait ReportSource: Send {
    /// The next report that is there at `now_ns`, and its length; 0: none. RT safe: never waits.
    fn next(&mut self, now_ns: u64, report: &mut [u8]) -> Result<usize, &'static str>;
}

/// The device itself, through `/dev/hidraw*`.
pub(super) struct Hidraw(HidDevice);

impl ReportSource for Hidraw {
    fn next(&mut self, _: u64, report: &mut [u8]) -> Result<usize, &'static str> {
        self.0.read_timeout(report, 0).map_err(|_| "it was unplugged or switched off")
    }
}

/// A device that the operating system lists.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Listed {
    pub(super) model: Model,
    /// Most have none; then the path stands for it.
    pub(super) serial: String,
    pub(super) path: CString,
}

impl Listed {
    /// What `device.serial` selects it by.
    pub(super) fn name(&self) -> String {
        if self.serial.is_empty() { self.path.to_string_lossy().into_owned() } else { self.serial.clone() }
    }

    fn is_called(&self, serial: &str) -> bool {
        self.serial == serial || self.path.to_bytes() == serial.as_bytes()
    }
}

/// The operating system's HID devices.
pub(super) fn hid() -> Result<HidApi, DeviceError> {
    HidApi::new().map_err(|error| DeviceError::Library {
        what: format!("the HID devices cannot be listed ({error})"),
        remedy: "see whether /sys/class/hidraw can be read".to_owned(),
    })
}

/// All devices of the table. The second number: how many HID devices there are at all.
pub(super) fn listed(api: &HidApi) -> (Vec<Listed>, usize) {
    let mut paths: Vec<&CStr> = Vec::new();
    let mut found: Vec<Listed> = Vec::new();
    for info in api.device_list() {
        if !paths.contains(&info.path()) {
            paths.push(info.path());
        }
        // Generic desktop, multi-axis controller; a receiver has other interfaces too. Zero: not known.
        let is_axes = matches!((info.usage_page(), info.usage()), (1, 8) | (0, 0));
        let Some(model) = models::of(info.vendor_id(), info.product_id()).filter(|_| is_axes) else {
            continue;
        };
        if found.iter().all(|known| known.path.as_c_str() != info.path()) {
            let serial = info.serial_number().unwrap_or_default().to_owned();
            found.push(Listed { model, serial, path: info.path().to_owned() });
        }
    }
    found.sort_by(|a, b| a.path.cmp(&b.path));
    (found, paths.len())
}

/// The one that is meant.
pub(super) fn choose(found: Vec<Listed>, all: usize, serial: &str) -> Result<Listed, DeviceError> {
    let names: Vec<String> = found.iter().map(Listed::name).collect();
    if serial.is_empty() && found.len() > 1 {
        return Err(DeviceError::Ambiguous { device: BACKEND, found: names });
    }
    found.into_iter().find(|listed| serial.is_empty() || listed.is_called(serial)).ok_or_else(|| {
        let looked = if names.is_empty() {
            format!("looked for the USB ids {} among {all} HID devices", models::ids())
        } else {
            format!("looked for {serial:?}, found {}", names.join(", "))
        };
        DeviceError::NotFound {
            device: BACKEND,
            looked,
            remedy: "connect it, or its receiver, and switch it on; in a container pass its /dev/hidraw* on"
                .to_owned(),
        }
    })
}

/// Opens it for reading without waiting.
pub(super) fn open(api: &HidApi, listed: &Listed) -> Result<Hidraw, DeviceError> {
    let path = listed.path.to_string_lossy();
    let what = format!("{} at {path}", listed.model.name);
    // hidapi tells its errors as text only, so the operating system is asked first.
    let file = std::fs::OpenOptions::new().read(true).write(true).open(&*path);
    file.map_err(|error| refused(what.clone(), &error))?;
    let device = api.open_path(&listed.path).map_err(|error| unusable(&what, &error.to_string()))?;
    Ok(Hidraw(device))
}

fn refused(what: String, error: &io::Error) -> DeviceError {
    match error.kind() {
        io::ErrorKind::PermissionDenied => DeviceError::Permission { what, remedy: RULES.to_owned() },
        io::ErrorKind::ResourceBusy => DeviceError::Busy { what },
        io::ErrorKind::NotFound => DeviceError::NotFound {
            device: BACKEND,
            looked: format!("{what} is listed, but its file is not there"),
            remedy: "in a container pass /dev/hidraw* on; otherwise connect the device again".to_owned(),
        },
        _ => unusable(&what, &error.to_string()),
    }
}

fn unusable(what: &str, error: &str) -> DeviceError {
    DeviceError::Library {
        what: format!("{what} cannot be opened ({error})"),
        remedy: "connect it again".to_owned(),
    }
}

/// Reports that were written down with their times, given out by the same clock that reads them.
///
/// One report a line: milliseconds since the beginning, then the bytes in hexadecimal; `#` begins a comment.
#[derive(Clone, Debug)]
pub(super) struct Recording {
    reports: Vec<(u64, Vec<u8>)>,
    next: usize,
    begin_ns: Option<u64>,
}

impl Recording {
    /// Reads the text of a recording.
    pub(super) fn parse(text: &str) -> Result<Recording, DeviceError> {
        let mut reports: Vec<(u64, Vec<u8>)> = Vec::new();
        for (number, line) in (1..).zip(text.lines()) {
            let words = line.split('#').next().unwrap_or_default().trim();
            if words.is_empty() {
                continue;
            }
            let report =
                parse_line(words).filter(|(at_ns, _)| reports.last().is_none_or(|last| last.0 <= *at_ns));
            reports.push(report.ok_or_else(|| DeviceError::Setting {
                name: "recording",
                value: format!("line {number}: {words:?}"),
                accepted: "milliseconds that never go back, then 1 to 64 bytes in hexadecimal".to_owned(),
            })?);
        }
        Ok(Recording { reports, next: 0, begin_ns: None })
    }
}

fn parse_line(words: &str) -> Option<(u64, Vec<u8>)> {
    let mut words = words.split_whitespace();
    let at_ms: u32 = words.next()?.parse().ok()?;
    let bytes: Option<Vec<u8>> =
        words.map(|word| (word.len() == 2).then(|| u8::from_str_radix(word, 16).ok())?).collect();
    let bytes = bytes.filter(|bytes| (1..=super::decode::LONGEST_REPORT).contains(&bytes.len()))?;
    Some((u64::from(at_ms) * 1_000_000, bytes))
}

impl ReportSource for Recording {
    fn next(&mut self, now_ns: u64, report: &mut [u8]) -> Result<usize, &'static str> {
        let begin_ns = *self.begin_ns.get_or_insert(now_ns);
        match self.reports.get(self.next) {
            Some((at_ns, bytes)) if begin_ns.saturating_add(*at_ns) <= now_ns => {
                self.next += 1;
                let length = bytes.len().min(report.len());
                report[..length].copy_from_slice(&bytes[..length]);
                Ok(length)
            }
            _ => Ok(0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn listed(serial: &str, path: &str) -> Listed {
        Listed { model: models::MODELS[0], serial: serial.to_owned(), path: CString::new(path).unwrap() }
    }

    #[test]
    fn the_only_one_needs_no_name_and_one_of_two_does() {
        let one = || vec![listed("", "/dev/hidraw3")];
        let two = || vec![listed("", "/dev/hidraw3"), listed("A7", "/dev/hidraw4")];
        assert_eq!(choose(one(), 1, "").unwrap(), one()[0]);
        assert_eq!(choose(two(), 2, "A7").unwrap(), two()[1]);
        assert_eq!(choose(two(), 2, "/dev/hidraw3").unwrap(), two()[0]);
        let text = choose(two(), 2, "").unwrap_err().to_string();
        assert!(
            text.contains("/dev/hidraw3") && text.contains("A7") && text.contains("device.serial"),
            "{text}"
        );
    }

    #[test]
    fn what_is_not_there_is_said_with_what_was_looked_for() {
        let text = choose(vec![], 5, "").unwrap_err().to_string();
        assert!(
            text.contains("046d:c626") && text.contains("256f:c635") && text.contains("5 HID devices"),
            "{text}"
        );
        let text = choose(vec![listed("A7", "/dev/hidraw4")], 5, "B8").unwrap_err().to_string();
        assert!(text.contains("B8") && text.contains("A7"), "{text}");
    }

    #[test]
    fn what_the_operating_system_refuses_has_its_own_remedy() {
        let said = |errno| {
            refused("SpaceNavigator at /dev/hidraw3".to_owned(), &io::Error::from_raw_os_error(errno))
        };
        assert!(matches!(said(libc::EACCES), DeviceError::Permission { .. }));
        let text = said(libc::EACCES).to_string();
        assert!(
            text.contains("/dev/hidraw3") && text.contains("config/udev/70-rhombus-haptics.rules"),
            "{text}"
        );
        assert!(matches!(said(libc::EBUSY), DeviceError::Busy { .. }));
        assert!(matches!(said(libc::ENOENT), DeviceError::NotFound { .. }));
        assert!(said(libc::EIO).to_string().contains("connect it again"));
    }

    #[test]
    fn a_file_that_is_no_hid_device_is_not_opened() {
        let hid = hid().unwrap();
        for path in ["/dev/null", "/dev/no such file"] {
            assert!(open(&hid, &listed("", path)).err().unwrap().to_string().contains(path));
        }
    }

    #[test]
    fn a_recording_with_a_fault_is_refused_by_its_line() {
        for text in ["0 01 zz", "5", "x 01", "0 01\n# fine\n1 012", "9 01\n8 01", "0 01 2"] {
            assert!(Recording::parse(text).unwrap_err().to_string().contains("line "), "{text}");
        }
        let text = Recording::parse("# only\n\n 3 01 02 # that\nx").unwrap_err().to_string();
        assert!(text.contains("line 4"), "{text}");
    }
}
