//! Subscriptions taken from rcl directly, where r2r's do not do.
//!
//! r2r moves at most one message of a subscription per spin, builds a wait set for every spin, and drops what rcl knows
//! about a message. A recorder needs the moment at which a message arrived, whenever it is fetched, and it must be able to
//! fetch many at once; a replay in lockstep waits for one answer thousands of times a second. r2r does not show its
//! context, so these subscriptions have one of their own: a second node in the graph, hidden by the `_` in front of its
//! name. Topics are remapped by the command line as those of the node itself.
#![expect(unsafe_code, reason = "rcl is a C library; r2r wraps less of it than a recorder needs")]

mod graph;
mod subscription;
mod wait;

use std::ffi::{CStr, CString};
use std::rc::Rc;
use std::time::Duration;

use anyhow::{Context as _, bail};
use node_kit::NodeKit;
use r2r_rcl as c;

pub(crate) use subscription::Subscription;
pub(crate) use wait::WaitSet;

/// A node of its own context, for subscriptions alone.
#[derive(Clone)]
pub(crate) struct RawNode {
    handles: Rc<Handles>,
}

/// What rcl keeps pointers to, so that it must not move. Freed when the last subscription is gone.
struct Handles {
    context: *mut c::rcl_context_t,
    node: *mut c::rcl_node_t,
}

impl RawNode {
    /// Joins the graph beside the node of `kit`, in its namespace and as "_NAME_reader".
    pub(crate) fn new(kit: &NodeKit) -> anyhow::Result<Self> {
        let name = kit.full_name().rsplit('/').next().unwrap_or_default();
        let arguments: Vec<CString> =
            arguments_for_reader(std::env::args(), name).map(CString::new).collect::<Result<_, _>>()?;
        let reader = CString::new(format!("_{name}_reader"))?;
        let namespace = CString::new(kit.namespace())?;
        Handles::new(&arguments, &reader, &namespace).map(|handles| Self { handles: Rc::new(handles) })
    }

    /// Publishers of a topic that the graph knows, whatever they offer. `name` is the name in the graph.
    pub(crate) fn publishers_of(&self, name: &str) -> usize {
        let Ok(name) = CString::new(name) else { return 0 };
        let mut count = 0;
        // SAFETY: node and name live, and rcl only writes the number.
        let result = unsafe { c::rcl_count_publishers(self.handles.node, name.as_ptr(), &mut count) };
        if ok(result).is_ok() { count } else { 0 }
    }

    /// Name and types of each topic in the graph, by name.
    ///
    /// # Errors
    /// What rcl says.
    pub(crate) fn topics(&self) -> anyhow::Result<Vec<(String, Vec<String>)>> {
        graph::topics(&self.handles)
    }

    /// A wait set for up to `capacity` subscriptions of this node.
    pub(crate) fn wait_set(&self, capacity: usize) -> anyhow::Result<WaitSet> {
        WaitSet::new(Rc::clone(&self.handles), capacity)
    }

    /// Subscribes to a topic by its absolute name. The type is given as "package/msg/Name" and must be built in.
    pub(crate) fn subscribe(
        &self,
        name: &str,
        type_name: &str,
        qos: r2r::QosProfile,
    ) -> anyhow::Result<Subscription> {
        Subscription::new(Rc::clone(&self.handles), name, type_name, qos)
            .with_context(|| format!("subscription {name} of type {type_name} cannot be created"))
    }
}

impl Handles {
    fn new(arguments: &[CString], name: &CStr, namespace: &CStr) -> anyhow::Result<Self> {
        let pointers: Vec<_> = arguments.iter().map(|argument| argument.as_ptr()).collect();
        // SAFETY: rcl fills structures made by its own "zero initialized" functions; both are boxed, so that they stay
        // where rcl remembers them, and the arguments are copied by rcl before this function ends.
        unsafe {
            let context = Box::into_raw(Box::new(c::rcl_get_zero_initialized_context()));
            let mut options = c::rcl_get_zero_initialized_init_options();
            let made = ok(c::rcl_init_options_init(&mut options, c::rcutils_get_default_allocator()))
                .and_then(|()| {
                    let result = ok(c::rcl_init(pointers.len() as i32, pointers.as_ptr(), &options, context));
                    let _ = c::rcl_init_options_fini(&mut options);
                    result
                });
            if let Err(error) = made {
                drop(Box::from_raw(context));
                return Err(error.context("a second context of rcl"));
            }
            let node = Box::into_raw(Box::new(c::rcl_get_zero_initialized_node()));
            // From here on dropping `handles` ends what has begun; a node that was never made is none to rcl.
            let handles = Self { context, node };
            let mut options = c::rcl_node_get_default_options();
            options.enable_rosout = false;
            ok(c::rcl_node_init(node, name.as_ptr(), namespace.as_ptr(), context, &options))
                .with_context(|| format!("node {}", name.to_string_lossy()))?;
            Ok(handles)
        }
    }
}

impl Drop for Handles {
    fn drop(&mut self) {
        // SAFETY: both came from `Box::into_raw`, and nothing uses them any more: subscriptions and wait sets hold an
        // `Rc` of this.
        unsafe {
            let _ = c::rcl_node_fini(self.node);
            let _ = c::rcl_shutdown(self.context);
            let _ = c::rcl_context_fini(self.context);
            drop(Box::from_raw(self.node));
            drop(Box::from_raw(self.context));
            c::rcutils_reset_error();
        }
    }
}

/// The command line as the second node must read it: it is not renamed as the first one is, and what remaps topics of the
/// first one by its name remaps its own. Parameters are not its business.
fn arguments_for_reader(
    arguments: impl Iterator<Item = String>,
    node_name: &str,
) -> impl Iterator<Item = String> {
    let of_node = format!("{node_name}:");
    let mut arguments = arguments;
    let mut kept = Vec::new();
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "-r" | "--remap" => {
                let Some(rule) = arguments.next() else { break };
                let rule = rule.strip_prefix(&of_node).filter(|rest| !rest.starts_with('=')).unwrap_or(&rule);
                if !rule.contains("__node:=") && !rule.contains("__name:=") {
                    kept.extend([argument, rule.to_owned()]);
                }
            }
            "--params-file" | "-p" | "--param" => drop(arguments.next()),
            _ => kept.push(argument),
        }
    }
    kept.into_iter()
}

/// What rcl says of a failed call, cleared so that the next failure is not reported as an overwritten one.
fn ok(result: i32) -> anyhow::Result<()> {
    if result == c::RCL_RET_OK as i32 {
        return Ok(());
    }
    // SAFETY: the string is a copy with a zero at its end.
    let said = unsafe {
        let text = c::rcutils_get_error_string();
        let said = CStr::from_ptr(text.str_.as_ptr()).to_string_lossy().into_owned();
        c::rcutils_reset_error();
        said
    };
    bail!("rcl says {said} (code {result})")
}

/// rcl counts in signed nanoseconds; negative would be "for ever".
fn nanoseconds(duration: Duration) -> i64 {
    i64::try_from(duration.as_nanos()).unwrap_or(i64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reader_keeps_the_remappings_of_topics_and_is_not_renamed() {
        let line = "bag_replay --ros-args -r __node:=recorder -r __ns:=/or --params-file a.yaml -r a:=b \
                    -r recorder:c:=d -r recorder:=e -r other:f:=g --log-level warn -p x:=1";
        let kept: Vec<_> = arguments_for_reader(line.split(' ').map(str::to_owned), "recorder").collect();
        let expected = "bag_replay --ros-args -r __ns:=/or -r a:=b -r c:=d -r recorder:=e -r other:f:=g \
                        --log-level warn";
        assert_eq!(kept.join(" "), expected);
    }
}
