//! The motor loop as a thread: what it does to a device, seen from the device.

#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests, outside the test functions")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::atomic::{AtomicU64, Ordering::SeqCst};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use devices::{
    Device, DeviceError, DeviceLimits, DeviceState, ForceOrigin, ForceSource, LawCommand, MotorError,
    MotorLoop, MotorSettings, Workspace, samples,
};
use glam::{DQuat, DVec3};
use rhombus_chain::{ChainParameters, ContactLaw, Formulation, LocalLaw, Mode, Pose};

thread_local! {
    /// Whether the current thread's use of the allocator is counted.
    static WATCHED: Cell<bool> = const { Cell::new(false) };
}
static ALLOCATOR_CALLS: AtomicU64 = AtomicU64::new(0);

struct Counting;

#[expect(unsafe_code, reason = "an allocator that counts what the watched thread asks of it")]
// SAFETY: every call goes unchanged to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATOR_CALLS.fetch_add(u64::from(WATCHED.get()), SeqCst);
        // SAFETY: the caller's promise is passed on.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        ALLOCATOR_CALLS.fetch_add(u64::from(WATCHED.get()), SeqCst);
        // SAFETY: the caller's promise is passed on.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// What has happened to a device, as it saw it.
#[derive(Debug, Default, Clone)]
struct Seen {
    commands: Vec<DVec3>,
    disabled: bool,
}

/// A handle pressed a little into a floor; from its first reading on, its thread must leave the allocator alone.
struct Handle {
    seen: Arc<Mutex<Seen>>,
    readings: u64,
    fails_at: Option<u64>,
    panics_at: Option<u64>,
    max_force_n: f64,
}

impl Handle {
    fn new() -> (Handle, Arc<Mutex<Seen>>) {
        let seen = Arc::new(Mutex::new(Seen { commands: Vec::with_capacity(100_000), disabled: false }));
        (Handle { seen: seen.clone(), readings: 0, fails_at: None, panics_at: None, max_force_n: 20.0 }, seen)
    }
}

impl Device for Handle {
    fn name(&self) -> &str {
        "handle"
    }
    fn limits(&self) -> DeviceLimits {
        DeviceLimits { max_force_n: self.max_force_n, workspace: Workspace { radius_m: 0.1, height_m: 0.1 } }
    }
    fn read(&mut self) -> Result<DeviceState, DeviceError> {
        WATCHED.set(true);
        self.readings += 1;
        if self.fails_at == Some(self.readings) {
            return Err(DeviceError::Lost { device: "handle", reason: "unplugged" });
        }
        if self.panics_at == Some(self.readings) {
            WATCHED.set(false);
            panic!("a bug in a backend");
        }
        Ok(DeviceState {
            pose: Pose { translation: DVec3::new(0.0, 0.0, 0.003), rotation: DQuat::IDENTITY },
            linear_velocity_m_per_s: DVec3::ZERO,
            angular_velocity_rad_per_s: DVec3::ZERO,
            gripper_rad: None,
            buttons: 0,
            device_time_ns: self.readings,
        })
    }
    fn command(&mut self, force_n: DVec3) -> Result<(), DeviceError> {
        self.seen.lock().unwrap().commands.push(force_n);
        Ok(())
    }
    fn disable(&mut self) -> Result<(), DeviceError> {
        WATCHED.set(false);
        self.seen.lock().unwrap().disabled = true;
        Ok(())
    }
}

const SETTINGS: MotorSettings =
    MotorSettings { rate_hz: 4000.0, max_force_n: 20.0, source: ForceSource::ContactLaw, fifo_priority: 50 };

fn chains(normal_stiffness_n_per_m: f64) -> Arc<ContactLaw> {
    let one = ChainParameters {
        rod_length_m: 0.01,
        angle_rad: 0.6,
        ratio: 0.8,
        units: 10,
        normal_stiffness_n_per_m,
        tangential_stiffness_n_per_m: 100.0,
        tangential_growth: 10.0,
        weight: 1.0,
        pitch_m: 0.016,
    };
    Arc::new(ContactLaw::new(Formulation::Energy, &[one]).unwrap())
}

fn floor(stamp_ns: i64, chains: Arc<ContactLaw>) -> LawCommand {
    let local = LocalLaw {
        mode: Mode::Contact,
        anchor: DVec3::ZERO,
        normal: DVec3::Z,
        probe_radius_m: 0.005,
        depth_offset_m: 0.0,
        stiffness_factor: 1.0,
        ..LocalLaw::default()
    };
    LawCommand { stamp_ns, validity_ns: 100_000_000, local, chains }
}

#[test]
fn the_loop_answers_with_the_laws_force_and_never_calls_the_allocator() {
    let (handle, seen) = Handle::new();
    let (out, mut drain) = samples(64);
    let mut motor = MotorLoop::start(Box::new(handle), SETTINGS, out).unwrap();
    let before = ALLOCATOR_CALLS.load(SeqCst);
    let mut forces = Vec::new();
    let mut last_stamp_ns = 0;
    // Every answer brings new chains, so every period lets go of old ones.
    while forces.len() < 2000 {
        let Some(sample) = drain.recv_timeout(Duration::from_secs(10)) else { continue };
        assert!(sample.stamp_ns > last_stamp_ns);
        last_stamp_ns = sample.stamp_ns;
        motor.send_law(floor(sample.stamp_ns, chains(500.0 + forces.len() as f64)));
        if sample.origin == ForceOrigin::ContactLaw {
            forces.push(sample.force_n);
        }
    }
    assert!(motor.is_running());
    motor.stop().unwrap();
    assert_eq!(ALLOCATOR_CALLS.load(SeqCst) - before, 0, "allocations or frees in the motor loop's thread");

    let softest = chains(500.0).at_depth(0.002).unwrap().force_n;
    assert!(forces.iter().all(|f| f.z >= softest - 1e-12 && f.x == 0.0 && f.y == 0.0), "{:?}", forces[0]);
    assert!(forces[forces.len() - 1].z > 2.0 * softest);
    let seen = seen.lock().unwrap();
    assert_eq!(seen.commands.last(), Some(&DVec3::ZERO));
    assert!(seen.disabled);
    assert_eq!(motor.counts().unusable_forces, 0);
}

#[test]
fn samples_that_nobody_takes_are_counted_and_do_not_stop_the_loop() {
    let (handle, seen) = Handle::new();
    let (out, drain) = samples(8);
    let mut motor = MotorLoop::start(Box::new(handle), SETTINGS, out).unwrap();
    while motor.counts().ticks < 50 {
        std::thread::yield_now();
    }
    motor.stop().unwrap();
    let counts = motor.counts();
    assert_eq!(counts.lost_samples, counts.ticks - 8);
    assert!(
        seen.lock().unwrap().commands.len() as u64 > counts.ticks,
        "a force each tick, and none at the end"
    );
    drop(drain);
}

#[test]
fn a_device_that_is_lost_ends_the_loop_with_the_motors_off_and_the_reason() {
    let (mut handle, seen) = Handle::new();
    handle.fails_at = Some(5);
    let (out, mut drain) = samples(64);
    let mut motor = MotorLoop::start(Box::new(handle), SETTINGS, out).unwrap();
    while !drain.is_abandoned() {
        std::thread::yield_now();
    }
    assert!(motor.stop().unwrap_err().to_string().contains("unplugged"));
    assert!(!motor.is_running());
    assert!(seen.lock().unwrap().disabled);
    assert_eq!(std::iter::from_fn(|| drain.try_recv()).count(), 4);
}

#[test]
fn a_panic_in_the_loop_leaves_the_motors_off() {
    let (mut handle, seen) = Handle::new();
    handle.panics_at = Some(3);
    let (out, drain) = samples(64);
    let mut motor = MotorLoop::start(Box::new(handle), SETTINGS, out).unwrap();
    while !drain.is_abandoned() {
        std::thread::yield_now();
    }
    assert!(matches!(motor.stop(), Err(MotorError::Panicked)));
    let seen = seen.lock().unwrap();
    assert_eq!(seen.commands.last(), Some(&DVec3::ZERO));
    assert!(seen.disabled);
}

#[test]
fn a_device_or_a_rate_that_makes_no_sense_is_refused() {
    for max_force_n in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let (mut handle, _) = Handle::new();
        handle.max_force_n = max_force_n;
        assert!(matches!(
            MotorLoop::start(Box::new(handle), SETTINGS, samples(8).0),
            Err(MotorError::Limits { .. })
        ));
    }
    for rate_hz in [0.0, 9.9, 4001.0, f64::NAN] {
        let settings = MotorSettings { rate_hz, ..SETTINGS };
        let started = MotorLoop::start(Box::new(Handle::new().0), settings, samples(8).0);
        assert!(matches!(started, Err(MotorError::Rate { .. })));
    }
}
