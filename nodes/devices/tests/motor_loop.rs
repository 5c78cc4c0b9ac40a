//! The motor loop as a thread: what it does to a device, seen from the device.

#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests, outside the test functions")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::atomic::{AtomicU64, Ordering::SeqCst};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use devices::{
    Answer, Description, Device, DeviceError, DeviceLimits, DeviceState, FaultCause, ForceOrigin,
    ForceSource, LawCommand, MotorError, MotorLoop, MotorSettings, OperatingState, Request, SafetySettings,
    Sample, SampleReceiver, StateCommand, Workspace, Wrench, samples,
};
use glam::{DQuat, DVec3};
use rhombus_chain::{ChainParameters, ContactLaw, Formulation, LocalLaw, Mode, Pose};

thread_local! {
    /// Whether the current thread's use of the allocator is counted.
    static WATCHED: Cell<bool> = const { Cell::new(false) };
    /// What was counted. Each thread's own, because other tests' loops run beside.
    static ALLOCATOR_CALLS: Cell<u64> = const { Cell::new(0) };
}

fn count_if_watched() {
    ALLOCATOR_CALLS.set(ALLOCATOR_CALLS.get() + u64::from(WATCHED.get()));
}

struct Counting;

#[expect(unsafe_code, reason = "an allocator that counts what the watched thread asks of it")]
// SAFETY: every call goes unchanged to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count_if_watched();
        // SAFETY: the caller's promise is passed on.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count_if_watched();
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
    motors_on: bool,
    opened: u32,
    /// Allocations and frees in its thread while that was watched, up to when the motors went off last.
    allocator_calls: u64,
}

/// What shall go wrong.
#[derive(Clone, Copy, Default)]
struct Plan {
    /// Reading at which the device is lost, the first time it is open.
    lost_at: Option<u64>,
    panics_at: Option<u64>,
    max_force_n: Option<f64>,
    workspace: Option<Workspace>,
    /// Reading from which on the handle is in the floor.
    pressed_from: u64,
}

/// A handle that is pressed into a floor; from its first reading on, its thread must leave the allocator alone.
struct Handle {
    description: Description,
    seen: Arc<Mutex<Seen>>,
    plan: Plan,
    readings: u64,
}

impl Device for Handle {
    fn description(&self) -> &Description {
        &self.description
    }
    fn read(&mut self) -> Result<DeviceState, DeviceError> {
        WATCHED.set(true);
        self.readings += 1;
        if self.plan.lost_at == Some(self.readings) {
            WATCHED.set(false);
            return Err(DeviceError::Lost { device: "handle", reason: "unplugged" });
        }
        if self.plan.panics_at == Some(self.readings) {
            WATCHED.set(false);
            panic!("a bug in a backend");
        }
        let z = if self.readings < self.plan.pressed_from { 0.01 } else { 0.003 };
        let pose = Pose { translation: DVec3::new(0.0, 0.0, z), rotation: DQuat::IDENTITY };
        Ok(DeviceState { device_time_ns: self.readings, ..DeviceState::at_rest(pose) })
    }
    fn command(&mut self, wrench: &Wrench) -> Result<(), DeviceError> {
        self.seen.lock().unwrap().commands.push(wrench.force_n);
        Ok(())
    }
    fn enable(&mut self) -> Result<(), DeviceError> {
        self.seen.lock().unwrap().motors_on = true;
        Ok(())
    }
    fn disable(&mut self) -> Result<(), DeviceError> {
        WATCHED.set(false);
        let mut seen = self.seen.lock().unwrap();
        seen.motors_on = false;
        seen.allocator_calls = ALLOCATOR_CALLS.get();
        Ok(())
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        WATCHED.set(false);
    }
}

/// Opens handles; what goes wrong goes wrong with the first one.
fn opener(
    plan: Plan,
    seen: &Arc<Mutex<Seen>>,
) -> impl FnMut() -> Result<Box<dyn Device>, DeviceError> + use<> {
    let seen = seen.clone();
    move || {
        let mut guard = seen.lock().unwrap();
        guard.opened += 1;
        let plan = if guard.opened == 1 { plan } else { Plan::default() };
        let limits = DeviceLimits {
            max_force_n: Some(plan.max_force_n.unwrap_or(20.0)),
            max_torque_n_m: None,
            max_gripper_force_n: None,
            workspace: plan.workspace.unwrap_or(WORKSPACE),
        };
        let description = Description {
            backend: "handle",
            model: String::new(),
            serial: "7".to_owned(),
            firmware: String::new(),
            limits,
            buttons: Vec::new(),
            joints: Vec::new(),
            has_gripper: false,
            needs_homing: false,
            watchdog: None,
            status_names: &[],
        };
        drop(guard);
        Ok(Box::new(Handle { description, seen: seen.clone(), plan, readings: 0 }))
    }
}

/// A loop of 4 kHz whose engage ramp is short; the rest as in a session.
fn settings() -> MotorSettings {
    let safety = SafetySettings { engage_ramp_s: 0.05, ..SafetySettings::default() };
    MotorSettings {
        rate_hz: 4000.0,
        fifo_priority: 50,
        cpu: None,
        source: ForceSource::ContactLaw,
        safety: safety.checked(4000.0, &["safety.engage_ramp".to_owned()]).unwrap(),
        enable_at_start: true,
        gravity_compensation: false,
    }
}

fn start(plan: Plan) -> (MotorLoop, SampleReceiver, Arc<Mutex<Seen>>) {
    let seen = Arc::new(Mutex::new(Seen { commands: Vec::with_capacity(1_000_000), ..Seen::default() }));
    let (out, drain) = samples(4096);
    (MotorLoop::start(opener(plan, &seen), settings(), out).unwrap(), drain, seen)
}

fn next(drain: &mut SampleReceiver) -> Sample {
    loop {
        if let Some(sample) = drain.recv_timeout(Duration::from_secs(10)) {
            return sample;
        }
    }
}

/// Presses until the force is what the law says.
fn press(motor: &mut MotorLoop, drain: &mut SampleReceiver) -> DVec3 {
    let full_n = chains(500.0).at_depth(0.002).unwrap().force_n;
    for _ in 0..40_000 {
        let sample = next(drain);
        motor.beat();
        motor.send_law(floor(sample.stamp_ns, chains(500.0)));
        if (sample.wrench.force_n.z - full_n).abs() < 1e-9 {
            return sample.wrench.force_n;
        }
    }
    panic!("the force never came to {full_n} N: {:?}", motor.status());
}

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

const WORKSPACE: Workspace = Workspace { centre: DVec3::ZERO, radius_m: 0.1, height_m: 0.1 };
const PRESSED: Plan =
    Plan { lost_at: None, panics_at: None, max_force_n: None, workspace: None, pressed_from: 40 };

#[test]
fn the_loop_answers_with_the_laws_force_and_never_calls_the_allocator() {
    let (mut motor, mut drain, seen) = start(PRESSED);
    let mut last_stamp_ns = 0;
    let mut forces = Vec::with_capacity(3000);
    // Every answer brings new chains, so every period lets go of old ones.
    for i in 0..3000 {
        let sample = next(&mut drain);
        assert!(sample.stamp_ns > last_stamp_ns);
        last_stamp_ns = sample.stamp_ns;
        motor.beat();
        motor.send_law(floor(sample.stamp_ns, chains(500.0 + f64::from(i))));
        if sample.origin == ForceOrigin::ContactLaw {
            forces.push(sample.wrench.force_n);
        }
    }
    assert!(motor.is_running());
    assert_eq!(motor.enabled_at_start(), Some(Answer::Accepted(OperatingState::Enabled)));
    motor.stop().unwrap();

    let softest = chains(500.0).at_depth(0.002).unwrap().force_n;
    let last = forces[forces.len() - 1];
    assert!(last.z > 2.0 * softest && last.x == 0.0 && last.y == 0.0, "{last}");
    let seen = seen.lock().unwrap();
    assert_eq!(seen.allocator_calls, 0, "allocations or frees in the motor loop's thread");
    assert_eq!(seen.commands.last(), Some(&DVec3::ZERO));
    assert!(!seen.motors_on);
    assert_eq!(motor.counts().unusable_forces, 0);
}

/// A device whose thread must leave the allocator alone from the first reading on.
#[cfg(feature = "pointer")]
struct Watched {
    device: devices::pointer::PointerDevice,
    allocator_calls: Arc<AtomicU64>,
}

#[cfg(feature = "pointer")]
impl Device for Watched {
    fn description(&self) -> &Description {
        self.device.description()
    }
    fn read(&mut self) -> Result<DeviceState, DeviceError> {
        WATCHED.set(true);
        self.device.read()
    }
    fn command(&mut self, wrench: &Wrench) -> Result<(), DeviceError> {
        self.device.command(wrench)
    }
    fn enable(&mut self) -> Result<(), DeviceError> {
        self.device.enable()
    }
    fn disable(&mut self) -> Result<(), DeviceError> {
        WATCHED.set(false);
        self.allocator_calls.store(ALLOCATOR_CALLS.get(), SeqCst);
        self.device.disable()
    }
}

#[cfg(feature = "pointer")]
#[test]
fn a_hand_that_is_led_by_a_pointer_presses_and_never_calls_the_allocator() {
    use devices::hand::HandSettings;
    use devices::pointer::{PointerDevice, Settings, Target, Targets};

    let targets = Targets::new();
    let mut sender = targets.sender();
    let settings_of_device = Settings {
        hand: HandSettings { mass_kg: 0.3, stiffness_n_per_m: 500.0, damping_n_s_per_m: 20.0 },
        start: DVec3::new(0.0, 0.0, 0.01),
        max_speed_m_per_s: 0.5,
        period_s: 1.0 / 4000.0,
        targets,
    };
    let allocator_calls = Arc::new(AtomicU64::new(u64::MAX));
    let counted = allocator_calls.clone();
    let open = move || -> Result<Box<dyn Device>, DeviceError> {
        let device = PointerDevice::open(settings_of_device.clone())?;
        Ok(Box::new(Watched { device, allocator_calls: counted.clone() }))
    };
    let (out, mut drain) = samples(4096);
    let mut motor = MotorLoop::start(open, settings(), out).unwrap();
    let (mut pressed_n, mut last) = (0.0f64, None);
    // Targets as often as periods, so that every period lets go of an old one; then none, so that the hand lets go.
    for i in 0..6000u32 {
        let sample = next(&mut drain);
        motor.beat();
        motor.send_law(floor(sample.stamp_ns, chains(500.0)));
        if i < 2000 {
            sender.send(Target::new(DVec3::new(0.0, 0.0, 0.002), 0.01).unwrap());
        }
        pressed_n = pressed_n.max(sample.wrench.force_n.z);
        last = Some(sample);
    }
    motor.stop().unwrap();
    assert_eq!(allocator_calls.load(SeqCst), 0, "allocations or frees in the motor loop's thread");
    assert!(pressed_n > 0.1, "{pressed_n} N");
    let last = last.unwrap();
    assert!(last.wrench.force_n.z < 0.1 * pressed_n, "the hand has let go: {:?}", last.wrench);
}

#[test]
fn however_the_loop_is_told_to_end_the_force_never_steps() {
    type Command = fn(&mut MotorLoop);
    let disable: Command = |motor| {
        assert!(matches!(motor.request(Request::State(StateCommand::Disable)), Answer::Accepted(_)));
    };
    let emergency_stop: Command = |motor| motor.set_emergency_stop(true);
    let short_stop: Command = |motor| {
        motor.set_emergency_stop(true);
        motor.set_emergency_stop(false);
    };
    for command in [None, Some(disable), Some(emergency_stop), Some(short_stop)] {
        let (mut motor, mut drain, seen) = start(PRESSED);
        press(&mut motor, &mut drain);
        if let Some(command) = command {
            command(&mut motor);
            while next(&mut drain).wrench != Wrench::ZERO {}
            // The motors go off in the period in which the force has arrived at zero, or the next.
            next(&mut drain);
            next(&mut drain);
            assert!(!seen.lock().unwrap().motors_on);
        }
        motor.stop().unwrap();
        let seen = seen.lock().unwrap();
        assert!(!seen.motors_on);
        assert_eq!(seen.commands.last(), Some(&DVec3::ZERO));
        let most_n = settings().safety.slew_n_per_s / 4000.0;
        let largest = seen.commands.windows(2).map(|w| (w[1] - w[0]).length()).fold(0.0, f64::max);
        assert!(largest <= most_n * (1.0 + 1e-9), "{largest} N in one period, {most_n} N allowed");
    }
}

#[test]
fn samples_that_nobody_takes_are_counted_and_do_not_stop_the_loop() {
    let seen = Arc::default();
    let (out, _drain) = samples(8);
    let mut motor = MotorLoop::start(opener(Plan::default(), &seen), settings(), out).unwrap();
    while motor.counts().ticks < 50 {
        std::thread::yield_now();
    }
    motor.stop().unwrap();
    let counts = motor.counts();
    assert!(counts.lost_samples >= 50 - 8 && counts.lost_samples < counts.ticks, "{counts:?}");
}

#[test]
fn a_device_that_is_lost_is_a_fault_and_comes_back_by_command() {
    let (mut motor, mut drain, seen) = start(Plan { lost_at: Some(400), ..PRESSED });
    while motor.counts().reopenings == 0 {
        drain.recv_timeout(Duration::from_millis(1));
        motor.beat();
    }
    let status = motor.status();
    assert_eq!((status.operating, status.fault), (OperatingState::Fault, Some(FaultCause::DeviceLost)));
    assert!(!seen.lock().unwrap().motors_on);
    let enable = Request::State(StateCommand::Enable);
    assert_eq!(motor.request(enable), Answer::Accepted(OperatingState::Enabled));
    assert!(seen.lock().unwrap().motors_on);
    assert_eq!(seen.lock().unwrap().opened, 2);
    motor.stop().unwrap();
    assert!(!seen.lock().unwrap().motors_on);
}

#[test]
fn a_panic_in_the_loop_leaves_the_motors_off() {
    let (mut motor, drain, seen) = start(Plan { panics_at: Some(30), ..PRESSED });
    while !drain.is_abandoned() {
        std::thread::yield_now();
    }
    assert!(matches!(motor.stop(), Err(MotorError::Panicked)));
    assert!(!motor.is_running());
    let seen = seen.lock().unwrap();
    assert_eq!(seen.commands.last(), Some(&DVec3::ZERO));
    assert!(!seen.motors_on);
}

#[test]
fn an_owner_that_falls_silent_takes_the_force_with_it() {
    let (mut motor, mut drain, seen) = start(PRESSED);
    press(&mut motor, &mut drain);
    // No beat any more, but laws still come: somebody else's thread may send them.
    while motor.status().fault.is_none() {
        let sample = next(&mut drain);
        motor.send_law(floor(sample.stamp_ns, chains(500.0)));
    }
    assert_eq!(motor.status().fault, Some(FaultCause::RosThreadHung));
    while next(&mut drain).wrench != Wrench::ZERO {}
    next(&mut drain);
    next(&mut drain);
    assert!(!seen.lock().unwrap().motors_on);
}

#[test]
fn a_device_or_a_rate_that_makes_no_sense_is_refused() {
    for max_force_n in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let plan = Plan { max_force_n: Some(max_force_n), ..Plan::default() };
        let started = MotorLoop::start(opener(plan, &Arc::default()), settings(), samples(8).0);
        assert!(matches!(started, Err(MotorError::Limits { .. })));
    }
    for bad in [f64::NAN, f64::INFINITY] {
        for (workspace, what) in [
            (Workspace { centre: DVec3::new(0.0, bad, 0.0), ..WORKSPACE }, "centre y [m]"),
            (Workspace { radius_m: bad, ..WORKSPACE }, "radius [m]"),
            (Workspace { height_m: -0.1, ..WORKSPACE }, "height [m]"),
        ] {
            let plan = Plan { workspace: Some(workspace), ..Plan::default() };
            let started = MotorLoop::start(opener(plan, &Arc::default()), settings(), samples(8).0);
            let refusal = started.err().unwrap().to_string();
            assert!(refusal.contains(what) && refusal.contains("accepted is a finite number"), "{refusal}");
        }
    }
    for rate_hz in [0.0, 199.0, 4001.0, f64::NAN] {
        let settings = MotorSettings { rate_hz, ..settings() };
        let started = MotorLoop::start(opener(Plan::default(), &Arc::default()), settings, samples(8).0);
        assert!(matches!(started, Err(MotorError::Rate { .. })));
    }
}
