//! Which devices are on the USB bus, and whether this user may open them: the SDK does not tell the two apart.

use std::fs::OpenOptions;
use std::io;
use std::path::{Path, PathBuf};

/// Force Dimension's vendor number, and vendor and product of Novint's Falcon.
fn is_ours(vendor: &str, product: &str) -> bool {
    vendor == "1451" || (vendor == "0403" && product == "cb48")
}

/// What is known of one device on the bus.
#[derive(Debug)]
pub(super) struct UsbDevice {
    /// The file to open.
    pub(super) node: PathBuf,
    /// Whether this user may read and write it.
    pub(super) permitted: bool,
}

/// The devices of Force Dimension and Novint on the bus; empty where there is no such thing as `/sys`.
pub(super) fn devices() -> Vec<UsbDevice> {
    scan(Path::new("/sys/bus/usb/devices"), Path::new("/dev/bus/usb"), |node| {
        OpenOptions::new().read(true).write(true).open(node).map(drop)
    })
}

fn scan(sys: &Path, dev: &Path, open: impl Fn(&Path) -> io::Result<()>) -> Vec<UsbDevice> {
    let Ok(entries) = std::fs::read_dir(sys) else { return Vec::new() };
    let mut devices: Vec<UsbDevice> = entries
        .flatten()
        .filter_map(|entry| {
            let attribute = |name: &str| {
                std::fs::read_to_string(entry.path().join(name)).map(|text| text.trim().to_owned()).ok()
            };
            if !is_ours(&attribute("idVendor")?, &attribute("idProduct")?) {
                return None;
            }
            let number = |name: &str| attribute(name)?.parse::<u32>().ok();
            let node = dev.join(format!("{:03}/{:03}", number("busnum")?, number("devnum")?));
            let permitted = !open(&node).is_err_and(|error| error.kind() == io::ErrorKind::PermissionDenied);
            Some(UsbDevice { node, permitted })
        })
        .collect();
    devices.sort_by(|a, b| a.node.cmp(&b.node));
    devices
}

#[cfg(test)]
mod tests {
    use super::*;

    fn add(sys: &Path, name: &str, attributes: [(&str, &str); 4]) {
        let folder = sys.join(name);
        std::fs::create_dir(&folder).unwrap();
        for (name, value) in attributes {
            std::fs::write(folder.join(name), format!("{value}\n")).unwrap();
        }
    }

    #[test]
    fn only_these_makers_are_found_and_a_refusal_is_told_from_other_errors() {
        let sys = tempfile::tempdir().unwrap();
        let device = |vendor, product, number| {
            [("idVendor", vendor), ("idProduct", product), ("busnum", "3"), ("devnum", number)]
        };
        add(sys.path(), "3-1", device("1451", "0402", "7"));
        add(sys.path(), "3-2", device("0403", "cb48", "12"));
        add(sys.path(), "3-3", device("0403", "6001", "13"));
        std::fs::create_dir(sys.path().join("3-0:1.0")).unwrap();

        let found = scan(sys.path(), Path::new("/dev/bus/usb"), |node| {
            let kind = if node.ends_with("007") {
                io::ErrorKind::PermissionDenied
            } else {
                io::ErrorKind::ResourceBusy
            };
            Err(kind.into())
        });
        let found: Vec<_> =
            found.iter().map(|device| (device.node.to_str().unwrap(), device.permitted)).collect();
        assert_eq!(found, [("/dev/bus/usb/003/007", false), ("/dev/bus/usb/003/012", true)]);
    }

    #[test]
    fn a_machine_without_usb_has_none() {
        assert!(scan(Path::new("/nowhere"), Path::new("/dev"), |_| Ok(())).is_empty());
    }
}
