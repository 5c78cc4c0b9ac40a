//! The device's end of a pseudo-terminal. Like a UART it has a rate, and bytes at another rate arrive as others.

use std::fs::File;
use std::io::{self, Read, Write};
use std::os::fd::OwnedFd;
use std::os::unix::fs::symlink;
use std::path::PathBuf;

use rustix::pty::{OpenptFlags, grantpt, ioctl_tiocgptpeer, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

use crate::arguments::Arguments;

/// An open pseudo-terminal. Dropping it hangs up on the other end, as pulling a cable does.
pub(crate) struct Line {
    device: File,
    /// The host's end, kept open so that a host may come and go.
    host: OwnedFd,
    path: String,
    link: Option<PathBuf>,
    baud: u32,
}

impl Line {
    pub(crate) fn open(arguments: &Arguments) -> io::Result<Line> {
        let device = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC)?;
        rustix::io::ioctl_fionbio(&device, true)?;
        grantpt(&device)?;
        unlockpt(&device)?;
        let path = ptsname(&device, Vec::new())?.to_string_lossy().into_owned();
        let host =
            ioctl_tiocgptpeer(&device, OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC)?;
        // Nothing is echoed before the host has set the line up.
        let mut settings = tcgetattr(&host)?;
        settings.make_raw();
        tcsetattr(&host, OptionalActions::Now, &settings)?;
        if let Some(link) = &arguments.link {
            let _ = std::fs::remove_file(link);
            symlink(&path, link)?;
        }
        let (link, baud) = (arguments.link.clone(), arguments.baud);
        Ok(Line { device: File::from(device), host, path, link, baud })
    }

    pub(crate) fn path(&self) -> &str {
        &self.path
    }

    /// Bytes from the host; 0 when there are none.
    pub(crate) fn receive(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = match self.device.read(into) {
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => 0,
            result => result?,
        };
        if self.is_mismatched()? {
            into[..count].iter_mut().for_each(mangle);
        }
        Ok(count)
    }

    /// Bytes to the host; what does not fit is lost, as nobody reads.
    pub(crate) fn send(&mut self, mut bytes: Vec<u8>) -> io::Result<()> {
        if self.is_mismatched()? {
            bytes.iter_mut().for_each(mangle);
        }
        match self.device.write(&bytes) {
            Err(error) if error.kind() != io::ErrorKind::WouldBlock => Err(error),
            _ => Ok(()),
        }
    }

    fn is_mismatched(&self) -> io::Result<bool> {
        Ok(tcgetattr(&self.host)?.input_speed() != self.baud)
    }
}

impl Drop for Line {
    fn drop(&mut self) {
        if let Some(link) = &self.link {
            let _ = std::fs::remove_file(link);
        }
    }
}

/// What a receiver at another rate makes of a byte.
fn mangle(byte: &mut u8) {
    *byte = (*byte << 3 | *byte >> 7) ^ 0xe0;
}
