//! One subscription and the messages that wait in it.

use std::ffi::{CStr, CString};
use std::rc::Rc;
use std::time::{SystemTime, UNIX_EPOCH};

use r2r::WrappedNativeMsgUntyped;
use r2r_rcl as c;

use super::{Handles, ok};

/// A subscription to serialized messages.
pub(crate) struct Subscription {
    handles: Rc<Handles>,
    handle: Box<c::rcl_subscription_t>,
    /// rcl grows it when a message is larger.
    buffer: c::rcl_serialized_message_t,
    name: String,
}

/// A message, until the next one is taken.
pub(crate) struct Taken<'a> {
    /// As it was on the wire: CDR with its header.
    pub(crate) data: &'a [u8],
    /// When the middleware received it, ns since 1970; where it does not say so, when it was taken.
    pub(crate) received_ns: u64,
}

impl Subscription {
    pub(super) fn new(
        handles: Rc<Handles>,
        name: &str,
        type_name: &str,
        qos: r2r::QosProfile,
    ) -> anyhow::Result<Self> {
        let name = CString::new(name)?;
        let type_support = WrappedNativeMsgUntyped::new_from(type_name)?.ts;
        // SAFETY: the node lives as long as `handles`; type support is static; the handle is boxed before rcl sees it,
        // so that it stays where it is.
        unsafe {
            let mut handle = Box::new(c::rcl_get_zero_initialized_subscription());
            let mut options = c::rcl_subscription_get_default_options();
            options.qos = qos.into();
            let result =
                c::rcl_subscription_init(&mut *handle, handles.node, type_support, name.as_ptr(), &options);
            let _ = c::rcl_subscription_options_fini(&mut options);
            ok(result)?;
            let mut buffer = c::rcutils_get_zero_initialized_uint8_array();
            let allocator = c::rcutils_get_default_allocator();
            if let Err(error) = ok(c::rcutils_uint8_array_init(&mut buffer, 0, &allocator)) {
                let _ = c::rcl_subscription_fini(&mut *handle, handles.node);
                return Err(error);
            }
            // After remapping.
            let name =
                CStr::from_ptr(c::rcl_subscription_get_topic_name(&*handle)).to_string_lossy().into_owned();
            Ok(Self { handles, handle, buffer, name })
        }
    }

    /// Name in the graph, after remappings.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Publishers that this subscription hears.
    pub(crate) fn publishers(&self) -> usize {
        let mut count = 0;
        // SAFETY: the handle is initialized and rcl only writes the number.
        let result = unsafe { c::rcl_subscription_get_publisher_count(&*self.handle, &mut count) };
        if result == 0 { count } else { 0 }
    }

    /// The oldest message that waits.
    ///
    /// # Errors
    /// The middleware cannot hand out the message.
    pub(crate) fn take(&mut self) -> anyhow::Result<Option<Taken<'_>>> {
        // SAFETY: handle and buffer are initialized; no allocation is passed, as rcl allows.
        let (result, info) = unsafe {
            let mut info = c::rmw_get_zero_initialized_message_info();
            let result = c::rcl_take_serialized_message(
                &*self.handle,
                &mut self.buffer,
                &mut info,
                std::ptr::null_mut(),
            );
            (result, info)
        };
        if result == c::RCL_RET_SUBSCRIPTION_TAKE_FAILED as i32 {
            return Ok(None);
        }
        ok(result)?;
        let data = if self.buffer.buffer.is_null() {
            &[]
        } else {
            // SAFETY: rcl wrote that many bytes, and the borrow of `self` keeps the buffer as it is.
            unsafe { std::slice::from_raw_parts(self.buffer.buffer, self.buffer.buffer_length) }
        };
        let received_ns = match u64::try_from(info.received_timestamp) {
            Ok(received_ns) if received_ns > 0 => received_ns,
            _ => SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |now| now.as_nanos() as u64),
        };
        Ok(Some(Taken { data, received_ns }))
    }

    pub(super) fn handle(&self) -> *const c::rcl_subscription_t {
        &*self.handle
    }
}

impl Drop for Subscription {
    fn drop(&mut self) {
        // SAFETY: both were initialized in `new`, and the node still lives.
        unsafe {
            let _ = c::rcl_subscription_fini(&mut *self.handle, self.handles.node);
            let _ = c::rcutils_uint8_array_fini(&mut self.buffer);
            c::rcutils_reset_error();
        }
    }
}
