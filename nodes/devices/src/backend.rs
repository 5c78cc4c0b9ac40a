//! Which device is opened. One variant for each backend, each behind the Cargo feature of its name.

use crate::{Device, DeviceError};

/// A backend with what it needs to open its device.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Backend {
    /// A scripted hand on a simulated delta device.
    #[cfg(feature = "simulated")]
    Simulated(crate::simulated::Settings),
}

impl Backend {
    /// Opens the device. Not RT safe.
    ///
    /// # Errors
    /// What the backend cannot work with.
    pub fn open(self) -> Result<Box<dyn Device>, DeviceError> {
        match self {
            #[cfg(feature = "simulated")]
            Backend::Simulated(settings) => Ok(Box::new(crate::simulated::SimulatedDevice::open(settings)?)),
        }
    }
}
