//! What comes from the device: the newest state that can be believed, and counts of everything that could not.

use glam::DVec3;
use rhombus_chain::Pose;

use super::wire::{self, Cause, Hello, capability, state_flag};
use crate::{DeviceState, MAX_JOINTS, MAX_STATUS, MotorsOff};

/// Names of the numbers in [`DeviceState::status`], in their order.
pub(super) const STATUS_NAMES: &[&str] = &[
    "states",
    "lost_states",
    "stale_states",
    "refused_states",
    "bad_frames",
    "commands",
    "lost_commands",
    "skipped_commands",
    "round_trip_us",
    "longest_round_trip_us",
];
const _: () = assert!(STATUS_NAMES.len() <= MAX_STATUS);

/// Why a state is not believed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Refused {
    Joints,
    NotFinite,
    NoRotation,
    ClockWentBack,
}

impl Refused {
    pub(super) fn what(self) -> &'static str {
        match self {
            Refused::Joints => "states have another number of joints than the hello says",
            Refused::NotFinite => "states hold a NaN or an infinity",
            Refused::NoRotation => "the orientation in the states is no unit quaternion",
            Refused::ClockWentBack => "the clock in the states goes back",
        }
    }
}

/// How often what happened since the device was opened.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counts {
    pub states: u64,
    pub lost_states: u64,
    pub stale_states: u64,
    pub refused_states: u64,
    pub bad_frames: u64,
    pub commands: u64,
    pub lost_commands: u64,
    pub skipped_commands: u64,
    pub round_trip_us: u64,
    pub longest_round_trip_us: u64,
}

impl Counts {
    fn status(&self) -> [i32; MAX_STATUS] {
        let numbers = [
            self.states,
            self.lost_states,
            self.stale_states,
            self.refused_states,
            self.bad_frames,
            self.commands,
            self.lost_commands,
            self.skipped_commands,
            self.round_trip_us,
            self.longest_round_trip_us,
        ];
        let mut status = [0; MAX_STATUS];
        for (place, number) in status.iter_mut().zip(numbers) {
            *place = i32::try_from(number).unwrap_or(i32::MAX);
        }
        status
    }
}

/// The states of one device. RT safe.
#[derive(Clone, Debug)]
pub(super) struct States {
    joints: usize,
    capabilities: u32,
    /// The newest state believed; none before the first.
    newest: Option<Newest>,
    /// Sequence and lost commands of the newest state, believed or not.
    last: Option<(u16, u8)>,
    /// Why the newest state that was not believed was not.
    pub refused: Option<Refused>,
    pub counts: Counts,
}

/// A state that is believed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Newest {
    /// All of it but status and motors, which depend on what was commanded.
    state: DeviceState,
    /// When it was taken from the line, by the line's clock.
    pub received_ns: u64,
    time_us: u32,
    pub flags: u8,
    pub cause: Option<MotorsOff>,
    /// The newest command that the device had, and how long, us; none: it had none.
    pub echo: Option<(u16, u16)>,
}

impl States {
    pub(super) fn new(hello: &Hello) -> States {
        States {
            joints: usize::from(hello.joints),
            capabilities: hello.capabilities,
            newest: None,
            last: None,
            refused: None,
            counts: Counts::default(),
        }
    }

    pub(super) fn newest(&self) -> Option<&Newest> {
        self.newest.as_ref()
    }

    /// The newest state with the counts as they are now.
    pub(super) fn device_state(&self, motors_off: Option<MotorsOff>) -> Option<DeviceState> {
        let newest = self.newest.as_ref()?;
        Some(DeviceState { motors_off, status: self.counts.status(), ..newest.state })
    }

    /// Takes a state that came with `joints` joints. False when it is not newer than what is there, or not believed.
    pub(super) fn take(&mut self, state: &wire::State, joints: usize, now_ns: u64) -> bool {
        self.counts.states += 1;
        if let Some((sequence, lost_commands)) = self.last {
            let ahead = state.sequence.wrapping_sub(sequence).cast_signed();
            if ahead <= 0 {
                self.counts.stale_states += 1;
                return false;
            }
            self.counts.lost_states += u64::from(ahead.unsigned_abs() - 1);
            self.counts.lost_commands += u64::from(state.lost_commands.wrapping_sub(lost_commands));
        }
        self.last = Some((state.sequence, state.lost_commands));
        match self.believed(state, joints) {
            Ok(believed) => {
                let echo = (state.flags & state_flag::COMMANDED != 0)
                    .then_some((state.command_sequence, state.command_age_us));
                self.newest = Some(Newest {
                    state: believed,
                    received_ns: now_ns,
                    time_us: state.time_us,
                    flags: state.flags,
                    cause: motors_off(state),
                    echo,
                });
                true
            }
            Err(refused) => {
                self.counts.refused_states += 1;
                self.refused = Some(refused);
                false
            }
        }
    }

    fn believed(&self, state: &wire::State, joints: usize) -> Result<DeviceState, Refused> {
        if joints != self.joints {
            return Err(Refused::Joints);
        }
        let [x, y, z] = state.position_m.map(f64::from);
        let [qx, qy, qz, qw] = match self.has(capability::ORIENTATION) {
            true => state.orientation.map(f64::from),
            false => [0.0, 0.0, 0.0, 1.0],
        };
        let angular =
            if self.has(capability::ORIENTATION) { state.angular_velocity_rad_per_s } else { [0.0; 3] };
        let mut all_joints = [0.0; MAX_JOINTS];
        for (place, joint) in all_joints.iter_mut().zip(&state.joints[..joints]) {
            *place = f64::from(*joint);
        }
        let finite = [x, y, z, qx, qy, qz, qw].iter().all(|number| number.is_finite());
        let pose = Pose::from_array([x, y, z, qx, qy, qz, qw]);
        let believed = DeviceState {
            pose: pose.map_err(|_| if finite { Refused::NoRotation } else { Refused::NotFinite })?,
            linear_velocity_m_per_s: DVec3::from_array(state.linear_velocity_m_per_s.map(f64::from)),
            angular_velocity_rad_per_s: DVec3::from_array(angular.map(f64::from)),
            gripper_rad: self.has(capability::GRIPPER).then_some(f64::from(state.gripper_rad)),
            buttons: u32::from(state.buttons),
            joints: all_joints,
            homed: !self.has(capability::NEEDS_HOMING) || state.flags & state_flag::HOMED != 0,
            motors_off: None,
            status: [0; MAX_STATUS],
            device_time_ns: self.device_time_ns(state.time_us)?,
        };
        if believed.is_finite() { Ok(believed) } else { Err(Refused::NotFinite) }
    }

    pub(super) fn has(&self, capability: u32) -> bool {
        self.capabilities & capability != 0
    }

    /// The device's clock beyond its 32 bits, which last 71 minutes.
    fn device_time_ns(&self, time_us: u32) -> Result<u64, Refused> {
        let Some(newest) = &self.newest else { return Ok(u64::from(time_us) * 1000) };
        let since_us = time_us.wrapping_sub(newest.time_us);
        match since_us.cast_signed() < 0 {
            true => Err(Refused::ClockWentBack),
            false => Ok(newest.state.device_time_ns + u64::from(since_us) * 1000),
        }
    }
}

/// Why the device says that its motors are off; none: they are on.
fn motors_off(state: &wire::State) -> Option<MotorsOff> {
    if state.flags & state_flag::MOTORS_ON != 0 {
        return None;
    }
    let causes = [
        (Cause::Command, MotorsOff::Software),
        (Cause::Watchdog, MotorsOff::Watchdog),
        (Cause::Velocity, MotorsOff::Velocity),
        (Cause::Button, MotorsOff::Button),
        (Cause::DeadMan, MotorsOff::DeadMan),
        (Cause::Emergency, MotorsOff::Emergency),
    ];
    let known = causes.iter().find(|(cause, _)| *cause as u8 == state.cause);
    Some(known.map_or(MotorsOff::Other, |(_, motors_off)| *motors_off))
}
