//! The time that log lines, diagnostics and parameter events are stamped with: system time, or `/clock` with
//! `use_sim_time`. Nothing else reads it; the model's time is that of the messages.
//!
//! r2r has a time source of its own, but only compiles it in when its build script has just generated the messages;
//! when the script finds them generated before, the time source is missing.

use std::sync::Arc;
use std::sync::atomic::{AtomicI64, Ordering};
use std::time::{SystemTime, UNIX_EPOCH};

use r2r::builtin_interfaces::msg::Time;

use crate::convert;

/// A clock; clones show the same time and may be read from any thread.
#[derive(Clone, Debug, Default)]
pub(crate) struct NodeClock {
    /// What `/clock` said last, ns; 0 before it spoke. None: system time.
    simulated_ns: Option<Arc<AtomicI64>>,
}

impl NodeClock {
    pub(crate) fn system() -> NodeClock {
        NodeClock::default()
    }

    pub(crate) fn simulated() -> NodeClock {
        NodeClock { simulated_ns: Some(Arc::default()) }
    }

    /// Take over what `/clock` says; without effect on system time.
    pub(crate) fn set(&self, time: &Time) {
        if let Some(simulated_ns) = &self.simulated_ns {
            simulated_ns.store(convert::stamp_ns(time), Ordering::Relaxed);
        }
    }

    pub(crate) fn now(&self) -> Time {
        let ns = match &self.simulated_ns {
            Some(simulated_ns) => simulated_ns.load(Ordering::Relaxed),
            None => SystemTime::now()
                .duration_since(UNIX_EPOCH)
                .map_or(0, |since| i64::try_from(since.as_nanos()).unwrap_or(i64::MAX)),
        };
        convert::stamp(ns)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn simulated_time_is_what_the_clock_topic_says_and_system_time_goes_on_by_itself() {
        let simulated = NodeClock::simulated();
        let reader = simulated.clone();
        assert_eq!(reader.now(), Time { sec: 0, nanosec: 0 });
        simulated.set(&Time { sec: 12, nanosec: 34 });
        assert_eq!(reader.now(), Time { sec: 12, nanosec: 34 });
        let system = NodeClock::system();
        system.set(&Time { sec: 12, nanosec: 34 });
        assert!(system.now().sec > 1_700_000_000);
    }
}
