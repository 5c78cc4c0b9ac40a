//! The device files of haptic devices, who may open them, and whether the udev rules are installed.

use std::fs;
use std::os::unix::fs::{FileTypeExt, MetadataExt};
use std::path::{Path, PathBuf};

use rustix::fs::{Access, access};
use serde::Serialize;

/// Name of the rules file of this product.
const RULES: &str = "70-rhombus-haptics.rules";
/// Where udev reads rules from.
const RULE_FOLDERS: [&str; 4] =
    ["/etc/udev/rules.d", "/run/udev/rules.d", "/usr/local/lib/udev/rules.d", "/usr/lib/udev/rules.d"];
pub(super) const RULES_REMEDY: &str = "sudo cp config/udev/70-rhombus-haptics.rules /etc/udev/rules.d/ && sudo udevadm \
                                       control --reload && sudo udevadm trigger, then connect the device again";

/// A device file, and whether this user may read and write it.
#[derive(Debug, PartialEq, Eq, Serialize)]
pub(super) struct DeviceFile {
    pub(super) path: PathBuf,
    pub(super) what: String,
    /// As `ls -l` shows it.
    pub(super) mode: String,
    pub(super) owner: String,
    pub(super) group: String,
    pub(super) accessible: bool,
}

/// The device files that matter, those of the machine that this runs on.
pub(super) fn device_files() -> Vec<DeviceFile> {
    scan(Path::new("/sys"), Path::new("/dev"))
        .into_iter()
        .filter_map(|(path, what)| DeviceFile::look_at(path, what))
        .collect()
}

/// The installed rules; none: they are not.
pub(super) fn rules() -> Option<PathBuf> {
    RULE_FOLDERS.iter().map(|folder| Path::new(folder).join(RULES)).find(|path| path.is_file())
}

/// Where rules are looked for.
pub(super) fn rule_folders() -> String {
    RULE_FOLDERS.join(", ")
}

/// Paths of device files below `dev` by what `sys` says, with what they are.
fn scan(sys: &Path, dev: &Path) -> Vec<(PathBuf, String)> {
    let mut files = Vec::new();
    for folder in entries(&sys.join("bus/usb/devices")) {
        let attribute = |name: &str| read(&folder.join(name));
        let what = match (attribute("idVendor").as_deref(), attribute("idProduct").as_deref()) {
            (Some("1451"), _) => "Force Dimension device",
            (Some("0403"), Some("cb48")) => "Novint Falcon",
            _ => continue,
        };
        let number = |name: &str| attribute(name)?.parse::<u32>().ok();
        if let (Some(bus), Some(device)) = (number("busnum"), number("devnum")) {
            files.push((dev.join(format!("bus/usb/{bus:03}/{device:03}")), what.to_owned()));
        }
    }
    for folder in entries(&sys.join("class/hidraw")) {
        let event = read(&folder.join("device/uevent")).unwrap_or_default();
        let value = |key: &str| event.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix('='));
        let name = value("HID_NAME").unwrap_or_default();
        let is_ours = value("HID_ID").is_some_and(|id| id.to_ascii_uppercase().contains(":0000256F:"))
            || name.contains("3Dconnexion");
        if let (true, Some(file)) = (is_ours, folder.file_name()) {
            files.push((dev.join(file), format!("{name}, HID")));
        }
    }
    for folder in entries(&sys.join("class/tty")) {
        let name = folder.file_name().unwrap_or_default().to_string_lossy();
        if name.starts_with("ttyACM") || name.starts_with("ttyUSB") {
            files.push((dev.join(&*name), "USB serial port".to_owned()));
        }
    }
    files
}

impl DeviceFile {
    /// None: there is no such file.
    fn look_at(path: PathBuf, what: String) -> Option<DeviceFile> {
        let metadata = fs::metadata(&path).ok()?;
        let kind = if metadata.file_type().is_char_device() { 'c' } else { '-' };
        let bits = metadata.mode();
        let letter = |bit: u32, letter: char| if bits & (1 << bit) != 0 { letter } else { '-' };
        let mode = (0..9).rev().map(|bit| letter(bit, ['x', 'w', 'r'][bit as usize % 3]));
        Some(DeviceFile {
            what,
            mode: std::iter::once(kind).chain(mode).collect(),
            owner: name_in("/etc/passwd", metadata.uid()),
            group: name_in("/etc/group", metadata.gid()),
            // Not opened: that resets boards and wakes devices.
            accessible: access(&path, Access::READ_OK | Access::WRITE_OK).is_ok(),
            path,
        })
    }

    /// What to do about it; empty when nothing.
    pub(super) fn remedy(&self) -> String {
        match (self.accessible, self.group.as_str()) {
            (true, _) => String::new(),
            (false, "root") => RULES_REMEDY.to_owned(),
            (false, group) => format!("sudo usermod -aG {group} $USER, then log in again"),
        }
    }
}

/// The name of a user or a group; the number where it has none.
fn name_in(file: &str, number: u32) -> String {
    let text = fs::read_to_string(file).unwrap_or_default();
    let names = text.lines().find_map(|line| {
        let mut fields = line.split(':');
        let name = fields.next()?;
        (fields.nth(1)?.parse() == Ok(number)).then(|| name.to_owned())
    });
    names.unwrap_or_else(|| number.to_string())
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder)
        .map(|entries| entries.flatten().map(|entry| entry.path()).collect())
        .unwrap_or_default();
    paths.sort();
    paths
}

fn read(file: &Path) -> Option<String> {
    fs::read_to_string(file).ok().map(|text| text.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::fs::PermissionsExt;

    fn write(path: &Path, text: &str) {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    #[test]
    fn devices_are_found_by_what_the_system_says_of_them_and_others_are_left_out() {
        let folder = tempfile::tempdir().unwrap();
        let sys = folder.path();
        for (device, vendor, product) in
            [("1-1", "1451", "0402"), ("1-2", "0403", "cb48"), ("1-3", "0403", "6001")]
        {
            let usb = sys.join("bus/usb/devices").join(device);
            write(&usb.join("idVendor"), &format!("{vendor}\n"));
            write(&usb.join("idProduct"), &format!("{product}\n"));
            write(&usb.join("busnum"), "1\n");
            write(&usb.join("devnum"), &format!("{}\n", &device[2..]));
        }
        let hid = |number: u32, id: &str, name: &str| {
            let file = sys.join(format!("class/hidraw/hidraw{number}/device/uevent"));
            write(&file, &format!("DRIVER=hid-generic\nHID_ID={id}\nHID_NAME={name}\n"));
        };
        hid(0, "0003:0000256F:0000C635", "SpaceMouse Compact");
        hid(1, "0003:0000046D:0000C077", "Logitech Mouse");
        hid(2, "0003:0000046D:0000C626", "3Dconnexion SpaceNavigator");
        for tty in ["tty0", "ttyACM0", "ttyS0", "ttyUSB3"] {
            fs::create_dir_all(sys.join("class/tty").join(tty)).unwrap();
        }
        let found = scan(sys, Path::new("/dev"));
        let paths: Vec<&str> = found.iter().map(|(path, _)| path.to_str().unwrap()).collect();
        assert_eq!(
            paths,
            [
                "/dev/bus/usb/001/001",
                "/dev/bus/usb/001/002",
                "/dev/hidraw0",
                "/dev/hidraw2",
                "/dev/ttyACM0",
                "/dev/ttyUSB3"
            ]
        );
        assert!(scan(Path::new("/nowhere"), Path::new("/dev")).is_empty());
    }

    #[test]
    fn a_file_is_shown_as_ls_shows_it_and_its_group_is_the_remedy() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("port");
        write(&path, "");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        let file = DeviceFile::look_at(path, "port".to_owned()).unwrap();
        assert_eq!((file.mode.as_str(), file.remedy().as_str()), ("-rw-r-----", ""));
        let barred = |group: &str| DeviceFile {
            path: PathBuf::from("/dev/ttyACM0"),
            what: String::new(),
            mode: String::new(),
            owner: "root".to_owned(),
            group: group.to_owned(),
            accessible: false,
        };
        assert!(barred("dialout").remedy().contains("-aG dialout"));
        assert_eq!(barred("root").remedy(), RULES_REMEDY);
        assert_eq!(name_in("/etc/passwd", 0), "root");
    }
}
