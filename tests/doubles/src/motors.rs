//! What a device's amplifiers do: hold the last command until the next, or until the device's own watchdog.

use std::io;
use std::time::Duration;

use devices::Wrench;

use crate::{Event, Record};

/// Motors with their record.
#[derive(Debug)]
pub struct Motors {
    watchdog_ns: Option<u64>,
    record: Record,
    on: bool,
    held: Wrench,
    commanded_ns: u64,
    /// That the driver made, as far as the device can tell.
    commands: u64,
}

impl Motors {
    /// Motors that are off. Without a watchdog they hold the last command for ever.
    pub fn new(watchdog: Option<Duration>, record: Record) -> Motors {
        let mut motors =
            Motors { watchdog_ns: None, record, on: false, held: Wrench::ZERO, commanded_ns: 0, commands: 0 };
        motors.set_watchdog(watchdog);
        motors
    }

    /// Another time without a command, or none.
    pub fn set_watchdog(&mut self, watchdog: Option<Duration>) {
        self.watchdog_ns = watchdog.map(|time| u64::try_from(time.as_nanos()).unwrap_or(u64::MAX));
    }

    /// Motors on, without a force.
    ///
    /// # Errors
    /// The record cannot be written.
    pub fn enable(&mut self, now_ns: u64) -> io::Result<()> {
        (self.on, self.held, self.commanded_ns) = (true, Wrench::ZERO, now_ns);
        self.record.write(now_ns, Event::Enable, &Wrench::ZERO, self.commands)
    }

    /// Motors off, and why.
    ///
    /// # Errors
    /// The record cannot be written.
    pub fn off(&mut self, now_ns: u64, event: Event) -> io::Result<()> {
        (self.on, self.held) = (false, Wrench::ZERO);
        self.record.write(now_ns, event, &Wrench::ZERO, self.commands)
    }

    /// A command. Motors that are off take it and do nothing.
    ///
    /// # Errors
    /// The record cannot be written.
    pub fn command(&mut self, now_ns: u64, wrench: Wrench) -> io::Result<()> {
        self.update(now_ns)?;
        self.commanded_ns = now_ns;
        self.commands += 1;
        if self.on {
            self.held = wrench;
        }
        self.record.write(now_ns, Event::Command, &self.held, self.commands)
    }

    /// So many commands were made and never came.
    pub fn missed(&mut self, commands: u64) {
        self.commands += commands;
    }

    /// Whether they are on.
    pub fn are_on(&self) -> bool {
        self.on
    }

    /// Lets the watchdog act: after its time without a command the motors are off. Returns whether it just did.
    ///
    /// # Errors
    /// The record cannot be written.
    pub fn update(&mut self, now_ns: u64) -> io::Result<bool> {
        let Some(watchdog_ns) = self.watchdog_ns else { return Ok(false) };
        let due_ns = self.commanded_ns.saturating_add(watchdog_ns);
        if !self.on || now_ns < due_ns {
            return Ok(false);
        }
        // The line has the time at which this was noticed, which is when the force really went.
        self.off(now_ns, Event::Watchdog)?;
        Ok(true)
    }

    /// The wrench on the hand now.
    ///
    /// # Errors
    /// The record cannot be written.
    pub fn wrench(&mut self, now_ns: u64) -> io::Result<Wrench> {
        self.update(now_ns)?;
        Ok(self.held)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    const MS: u64 = 1_000_000;

    fn motors() -> Motors {
        Motors::new(Some(Duration::from_millis(20)), Record::create(None).unwrap())
    }

    #[test]
    fn the_last_command_is_held_until_the_watchdog_and_then_the_motors_stay_off() {
        let mut motors = motors();
        let push = Wrench::of_force(DVec3::X);
        motors.enable(0).unwrap();
        motors.command(5 * MS, push).unwrap();
        assert_eq!(motors.wrench(24 * MS).unwrap(), push);
        assert_eq!(motors.wrench(25 * MS).unwrap(), Wrench::ZERO);
        motors.command(26 * MS, push).unwrap();
        assert_eq!(motors.wrench(26 * MS).unwrap(), Wrench::ZERO, "only enabling brings them back");
        motors.enable(27 * MS).unwrap();
        motors.command(28 * MS, push).unwrap();
        assert_eq!(motors.wrench(28 * MS).unwrap(), push);
    }

    #[test]
    fn motors_that_are_off_push_with_nothing() {
        let mut motors = motors();
        motors.command(MS, Wrench::of_force(DVec3::X)).unwrap();
        assert_eq!(motors.wrench(MS).unwrap(), Wrench::ZERO);
        motors.enable(2 * MS).unwrap();
        motors.command(3 * MS, Wrench::of_force(DVec3::X)).unwrap();
        motors.off(4 * MS, Event::Off).unwrap();
        assert_eq!(motors.wrench(5 * MS).unwrap(), Wrench::ZERO);
    }
}
