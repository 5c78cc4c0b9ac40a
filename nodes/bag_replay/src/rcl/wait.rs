//! Waiting for messages without building anything anew.

use std::rc::Rc;
use std::time::Duration;

use r2r_rcl as c;

use super::{Handles, Subscription, nanoseconds, ok};

/// Waits for any of a few subscriptions.
pub(crate) struct WaitSet {
    /// The context that the wait set belongs to lives as long as this.
    _handles: Rc<Handles>,
    handle: c::rcl_wait_set_t,
}

impl WaitSet {
    pub(super) fn new(handles: Rc<Handles>, capacity: usize) -> anyhow::Result<Self> {
        // SAFETY: a zero initialized wait set and a context that lives.
        let handle = unsafe {
            let mut handle = c::rcl_get_zero_initialized_wait_set();
            let allocator = c::rcutils_get_default_allocator();
            ok(c::rcl_wait_set_init(&mut handle, capacity, 0, 0, 0, 0, 0, handles.context, allocator))?;
            handle
        };
        Ok(Self { _handles: handles, handle })
    }

    /// Returns when one of them has a message, or after `timeout`.
    ///
    /// # Errors
    /// The middleware cannot wait, for instance because there are more subscriptions than the wait set has room for.
    pub(crate) fn wait<'a>(
        &mut self,
        subscriptions: impl IntoIterator<Item = &'a Subscription>,
        timeout: Duration,
    ) -> anyhow::Result<()> {
        // SAFETY: the wait set is initialized and the subscriptions are borrowed until the wait is over; their pointers
        // are cleared before they are used again.
        unsafe {
            ok(c::rcl_wait_set_clear(&mut self.handle))?;
            for subscription in subscriptions {
                let place = std::ptr::null_mut();
                ok(c::rcl_wait_set_add_subscription(&mut self.handle, subscription.handle(), place))?;
            }
            match c::rcl_wait(&mut self.handle, nanoseconds(timeout)) {
                result if result == c::RCL_RET_TIMEOUT as i32 => Ok(()),
                result => ok(result),
            }
        }
    }
}

impl Drop for WaitSet {
    fn drop(&mut self) {
        // SAFETY: initialized in `new`, its context still lives.
        unsafe {
            let _ = c::rcl_wait_set_fini(&mut self.handle);
            c::rcutils_reset_error();
        }
    }
}
