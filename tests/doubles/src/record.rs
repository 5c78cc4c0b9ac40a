//! The record of what reached the motors, one line for each event.

use std::fs::File;
use std::io::{self, Write};
use std::path::Path;

use devices::Wrench;

/// What happened at the motors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// Motors on.
    Enable,
    /// A command arrived.
    Command,
    /// Motors off by command.
    Off,
    /// The device's own watchdog took the force away.
    Watchdog,
    /// The device's own speed limit took the force away.
    Velocity,
    /// The peer closed the line.
    Gone,
}

impl Event {
    fn word(self) -> &'static str {
        match self {
            Event::Enable => "enable",
            Event::Command => "command",
            Event::Off => "off",
            Event::Watchdog => "watchdog",
            Event::Velocity => "velocity",
            Event::Gone => "gone",
        }
    }
}

/// A CSV file `t_ns,event,fx,fy,fz,tx,ty,tz,grip,commands`, or nothing. Times are [`monotonic_ns`](crate::monotonic_ns); forces and
/// torques are those the motors give from then on.
#[derive(Debug)]
pub struct Record {
    file: Option<File>,
}

impl Record {
    /// Begins a record; without a path nothing is recorded.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn create(path: Option<&Path>) -> io::Result<Record> {
        let mut file = path.map(File::create).transpose()?;
        if let Some(file) = &mut file {
            file.write_all(b"t_ns,event,fx,fy,fz,tx,ty,tz,grip,commands\n")?;
        }
        Ok(Record { file })
    }

    /// Writes one line, which reaches the file at once: the process may be killed.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&mut self, t_ns: u64, event: Event, wrench: &Wrench, commands: u64) -> io::Result<()> {
        let Some(file) = &mut self.file else { return Ok(()) };
        let (f, t) = (wrench.force_n, wrench.torque_n_m);
        let line = format!(
            "{t_ns},{},{},{},{},{},{},{},{},{commands}\n",
            event.word(),
            f.x,
            f.y,
            f.z,
            t.x,
            t.y,
            t.z,
            wrench.gripper_force_n
        );
        file.write_all(line.as_bytes())
    }
}
