//! What the parts of the driver share about the open device.

use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex};

use devices::Description;

use crate::publisher::Exchange;
use crate::wrench_frame::DeviceFrames;

/// The open device, as the topics around it see it. Clones share what changes.
#[derive(Clone)]
pub(crate) struct Shared {
    /// What was opened.
    pub(crate) description: Description,
    /// Its frames.
    pub(crate) frames: DeviceFrames,
    /// Whether `body/` wrenches have the axes of the base.
    pub(crate) body_is_absolute: Arc<AtomicBool>,
    /// What was measured, published and answered.
    pub(crate) exchange: Arc<Mutex<Exchange>>,
}

impl Shared {
    /// Whether there is anything to command a force to.
    pub(crate) fn has_motors(&self) -> bool {
        self.description.limits.max_force_n.is_some()
    }
}
