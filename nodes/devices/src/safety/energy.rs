//! The passivity observer: how much energy the motors have given the hand.
//!
//! A wrench is held from one period to the next, so the energy of a period is exactly the wrench times the displacement
//! measured over it (Hannaford and Ryu, "Time-domain passivity control of haptic interfaces", IEEE Transactions on
//! Robotics and Automation 18(1), 2002, there with velocity times period instead).
//!
//! Noise of the positions is no motion, but it does not average out of that sum: the force answers the very noise that
//! the displacement contains, so a spring of stiffness k at rest seems to give k times the noise's variance in every
//! period. The seeming part is told from the real one by their time scales. Both are `-df dx / 2` (df: change of the
//! force over the displacement dx); a real motion is nearly the same two periods earlier, white noise is independent of
//! it. So while the handle is slow, the mean of `-df (dx - dx two periods earlier) / 2` is the seeming part, and is
//! taken out.

use glam::{DQuat, DVec3};

use crate::{DeviceState, Wrench};

/// Above this speed noise does not matter and is not taken out, m/s; from half of it on less and less.
const SLOW_M_PER_S: f64 = 0.01;
/// The speed for that is taken over this time, s.
const WINDOW_S: f64 = 0.016;
/// Positions remembered for the window; more than the window needs at the fastest loop.
const REMEMBERED: usize = 128;
/// The handle is free after so long without a force, s.
const FREE_S: f64 = 0.05;

/// Energy between motors and hand since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// What the motors have given the hand, less what the hand has given them, J. Negative: they have taken energy.
    pub given_j: f64,
    /// The most that the hand was ever given beyond what it had put into the contact at hand, J.
    pub largest_deficit_j: f64,
    /// What the passivity controller has kept from the hand, or taken from it, J.
    pub dissipated_j: f64,
}

/// Sums up energy, period for period.
#[derive(Clone, Debug)]
pub(super) struct EnergyObserver {
    period_s: f64,
    window: usize,
    energy: Energy,
    /// What the hand is owed to have put in, J: negative is credit, positive a deficit.
    owed_j: f64,
    free_s: f64,
    positions: [DVec3; REMEMBERED],
    seen: usize,
    rotation: DQuat,
    /// Displacements of the last four periods, newest first.
    moved: [DVec3; 4],
    /// The force before the one that is held now.
    force_before_n: DVec3,
}

impl EnergyObserver {
    pub(super) fn new(period_s: f64) -> EnergyObserver {
        EnergyObserver {
            period_s,
            window: ((WINDOW_S / period_s).round() as usize).clamp(4, REMEMBERED - 1),
            energy: Energy::default(),
            owed_j: 0.0,
            free_s: 0.0,
            positions: [DVec3::ZERO; REMEMBERED],
            seen: 0,
            rotation: DQuat::IDENTITY,
            moved: [DVec3::ZERO; 4],
            force_before_n: DVec3::ZERO,
        }
    }

    /// A new reading, `elapsed_s` after the one before; `held` was commanded all the time in between, and `kept` is what
    /// the controller had taken out of it. RT safe.
    pub(super) fn observe(&mut self, held: &Wrench, kept: &Wrench, state: &DeviceState, elapsed_s: f64) {
        let position = state.pose.translation;
        let motors_on = state.motors_off.is_none();
        if self.seen > 0 {
            let moved = position - self.positions[(self.seen - 1) % REMEMBERED];
            let turned = turned(self.rotation, state.pose.rotation);
            if motors_on {
                let given_j = held.force_n.dot(moved) + held.torque_n_m.dot(turned);
                let seeming_j = self.seeming_j(held.force_n);
                self.energy.given_j += given_j - seeming_j;
                self.energy.dissipated_j += kept.force_n.dot(moved) + kept.torque_n_m.dot(turned);
                self.owed_j += given_j - seeming_j;
            }
            self.moved = [moved, self.moved[0], self.moved[1], self.moved[2]];
        }
        self.force_before_n = held.force_n;
        self.positions[self.seen % REMEMBERED] = position;
        self.rotation = state.pose.rotation;
        // Never back to zero, which means that nothing was seen.
        self.seen = if self.seen == usize::MAX { REMEMBERED } else { self.seen + 1 };
        self.drop_credit_when_free(held, elapsed_s);
        self.energy.largest_deficit_j = self.energy.largest_deficit_j.max(self.owed_j);
    }

    /// No reading in this period. What the next one shows is counted to the wrench that is held then. RT safe.
    pub(super) fn skip(&mut self) {
        self.moved = [DVec3::ZERO; 4];
    }

    /// How much the hand was given beyond what it had put in, J; negative is what it still has to get. RT safe.
    pub(super) fn owed_j(&self) -> f64 {
        self.owed_j
    }

    pub(super) fn energy(&self) -> Energy {
        self.energy
    }

    /// What noise alone has added in the period before last, whose force change is known now.
    fn seeming_j(&self, held_n: DVec3) -> f64 {
        if self.seen <= self.window {
            return 0.0;
        }
        let newest = self.positions[(self.seen - 1) % REMEMBERED];
        let oldest = self.positions[(self.seen - 1 - self.window) % REMEMBERED];
        let speed = (newest - oldest).length() / (self.window as f64 * self.period_s);
        let share = (2.0 - 2.0 * speed / SLOW_M_PER_S).clamp(0.0, 1.0);
        -0.5 * share * (held_n - self.force_before_n).dot(self.moved[0] - self.moved[2])
    }

    /// Credit from one contact is not for the next: a hand that was free begins anew. A deficit stays.
    fn drop_credit_when_free(&mut self, held: &Wrench, elapsed_s: f64) {
        let free = held.force_n == DVec3::ZERO && held.torque_n_m == DVec3::ZERO;
        self.free_s = if free { self.free_s + elapsed_s } else { 0.0 };
        if self.free_s >= FREE_S {
            self.owed_j = self.owed_j.max(0.0);
        }
    }
}

/// The small rotation from one orientation to the next as a vector, rad.
fn turned(from: DQuat, to: DQuat) -> DVec3 {
    let turn = to * from.conjugate();
    2.0 * turn.w.signum() * DVec3::new(turn.x, turn.y, turn.z)
}
