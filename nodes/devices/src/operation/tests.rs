//! What requests and faults do to the operating state.

use super::OperatingState::{Disabled, Enabled, Fault, Paused};
use super::StateCommand::{Disable, Enable, Home, Pause, Resume};
use super::*;
use crate::requests::{Asker, requests};
use crate::{Description, DeviceLimits, ForceSource, MotorsOff, SafetySettings, Workspace, Wrench};
use glam::DVec3;
use rhombus_chain::Pose;

const MS: u64 = 1_000_000;

struct Motors {
    description: Description,
    on: bool,
    homes: bool,
}

impl Device for Motors {
    fn description(&self) -> &Description {
        &self.description
    }
    fn read(&mut self) -> Result<DeviceState, DeviceError> {
        Ok(DeviceState::at_rest(Pose::IDENTITY))
    }
    fn command(&mut self, _: &Wrench) -> Result<(), DeviceError> {
        Ok(())
    }
    fn enable(&mut self) -> Result<(), DeviceError> {
        self.on = true;
        Ok(())
    }
    fn disable(&mut self) -> Result<(), DeviceError> {
        self.on = false;
        Ok(())
    }
    fn home(&mut self) -> Result<(), DeviceError> {
        if self.homes { Ok(()) } else { Err(DeviceError::Lost { device: "motors", reason: "stuck" }) }
    }
}

struct Bench {
    operation: Operation,
    motors: Motors,
    shared: Arc<Shared>,
    // Kept so that the queue has two ends.
    _asker: Asker,
}

fn bench() -> Bench {
    let (asker, askee) = requests();
    let shared = Arc::new(Shared::new(20.0, 0));
    let limits = DeviceLimits {
        max_force_n: Some(20.0),
        max_torque_n_m: None,
        max_gripper_force_n: None,
        workspace: Workspace { centre: DVec3::ZERO, radius_m: 0.1, height_m: 0.1 },
    };
    let description = Description {
        backend: "motors",
        model: String::new(),
        serial: String::new(),
        firmware: String::new(),
        limits,
        buttons: Vec::new(),
        joints: Vec::new(),
        has_gripper: false,
        needs_homing: true,
        watchdog: None,
        status_names: &[],
    };
    Bench {
        operation: Operation::new(askee, shared.clone(), &settings()),
        motors: Motors { description, on: false, homes: true },
        shared,
        _asker: asker,
    }
}

fn settings() -> MotorSettings {
    MotorSettings {
        rate_hz: 1000.0,
        fifo_priority: 1,
        cpu: None,
        source: ForceSource::ContactLaw,
        safety: SafetySettings::default().checked(1000.0, &[]).unwrap(),
        enable_at_start: false,
        gravity_compensation: true,
    }
}

impl Bench {
    fn ask(&mut self, command: StateCommand) -> (bool, OperatingState) {
        let request = Request::State(command);
        let accepted = self.operation.execute(request, Some(&mut self.motors), 0).unwrap();
        (accepted, self.operation.state())
    }

    /// A period in which the force is zero.
    fn period(&mut self, state: &DeviceState, now_ns: u64) -> OperatingState {
        self.operation.watch(state, now_ns);
        self.operation.switch_motors(&mut self.motors, true, false).unwrap();
        self.operation.state()
    }
}

fn still() -> DeviceState {
    DeviceState::at_rest(Pose::IDENTITY)
}

#[test]
fn motors_are_on_in_the_states_that_say_so() {
    let mut bench = bench();
    for (command, state, on) in [
        (Enable, Enabled, true),
        (Pause, Paused, true),
        (Resume, Enabled, true),
        (Disable, Disabled, false),
        (Enable, Enabled, true),
    ] {
        assert_eq!(bench.ask(command), (true, state));
        bench.period(&still(), MS);
        assert_eq!(bench.motors.on, on, "{command:?}");
    }
}

#[test]
fn motors_go_off_only_when_the_force_has_gone() {
    let mut bench = bench();
    bench.ask(Enable);
    bench.ask(Disable);
    bench.operation.switch_motors(&mut bench.motors, false, false).unwrap();
    assert!(bench.motors.on);
    bench.operation.switch_motors(&mut bench.motors, true, false).unwrap();
    assert!(!bench.motors.on);
}

#[test]
fn an_emergency_stop_is_a_fault_that_enabling_cannot_clear_while_it_is_pressed() {
    let mut bench = bench();
    bench.ask(Enable);
    let stop = |bench: &mut Bench, pressed| {
        bench.shared.set_emergency_stop(pressed);
        bench.operation.serve(Some(&mut bench.motors), 0).unwrap();
    };
    stop(&mut bench, true);
    assert_eq!(bench.operation.fault(), Some(FaultCause::EmergencyStop));
    assert_eq!(bench.ask(Enable), (false, Fault));
    assert_eq!(bench.ask(Disable), (true, Disabled));
    assert_eq!(bench.ask(Enable), (false, Disabled), "no command leads into a fault");
    stop(&mut bench, false);
    assert_eq!(bench.ask(Enable), (true, Enabled));
    assert_eq!(bench.operation.fault(), None);
}

#[test]
fn an_emergency_stop_that_is_released_before_anybody_looks_is_a_fault_all_the_same() {
    let mut bench = bench();
    bench.ask(Enable);
    let pulse = |bench: &mut Bench| {
        bench.shared.set_emergency_stop(true);
        bench.shared.set_emergency_stop(false);
    };
    pulse(&mut bench);
    bench.operation.serve(Some(&mut bench.motors), 0).unwrap();
    assert_eq!(bench.operation.fault(), Some(FaultCause::EmergencyStop));
    assert_eq!(bench.ask(Enable), (true, Enabled), "released, so a command clears it");
    bench.operation.serve(Some(&mut bench.motors), 0).unwrap();
    assert_eq!(bench.operation.state(), Enabled, "one press is one fault");

    // While the device is homed nobody looks.
    bench.ask(Home);
    assert!(bench.operation.take_homing());
    pulse(&mut bench);
    let homed = bench.motors.home();
    bench.operation.end_homing(homed);
    bench.operation.serve(Some(&mut bench.motors), 0).unwrap();
    assert_eq!(bench.operation.fault(), Some(FaultCause::EmergencyStop));

    // While there is no device the first cause stays; disabled in the meantime, the press is one of its own.
    bench.operation.lose_device();
    bench.ask(Disable);
    pulse(&mut bench);
    bench.operation.find_device();
    bench.operation.serve(Some(&mut bench.motors), 0).unwrap();
    assert_eq!(bench.operation.fault(), Some(FaultCause::EmergencyStop));
    assert_eq!(bench.ask(Enable), (true, Enabled));
}

#[test]
fn a_fault_stays_when_its_cause_goes_and_ends_by_command() {
    let mut bench = bench();
    bench.ask(Enable);
    let off = DeviceState { motors_off: Some(MotorsOff::Velocity), ..still() };
    assert_eq!(bench.period(&off, 100 * MS), Enabled, "just enabled: the device may take a moment");
    assert_eq!(bench.period(&off, 300 * MS), Fault);
    assert!(!bench.motors.on);
    assert_eq!(bench.period(&still(), 400 * MS), Fault);
    assert_eq!(bench.operation.fault(), Some(FaultCause::DeviceMotorsOff(MotorsOff::Velocity)));
    assert_eq!(bench.ask(Enable), (true, Enabled));
}

#[test]
fn an_owner_that_is_silent_is_a_fault_until_it_is_back_and_says_so() {
    let mut bench = bench();
    bench.ask(Enable);
    assert_eq!(bench.period(&still(), 1000 * MS), Enabled);
    assert_eq!(bench.period(&still(), 1001 * MS), Fault);
    assert_eq!(bench.ask(Enable), (false, Fault));
    bench.shared.beat(1500 * MS);
    assert_eq!(bench.period(&still(), 1501 * MS), Fault);
    assert_eq!(bench.ask(Enable), (true, Enabled));
}

#[test]
fn readings_that_are_not_finite_are_a_glitch_one_at_a_time_and_a_fault_ten_in_a_row_or_more_than_one_in_ten()
{
    // Of unusable readings and good ones after them, again and again.
    let fault = |unusable: usize, good: usize, times: usize| {
        let mut bench = bench();
        bench.ask(Enable);
        for _ in 0..times {
            (0..unusable).for_each(|_| bench.operation.watch_unusable(MS));
            (0..good).for_each(|_| _ = bench.period(&still(), MS));
        }
        bench.operation.fault()
    };
    assert_eq!(fault(9, 1000, 1), None);
    assert_eq!(fault(1, 10, 10_000), None);
    for (unusable, good, times) in [(10, 0, 1), (9, 1, 2), (1, 1, 12), (1, 8, 60)] {
        assert_eq!(
            fault(unusable, good, times),
            Some(FaultCause::NotFinite),
            "{unusable} of {}",
            unusable + good
        );
    }
}

#[test]
fn what_keeps_the_motors_off_is_shown_without_a_fault_too() {
    let mut bench = bench();
    let mut shown = |pressed, command| {
        bench.shared.set_emergency_stop(pressed);
        bench.operation.watch_emergency_stop();
        bench.ask(command);
        bench.operation.publish();
        let MotorStatus { operating, fault, barred_by, .. } = bench.shared.status();
        (operating, fault, barred_by)
    };
    let stop = Some(FaultCause::EmergencyStop);
    assert_eq!(shown(true, Enable), (Fault, stop, stop));
    assert_eq!(shown(false, Disable), (Disabled, None, None));
    assert_eq!(shown(true, Disable), (Disabled, None, stop));
    assert_eq!(shown(false, Enable), (Enabled, None, None));
}

#[test]
fn a_lost_device_is_a_fault_whatever_the_state_and_comes_back_by_command() {
    let mut bench = bench();
    bench.operation.lose_device();
    assert_eq!(bench.operation.state(), Fault);
    assert_eq!(bench.ask(Enable), (false, Fault));
    bench.operation.find_device();
    assert_eq!(bench.operation.state(), Fault);
    assert_eq!(bench.ask(Enable), (true, Enabled));
}

#[test]
fn free_and_hold_need_motors_and_end_with_enable_or_resume() {
    let mut bench = bench();
    let ask = |bench: &mut Bench, request| bench.operation.execute(request, None, 0).unwrap();
    assert!(!ask(&mut bench, Request::Hold));
    bench.ask(Enable);
    for (request, mode) in [(Request::Hold, SourceMode::Hold), (Request::Free, SourceMode::Free)] {
        assert!(ask(&mut bench, request));
        assert_eq!(bench.operation.mode(), mode);
        assert!(bench.ask(Enable).0);
        assert_eq!(bench.operation.mode(), SourceMode::Follow);
    }
}

#[test]
fn homing_is_busy_until_it_ends_and_a_failure_is_a_fault() {
    let mut bench = bench();
    bench.ask(Enable);
    assert_eq!(bench.ask(Home), (true, Enabled));
    bench.operation.publish();
    assert!(bench.shared.status().is_busy);
    assert!(bench.operation.take_homing() && !bench.operation.take_homing());
    bench.ask(Home);
    bench.ask(Disable);
    assert!(!bench.operation.take_homing(), "motors off: nothing moves any more");
    bench.ask(Enable);
    bench.ask(Home);
    assert!(bench.operation.take_homing());
    let homed = bench.motors.home();
    bench.operation.end_homing(homed);
    assert!(!bench.shared.status().is_busy);
    bench.motors.homes = false;
    bench.ask(Home);
    let homed = bench.motors.home();
    bench.operation.end_homing(homed);
    assert_eq!(bench.operation.fault(), Some(FaultCause::HomingFailed));
}
