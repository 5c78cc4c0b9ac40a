//! What the motor loop's thread and the thread that owns it both look at: atomics, and one short queue of requests.

use std::sync::atomic::Ordering::{AcqRel, Acquire, Relaxed, Release};
use std::sync::atomic::{AtomicBool, AtomicU64};

use crossbeam::atomic::AtomicCell;
use crossbeam::queue::ArrayQueue;

use crate::OperatingState;
use crate::safety::FaultCause;

/// The operating state and what goes with it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(C, align(8))]
pub struct MotorStatus {
    /// Whether motors are on, and whether they may push.
    pub operating: OperatingState,
    /// Why it is [`OperatingState::Fault`].
    pub fault: Option<FaultCause>,
    /// What is wrong now and keeps the motors from being enabled, whether a fault tells of it or not.
    pub barred_by: Option<FaultCause>,
    /// Whether the device's position is referenced.
    pub is_homed: bool,
    /// Whether the device is being homed, or waits for it. Not while a lost device is looked for: that is the fault
    /// [`FaultCause::DeviceLost`].
    pub is_busy: bool,
}

/// What both threads look at. Every access is RT safe.
pub(crate) struct Shared {
    pub(crate) stop: AtomicBool,
    /// Pressed now: a flag of its own, because a queue of requests may be full or not looked at.
    is_pressed: AtomicBool,
    /// Pressed since the loop last looked, even if released again.
    was_pressed: AtomicBool,
    pub(crate) counters: Counters,
    /// Why a lost device could not be opened again; the newest attempt.
    pub(crate) not_reopened: ArrayQueue<String>,
    status: AtomicCell<MotorStatus>,
    max_force_n: AtomicU64,
    beat_ns: AtomicU64,
}

impl Shared {
    pub(crate) fn new(max_force_n: f64, now_ns: u64) -> Shared {
        const { assert!(AtomicCell::<MotorStatus>::is_lock_free(), "one word is one atomic store") };
        Shared {
            stop: AtomicBool::new(false),
            is_pressed: AtomicBool::new(false),
            was_pressed: AtomicBool::new(false),
            counters: Counters::default(),
            not_reopened: ArrayQueue::new(1),
            status: AtomicCell::default(),
            max_force_n: AtomicU64::new(max_force_n.to_bits()),
            beat_ns: AtomicU64::new(now_ns),
        }
    }

    pub(crate) fn status(&self) -> MotorStatus {
        self.status.load()
    }

    pub(crate) fn set_status(&self, status: MotorStatus) {
        self.status.store(status);
    }

    /// The emergency stop is pressed, or released.
    pub(crate) fn set_emergency_stop(&self, pressed: bool) {
        // Latched first: whoever sees the release sees that there was something to release.
        self.was_pressed.fetch_or(pressed, AcqRel);
        self.is_pressed.store(pressed, Release);
    }

    /// Whether the emergency stop is pressed now, and whether it was at any time since the last look.
    pub(crate) fn take_emergency_stop(&self) -> (bool, bool) {
        let is_pressed = self.is_pressed.load(Acquire);
        (is_pressed, self.was_pressed.swap(false, AcqRel))
    }

    pub(crate) fn max_force_n(&self) -> f64 {
        f64::from_bits(self.max_force_n.load(Relaxed))
    }

    pub(crate) fn set_max_force_n(&self, max_force_n: f64) {
        self.max_force_n.store(max_force_n.to_bits(), Relaxed);
    }

    /// The owner lives.
    pub(crate) fn beat(&self, now_ns: u64) {
        self.beat_ns.store(now_ns, Relaxed);
    }

    /// How long ago the owner was last heard of, ns.
    pub(crate) fn silence_ns(&self, now_ns: u64) -> u64 {
        now_ns.saturating_sub(self.beat_ns.load(Relaxed))
    }
}

macro_rules! counters {
    ($($(#[$doc:meta])* $name:ident),+ $(,)?) => {
        /// What the motor loop counts, shared with whoever reports it.
        #[derive(Debug, Default)]
        pub(crate) struct Counters { $($(#[$doc])* pub(crate) $name: AtomicU64,)+ }

        /// The counters at one moment.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct Counts { $($(#[$doc])* pub $name: u64,)+ }

        impl Counters {
            /// The counters now.
            pub(crate) fn counts(&self) -> Counts {
                Counts { $($name: self.$name.load(Relaxed),)+ }
            }
        }
    };
}

counters! {
    /// Periods run.
    ticks,
    /// Periods that began more than half a period late.
    late_ticks,
    /// Periods left out because the loop was a whole period behind.
    skipped_ticks,
    /// The latest start of a period after its deadline, ns.
    latest_ns,
    /// Samples lost because the ring to the publisher was full.
    lost_samples,
    /// Device readings that were not finite; the force fell, and no sample came of them.
    unusable_readings,
    /// Forces that were not finite; the motors got none instead.
    unusable_forces,
    /// Forces above a limit; the motors got the limit in the same direction.
    clamped_forces,
    /// Periods in which the force changed as fast as it may.
    slewed_forces,
    /// Periods in which the passivity controller took energy out.
    damped_ticks,
    /// Times the device was lost.
    losses,
    /// Times the device was found again.
    reopenings,
}

impl Counters {
    pub(crate) fn add(counter: &AtomicU64, count: u64) {
        counter.fetch_add(count, Relaxed);
    }
}
