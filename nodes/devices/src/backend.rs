//! Which device is opened. One variant for each backend, each behind the Cargo feature of its name.

use crate::{Device, DeviceError};

/// A backend with what it needs to open its device.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Backend {
    /// A scripted hand on a simulated delta device.
    #[cfg(feature = "simulated")]
    Simulated(crate::simulated::Settings),
    /// delta, omega, sigma, lambda and Falcon, through the maker's SDK.
    #[cfg(feature = "force_dimension")]
    ForceDimension(crate::force_dimension::Settings),
    /// Inverse3 and its relatives, through the maker's service.
    #[cfg(feature = "haply")]
    Haply(crate::haply::Settings),
    /// Self-built devices at a serial port.
    #[cfg(feature = "serial")]
    Serial(crate::serial::Settings),
    /// SpaceMouse and its relatives: a virtual handle without motors.
    #[cfg(feature = "spacemouse")]
    SpaceMouse(crate::spacemouse::Settings),
    /// A hand that follows a pointer, such as the mouse on the viewer's page.
    #[cfg(feature = "pointer")]
    Pointer(crate::pointer::Settings),
}

impl Backend {
    /// Opens the device, motors off. Not RT safe.
    ///
    /// # Errors
    /// What was looked for, what was found, and what to do.
    pub fn open(&self) -> Result<Box<dyn Device>, DeviceError> {
        match self.clone() {
            #[cfg(feature = "simulated")]
            Backend::Simulated(settings) => Ok(Box::new(crate::simulated::SimulatedDevice::open(settings)?)),
            #[cfg(feature = "force_dimension")]
            Backend::ForceDimension(settings) => Ok(Box::new(crate::force_dimension::open(settings)?)),
            #[cfg(feature = "haply")]
            Backend::Haply(settings) => Ok(Box::new(crate::haply::open(settings)?)),
            #[cfg(feature = "serial")]
            Backend::Serial(settings) => Ok(Box::new(crate::serial::open(settings)?)),
            #[cfg(feature = "spacemouse")]
            Backend::SpaceMouse(settings) => Ok(Box::new(crate::spacemouse::open(settings)?)),
            #[cfg(feature = "pointer")]
            Backend::Pointer(settings) => Ok(Box::new(crate::pointer::PointerDevice::open(settings)?)),
        }
    }

    /// The same, for the device with this serial number. Without one, or where a backend has but one device, as it is.
    #[must_use]
    pub fn for_serial(self, serial: &str) -> Backend {
        match self {
            _ if serial.is_empty() => self,
            #[cfg(feature = "force_dimension")]
            Backend::ForceDimension(settings) => Backend::ForceDimension(crate::force_dimension::Settings {
                serial: serial.to_owned(),
                ..settings
            }),
            #[cfg(feature = "haply")]
            Backend::Haply(settings) => {
                Backend::Haply(crate::haply::Settings { serial: serial.to_owned(), ..settings })
            }
            #[cfg(feature = "serial")]
            Backend::Serial(settings) => {
                Backend::Serial(crate::serial::Settings { serial: serial.to_owned(), ..settings })
            }
            #[cfg(feature = "spacemouse")]
            Backend::SpaceMouse(settings) => {
                Backend::SpaceMouse(crate::spacemouse::Settings { serial: serial.to_owned(), ..settings })
            }
            #[cfg(any(feature = "simulated", feature = "pointer"))]
            other => other,
        }
    }

    /// What a motor loop calls to open the device, at its start and after a loss.
    pub fn opener(self) -> impl FnMut() -> Result<Box<dyn Device>, DeviceError> + Send + 'static {
        move || self.open()
    }
}
