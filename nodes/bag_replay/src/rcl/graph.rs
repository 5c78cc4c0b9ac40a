//! Topics of the graph with all their types. r2r's list reads beyond its end where a topic has two of them.

use std::ffi::{CStr, c_char};

use r2r_rcl as c;

use super::{Handles, ok};

/// Name and types of each topic, by name.
pub(super) fn topics(handles: &Handles) -> anyhow::Result<Vec<(String, Vec<String>)>> {
    // SAFETY: the node lives; rcl fills the list, which is read within its sizes and then freed by the same allocator.
    unsafe {
        let mut allocator = c::rcutils_get_default_allocator();
        let mut list = c::rmw_get_zero_initialized_names_and_types();
        let asked = c::rcl_get_topic_names_and_types(handles.node, &mut allocator, false, &mut list);
        ok(asked)?;
        let names = texts(&list.names);
        let types = match list.types.is_null() {
            true => &[],
            false => std::slice::from_raw_parts(list.types, list.names.size),
        };
        let mut topics: Vec<_> = names.into_iter().zip(types.iter().map(|types| texts(types))).collect();
        ok(c::rmw_names_and_types_fini(&mut list))?;
        topics.sort();
        Ok(topics)
    }
}

/// The texts of an array of rcutils.
///
/// # Safety
/// The array is initialized and its texts end with a zero.
unsafe fn texts(array: &c::rcutils_string_array_t) -> Vec<String> {
    if array.data.is_null() {
        return Vec::new();
    }
    // SAFETY: the array has as many pointers as it says.
    let pointers: &[*mut c_char] = unsafe { std::slice::from_raw_parts(array.data, array.size) };
    let present = pointers.iter().filter(|pointer| !pointer.is_null());
    // SAFETY: promised by the caller.
    present.map(|pointer| unsafe { CStr::from_ptr(*pointer) }.to_string_lossy().into_owned()).collect()
}
