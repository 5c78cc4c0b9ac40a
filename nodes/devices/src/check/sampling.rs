//! Reads and commands a device in turn, at a fixed rate, and writes down what came and how long it took.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use glam::DVec3;

use crate::{Device, DeviceError, DeviceState, MAX_STATUS, Wrench, monotonic_ns, sleep_until};

/// One period.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tick {
    /// When it was due, since the first one.
    pub(super) due_ns: u64,
    /// How long after that it began.
    pub(super) late_ns: u64,
    pub(super) read_ns: u64,
    pub(super) command_ns: u64,
    pub(super) state: Reading,
}

/// What is kept of a reading.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reading {
    pub(super) position: DVec3,
    pub(super) velocity: DVec3,
    /// How far the orientation's quaternion is from length 1.
    pub(super) norm_error: f64,
    pub(super) is_identity: bool,
    pub(super) is_finite: bool,
    pub(super) device_time_ns: u64,
    pub(super) buttons: u32,
    pub(super) gripper_rad: Option<f64>,
}

/// How sampling ended.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum End {
    /// After its time.
    Whole,
    /// The device was lost.
    Lost(DeviceError),
    /// From outside.
    Stopped,
    /// By the force test.
    Broken(Broken),
}

/// Why sampling was broken off, and what to do.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Broken {
    pub(super) why: String,
    pub(super) remedy: &'static str,
}

/// What to do next, after a reading.
pub(super) enum Next {
    Command(Wrench),
    Break(Broken),
}

/// What came, period for period.
#[derive(Clone, Debug)]
pub(super) struct Series {
    pub(super) period_ns: u64,
    /// Periods that began too late to be used.
    pub(super) missed: u64,
    pub(super) ticks: Vec<Tick>,
    pub(super) homed: bool,
    pub(super) status: [[i32; MAX_STATUS]; 2],
    pub(super) end: End,
}

impl Series {
    /// How long it took.
    pub(super) fn seconds(&self) -> f64 {
        self.ticks.last().map_or(0, |tick| tick.due_ns + self.period_ns) as f64 * 1e-9
    }

    /// The readings that are finite and new by the device's own clock.
    pub(super) fn distinct(&self) -> impl Iterator<Item = &Tick> {
        let mut last = None;
        self.ticks
            .iter()
            .filter(move |tick| last.replace(tick.state.device_time_ns) != Some(tick.state.device_time_ns))
            .filter(|tick| tick.state.is_finite)
    }
}

/// Samples until the time is over, the device is lost, `stop` is true, or `next` breaks it off. `next` gets the time
/// since the beginning, s, the reading and the monotonic time, and says what is commanded. RT safe once it has begun.
pub(super) fn sample(
    device: &mut dyn Device,
    rate_hz: f64,
    duration: Duration,
    stop: &AtomicBool,
    mut next: impl FnMut(f64, &DeviceState, u64) -> Next,
) -> Series {
    let period_ns = (1e9 / rate_hz).round() as u64;
    let periods = (duration.as_secs_f64() * rate_hz).round().max(1.0) as u64;
    let mut series = Series {
        period_ns,
        missed: 0,
        ticks: Vec::with_capacity(periods as usize),
        homed: false,
        status: [[0; MAX_STATUS]; 2],
        end: End::Whole,
    };
    let begin_ns = monotonic_ns() + period_ns;
    let mut period = 0;
    while period < periods {
        let due_ns = period * period_ns;
        sleep_until(begin_ns + due_ns);
        let woke_ns = monotonic_ns();
        let late_ns = woke_ns.saturating_sub(begin_ns + due_ns);
        if stop.load(Ordering::Relaxed) {
            series.end = End::Stopped;
            break;
        }
        let state = match device.read() {
            Ok(state) => state,
            Err(error) => {
                series.end = End::Lost(error);
                break;
            }
        };
        let read_ns = monotonic_ns();
        if series.ticks.is_empty() {
            series.status[0] = state.status;
        }
        (series.status[1], series.homed) = (state.status, state.homed);
        let wrench = match next(due_ns as f64 * 1e-9, &state, read_ns) {
            Next::Command(wrench) => wrench,
            Next::Break(broken) => {
                series.end = End::Broken(broken);
                break;
            }
        };
        let decided_ns = monotonic_ns();
        if let Err(error) = device.command(&wrench) {
            series.end = End::Lost(error);
            break;
        }
        let command_ns = monotonic_ns() - decided_ns;
        series.ticks.push(Tick {
            due_ns,
            late_ns,
            read_ns: read_ns - woke_ns,
            command_ns,
            state: Reading::of(&state),
        });
        // The next deadline that is still to come; the grid stays where it is.
        let passed = monotonic_ns().saturating_sub(begin_ns) / period_ns;
        let following = (period + 1).max(passed.min(periods));
        series.missed += following - period - 1;
        period = following;
    }
    series
}

impl Reading {
    pub(super) fn of(state: &DeviceState) -> Reading {
        let rotation = state.pose.rotation;
        Reading {
            position: state.pose.translation,
            velocity: state.linear_velocity_m_per_s,
            norm_error: (rotation.length() - 1.0).abs(),
            is_identity: rotation == glam::DQuat::IDENTITY,
            is_finite: state.is_finite(),
            device_time_ns: state.device_time_ns,
            buttons: state.buttons,
            gripper_rad: state.gripper_rad,
        }
    }
}
