//! A device whose reading panics when a flag says so: what a fault in a backend would do.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use devices::{Description, Device, DeviceError, DeviceState, Wrench};

/// Passes everything on, until its time has come.
pub(crate) struct Panicking {
    pub(crate) device: Box<dyn Device>,
    pub(crate) now: Arc<AtomicBool>,
}

impl Device for Panicking {
    fn description(&self) -> &Description {
        self.device.description()
    }

    fn read(&mut self) -> Result<DeviceState, DeviceError> {
        if self.now.load(Relaxed) {
            panic!("on purpose, in the motor loop");
        }
        self.device.read()
    }

    fn command(&mut self, wrench: &Wrench) -> Result<(), DeviceError> {
        self.device.command(wrench)
    }

    fn enable(&mut self) -> Result<(), DeviceError> {
        self.device.enable()
    }

    fn disable(&mut self) -> Result<(), DeviceError> {
        self.device.disable()
    }

    fn home(&mut self) -> Result<(), DeviceError> {
        self.device.home()
    }

    fn set_gravity_compensation(&mut self, on: bool) -> Result<(), DeviceError> {
        self.device.set_gravity_compensation(on)
    }
}
