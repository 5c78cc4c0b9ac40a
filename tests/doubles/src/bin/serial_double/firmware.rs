//! What the firmware does: answers, obeys within its limits, and takes the force away when nobody commands.

use std::io;
use std::time::Duration;

use devices::serial::wire::{
    Cause, Command, Frame, Hello, Message, PROTOCOL_VERSION, Receiver, State, capability, command_flag,
    state_flag,
};
use devices::{DeviceError, Workspace, Wrench};
use glam::{DVec3, Vec3};
use rhombus_doubles::{Event, Motors, PressingHand};

use crate::arguments::Arguments;
use crate::fault::Fault;
use crate::line::Line;

pub(crate) const WATCHDOG: Duration = Duration::from_millis(20);
const MAX_FORCE_N: f32 = 20.0;
const MAX_TORQUE_N_M: f32 = 0.4;
const MAX_GRIPPER_FORCE_N: f32 = 8.0;
const WORKSPACE: Workspace = Workspace { centre: DVec3::ZERO, radius_m: 0.18, height_m: 0.3 };

pub(crate) struct Firmware {
    fault: Fault,
    hello: Hello,
    motors: Motors,
    hand: PressingHand,
    max_speed: f64,
    receiver: Receiver,
    start_ns: u64,
    step_ns: u64,
    steps: u64,
    /// It has been asked who it is.
    greeted: bool,
    /// Why it took its motors away itself. Stays until a command without motors.
    latched: Option<Cause>,
    cause: Cause,
    /// The newest good command since the hello, and when it came.
    command: Option<(Command, u64)>,
    lost_commands: u8,
    commands: u64,
    homing_ns: Option<u64>,
    homed: Homed,
    states: u64,
    sequence: u16,
    held_back: Option<Frame>,
}

#[derive(Clone, Copy, PartialEq)]
enum Homed {
    No,
    Until(u64),
    Yes,
}

impl Firmware {
    pub(crate) fn new(arguments: &Arguments, motors: Motors, step_s: f64) -> Result<Firmware, DeviceError> {
        let mut capabilities = capability::FORCE
            | capability::TORQUE
            | capability::ORIENTATION
            | capability::GRIPPER
            | capability::GRIPPER_FORCE
            | capability::GRAVITY_COMPENSATION;
        if arguments.homing_s.is_some() {
            capabilities |= capability::NEEDS_HOMING;
        }
        let mut hello = Hello {
            version: PROTOCOL_VERSION,
            buttons: 2,
            joints: arguments.joints,
            capabilities,
            watchdog_ms: WATCHDOG.as_millis() as u16,
            state_rate_hz: arguments.rate_hz,
            max_force_n: MAX_FORCE_N,
            max_torque_n_m: MAX_TORQUE_N_M,
            max_gripper_force_n: MAX_GRIPPER_FORCE_N,
            workspace_centre_m: WORKSPACE.centre.as_vec3().to_array(),
            workspace_radius_m: WORKSPACE.radius_m as f32,
            workspace_height_m: WORKSPACE.height_m as f32,
            model: Hello::name("Double delta"),
            serial: Hello::name(&arguments.serial),
            firmware: Hello::name("1.0.0"),
        };
        arguments.fault.spoil_hello(&mut hello);
        Ok(Firmware {
            fault: arguments.fault,
            hello,
            motors,
            hand: PressingHand::new(arguments.hand, WORKSPACE, step_s)?,
            max_speed: arguments.max_speed,
            receiver: Receiver::default(),
            start_ns: rhombus_doubles::monotonic_ns(),
            step_ns: (step_s * 1e9) as u64,
            steps: 0,
            greeted: false,
            latched: None,
            cause: Cause::None,
            command: None,
            lost_commands: 0,
            commands: 0,
            homing_ns: arguments.homing_s.map(|s| (s * 1e9) as u64),
            homed: if arguments.homing_s.is_some() { Homed::No } else { Homed::Yes },
            states: 0,
            sequence: 0,
            held_back: None,
        })
    }

    /// Everything that has come from the host.
    pub(crate) fn listen(&mut self, line: &mut Line, now_ns: u64) -> io::Result<()> {
        let mut chunk = [0; 1024];
        loop {
            let count = line.receive(&mut chunk)?;
            let mut input = &chunk[..count];
            // Decoded before it is obeyed: a frame borrows the receiver.
            while let Some(frame) = self.receiver.next(&mut input) {
                let message = frame.ok().and_then(|payload| Message::decode(payload).ok());
                self.obey(message, line, now_ns)?;
            }
            if count < chunk.len() {
                return Ok(());
            }
        }
    }

    fn obey(&mut self, message: Option<Message>, line: &mut Line, now_ns: u64) -> io::Result<()> {
        match message {
            Some(Message::HelloRequest(_)) => {
                if self.motors.are_on() {
                    self.motors.off(now_ns, Event::Off)?;
                }
                (self.greeted, self.command) = (true, None);
                self.cause = self.latched.unwrap_or(Cause::None);
                if self.fault != Fault::NoHello {
                    line.send(self.fault.spoil_frame(self.hello.frame().bytes()))?;
                }
                Ok(())
            }
            Some(Message::Command(command)) => {
                self.commands += 1;
                let spoilt = self.fault == Fault::BadCommands && self.commands.is_multiple_of(10);
                let wanted = wrench(&command);
                if spoilt || !wanted.is_finite() {
                    return self.bad_frame(now_ns);
                }
                self.take(command, within_limits(wanted), now_ns)
            }
            _ => self.bad_frame(now_ns),
        }
    }

    /// No force until the next good command; it does not count for the watchdog.
    fn bad_frame(&mut self, now_ns: u64) -> io::Result<()> {
        if self.motors.are_on() {
            self.motors.command(now_ns, Wrench::ZERO)?;
        }
        Ok(())
    }

    fn take(&mut self, command: Command, wanted: Wrench, now_ns: u64) -> io::Result<()> {
        if let Some((last, _)) = &self.command {
            let ahead = command.sequence.wrapping_sub(last.sequence);
            if ahead.cast_signed() <= 0 {
                return Ok(());
            }
            let gap = ahead - 1;
            self.lost_commands = self.lost_commands.wrapping_add(gap as u8);
            self.motors.missed(u64::from(gap));
        }
        let was = self.command.map_or(0, |(last, _)| last.flags);
        self.command = Some((command, now_ns));
        if command.flags & !was & command_flag::HOME != 0
            && let Some(homing_ns) = self.homing_ns
        {
            self.homed = Homed::Until(now_ns + homing_ns);
        }
        if command.flags & command_flag::MOTORS_ON == 0 {
            if self.motors.are_on() {
                self.motors.off(now_ns, Event::Off)?;
            }
            (self.latched, self.cause) = (None, Cause::Command);
            return Ok(());
        }
        if !self.motors.are_on() && self.latched.is_none() {
            self.motors.enable(now_ns)?;
            self.cause = Cause::None;
        }
        self.motors.command(now_ns, wanted)
    }

    /// The mechanics up to now, and the device's own reasons to take the force away.
    pub(crate) fn advance(&mut self, now_ns: u64) -> io::Result<()> {
        let overdue = self.command.is_some_and(|(_, came_ns)| now_ns - came_ns >= WATCHDOG.as_nanos() as u64);
        if overdue && let Homed::Until(_) = self.homed {
            self.homed = Homed::No;
        }
        if let Homed::Until(due_ns) = self.homed
            && now_ns >= due_ns
        {
            self.homed = Homed::Yes;
        }
        if self.motors.are_on() {
            if overdue {
                self.switch_off(now_ns, Event::Watchdog, Cause::Watchdog)?;
            } else if self.hand.velocity().length() > self.max_speed {
                self.switch_off(now_ns, Event::Velocity, Cause::Velocity)?;
            }
        }
        let force_n = self.motors.wrench(now_ns)?.force_n;
        let due = (now_ns - self.start_ns) / self.step_ns;
        // After a stop of the whole machine the hand goes on where it was.
        self.steps = self.steps.max(due.saturating_sub(1000));
        while self.steps < due {
            self.hand.advance(force_n);
            self.steps += 1;
        }
        Ok(())
    }

    fn switch_off(&mut self, now_ns: u64, event: Event, cause: Cause) -> io::Result<()> {
        (self.latched, self.cause) = (Some(cause), cause);
        self.motors.off(now_ns, event)
    }

    /// States, at their rate.
    pub(crate) fn speak(&mut self, line: &mut Line, now_ns: u64) -> io::Result<()> {
        let due = (now_ns - self.start_ns) * u64::from(self.hello.state_rate_hz) / 1_000_000_000;
        if !self.greeted || due <= self.states {
            return Ok(());
        }
        self.states = due;
        self.sequence = self.sequence.wrapping_add(1);
        let tenth = self.sequence.is_multiple_of(10);
        let quiet = match self.fault {
            Fault::NoStates => true,
            Fault::Mute => self.motors.are_on(),
            Fault::Dropped => tenth,
            _ => false,
        };
        if quiet {
            return Ok(());
        }
        let joints = usize::from(self.hello.joints) + usize::from(self.fault == Fault::OtherJoints);
        let frame = self.state(now_ns).frame(joints);
        if self.fault == Fault::Reordered && tenth {
            self.held_back = Some(frame);
            return Ok(());
        }
        line.send(self.fault.spoil_frame(frame.bytes()))?;
        if self.fault == Fault::Repeated && tenth {
            line.send(frame.bytes().to_vec())?;
        }
        match self.held_back.take() {
            Some(frame) => line.send(frame.bytes().to_vec()),
            None => Ok(()),
        }
    }

    fn state(&self, now_ns: u64) -> State {
        let mut flags = 0;
        for (on, flag) in [
            (self.motors.are_on(), state_flag::MOTORS_ON),
            (self.homed == Homed::Yes, state_flag::HOMED),
            (matches!(self.homed, Homed::Until(_)), state_flag::HOMING),
            (self.command.is_some(), state_flag::COMMANDED),
        ] {
            flags |= if on { flag } else { 0 };
        }
        let (command_sequence, age_ns) =
            self.command.map_or((0, 0), |(command, came_ns)| (command.sequence, now_ns - came_ns));
        let mut state = State {
            flags,
            cause: self.cause as u8,
            lost_commands: self.lost_commands,
            sequence: self.sequence,
            command_sequence,
            time_us: (now_ns / 1000) as u32,
            command_age_us: u16::try_from(age_ns / 1000).unwrap_or(u16::MAX),
            buttons: 0b10,
            position_m: self.hand.position().as_vec3().to_array(),
            orientation: [0.0, 0.0, 0.0, 1.0],
            linear_velocity_m_per_s: self.hand.velocity().as_vec3().to_array(),
            angular_velocity_rad_per_s: [0.0; 3],
            gripper_rad: 0.25,
            joints: [0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0],
        };
        self.fault.spoil_state(&mut state);
        state
    }
}

fn wrench(command: &Command) -> Wrench {
    Wrench {
        force_n: Vec3::from_array(command.force_n).as_dvec3(),
        torque_n_m: Vec3::from_array(command.torque_n_m).as_dvec3(),
        gripper_force_n: f64::from(command.gripper_force_n),
    }
}

/// Scaled down to what the motors can do, direction kept.
fn within_limits(wrench: Wrench) -> Wrench {
    let gripper = f64::from(MAX_GRIPPER_FORCE_N);
    Wrench {
        force_n: wrench.force_n.clamp_length_max(f64::from(MAX_FORCE_N)),
        torque_n_m: wrench.torque_n_m.clamp_length_max(f64::from(MAX_TORQUE_N_M)),
        gripper_force_n: wrench.gripper_force_n.clamp(-gripper, gripper),
    }
}
