//! The devices, as the SDK counts them.

use std::io;

use crate::arguments::Arguments;
use crate::hardware::Hardware;

/// All of them, unplugged ones too. A device's number in the SDK is its place here.
pub(crate) struct Bus {
    pub(crate) version: [i32; 4],
    pub(crate) devices: Vec<Hardware>,
}

impl Bus {
    pub(crate) fn new(arguments: &Arguments) -> Result<Bus, Box<dyn std::error::Error>> {
        let devices: Result<_, _> = arguments.devices.iter().cloned().map(Hardware::new).collect();
        Ok(Bus { version: arguments.version, devices: devices? })
    }

    pub(crate) fn advance(&mut self, now_ns: u64) -> io::Result<()> {
        self.devices.iter_mut().try_for_each(|device| device.advance(now_ns))
    }

    pub(crate) fn plug_all(&mut self, now_ns: u64, plugged: bool) -> io::Result<()> {
        self.devices.iter_mut().try_for_each(|device| device.plug(now_ns, plugged))
    }

    /// How many a program can count, and how many of these it can open.
    pub(crate) fn counts(&self, program: u64) -> (usize, usize) {
        let plugged = || self.devices.iter().filter(|device| device.plugged);
        let free = |device: &&Hardware| {
            device.device.refuse.is_none() && device.opened_by.is_none_or(|by| by == program)
        };
        (plugged().count(), plugged().filter(free).count())
    }

    /// The number of the device at this place among those plugged in.
    pub(crate) fn at(&self, place: i32) -> Option<usize> {
        let plugged = self.devices.iter().enumerate().filter(|(_, device)| device.plugged);
        plugged.map(|(number, _)| number).nth(usize::try_from(place).ok()?)
    }

    /// A program is gone: what it had open may be opened again.
    pub(crate) fn forget(&mut self, program: u64) {
        for device in &mut self.devices {
            device.opened_by = device.opened_by.filter(|&by| by != program);
        }
    }
}
