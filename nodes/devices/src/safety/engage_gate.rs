//! Rule: force begins only where it begins from nothing, and then slowly.
//!
//! After a start, an enabling, a fault or a second without any command the gate is closed: no force. It opens when the
//! commanded force was near zero for some periods in a row; then the force grows linearly from nothing to what is
//! wanted. So nobody who enables a device while its probe is deep in a body gets the body's force at once. CHAI3D has
//! the same rule with the same numbers (0.2 N, 5 cycles, 2 s; off by default there).

use super::vector::size;
use super::{LimitsHit, SafetySettings};
use crate::Wrench;
use crate::source::{ForceOrigin, Wanted};

/// Nobody wanting anything for longer than this closes the gate, s.
pub(super) const LONGEST_SILENCE_S: f64 = 1.0;

/// A torque is as near to zero as a force that has this lever, m.
const LEVER_M: f64 = 0.025;

/// The gate with its memory.
#[derive(Clone, Copy, Debug)]
pub(super) struct EngageGate {
    small_n: f64,
    ticks: u32,
    ramp_s: f64,
    state: State,
    silent_s: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// No force, after so many small commands in a row.
    Closed(u32),
    /// Open for so long, s.
    Open(f64),
}

impl EngageGate {
    /// A closed gate.
    pub(super) fn new(settings: &SafetySettings) -> EngageGate {
        EngageGate {
            small_n: settings.engage_force_n,
            ticks: settings.engage_ticks,
            ramp_s: settings.engage_ramp_s,
            state: State::Closed(0),
            silent_s: 0.0,
        }
    }

    /// No force until the gate has opened again. RT safe.
    pub(super) fn close(&mut self) {
        self.state = State::Closed(0);
    }

    /// The share of the force that passes in this period, 0 to 1. RT safe.
    pub(super) fn share(&mut self, wanted: &Wanted, elapsed_s: f64, dt_s: f64, hit: &mut LimitsHit) -> f64 {
        self.silent_s = if wanted.origin == ForceOrigin::Nobody { self.silent_s + elapsed_s } else { 0.0 };
        if self.silent_s > LONGEST_SILENCE_S {
            self.close();
        }
        let share = self.step(wanted, dt_s);
        hit.insert_if(share <= 0.0, LimitsHit::ENGAGE_GATE);
        hit.insert_if(share > 0.0 && share < 1.0, LimitsHit::ENGAGE_RAMP);
        share
    }

    fn step(&mut self, wanted: &Wanted, dt_s: f64) -> f64 {
        match self.state {
            State::Open(since_s) => {
                let since_s = since_s + dt_s;
                self.state = State::Open(since_s);
                if since_s < self.ramp_s { since_s / self.ramp_s } else { 1.0 }
            }
            State::Closed(ticks) => {
                let ticks = if self.is_small(wanted) { ticks.saturating_add(1) } else { 0 };
                self.state = if ticks >= self.ticks { State::Open(0.0) } else { State::Closed(ticks) };
                0.0
            }
        }
    }

    /// Only a fresh command counts: silence says nothing about the command that follows it, and a force on its way from
    /// one source to another is near zero by accident.
    fn is_small(&self, wanted: &Wanted) -> bool {
        let Wrench { force_n, torque_n_m, gripper_force_n } = wanted.wrench;
        wanted.settled
            && wanted.wrench.is_finite()
            && size(force_n) < self.small_n
            && size(torque_n_m) < self.small_n * LEVER_M
            && gripper_force_n.abs() < self.small_n
    }
}
