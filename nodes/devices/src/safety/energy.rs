//! The passivity observer: how much energy the motors have given the hand.
//!
//! A wrench is held from one period to the next, so the energy of a period is exactly the wrench times the displacement
//! measured over it (Hannaford and Ryu, "Time-domain passivity control of haptic interfaces", IEEE Transactions on
//! Robotics and Automation 18(1), 2002, there with velocity times period instead).
//!
//! Noise of the positions is no motion, but it does not average out of that sum: the force answers the very noise that
//! the displacement contains, so a spring of stiffness k held still seems to give k times the noise's variance in every
//! period (4 uW for 1000 N/m, 2 um and 1 kHz). That errs on the safe side; so that it does not eat the credit of a long
//! hold all the same, a credit is made good by 5 uW while the handle is nearly still. The friction of a real handle takes
//! more than that. A deficit is never made good but by the hand.

use glam::{DQuat, DVec3};
use rhombus_chain::Pose;

use crate::{DeviceState, Wrench};

/// What noise may take from a credit without an effect, W ...
const NOISE_W: f64 = 5e-6;
/// ... while the handle is slower than this, m/s.
const STILL_M_PER_S: f64 = 0.01;
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
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct EnergyObserver {
    energy: Energy,
    /// What the hand was given beyond what it has put in, J: positive is a deficit, negative is credit.
    owed_j: f64,
    free_s: f64,
    before: Option<Pose>,
}

/// Faster is no motion of a handle but a wrong position, m/s; and a position may be wrong by so much at any speed, m.
const FASTEST_M_PER_S: f64 = 10.0;
const CLOSEST_M: f64 = 0.001;

impl EnergyObserver {
    /// A new reading, `elapsed_s` after the one before; `held` was commanded all the time in between, and `kept` is what
    /// the controller had taken out of it. What is not `controlled`, because its source may be active, is summed up for
    /// people and owed by nobody. RT safe.
    pub(super) fn observe(
        &mut self,
        held: &Wrench,
        kept: &Wrench,
        controlled: bool,
        state: &DeviceState,
        elapsed_s: f64,
    ) {
        if let Some(before) = self.before
            && state.motors_off.is_none()
        {
            let moved = state.pose.translation - before.translation;
            let turned = turned(before.rotation, state.pose.rotation);
            // A wrong position makes two steps that no handle makes, there and back; and one that is not a number, too.
            let is_motion = moved.length() <= FASTEST_M_PER_S * elapsed_s + CLOSEST_M;
            let energy_j = |wrench: &Wrench| wrench.force_n.dot(moved) + wrench.torque_n_m.dot(turned);
            if is_motion {
                self.energy.given_j += energy_j(held);
                self.energy.dissipated_j += energy_j(kept);
                if controlled {
                    self.owed_j += energy_j(held);
                }
            }
        }
        self.before = Some(state.pose);
        if self.owed_j < 0.0 && state.linear_velocity_m_per_s.length() < STILL_M_PER_S {
            self.owed_j -= NOISE_W * elapsed_s;
        }
        self.drop_credit_when_free(held, elapsed_s);
        self.energy.largest_deficit_j = self.energy.largest_deficit_j.max(self.owed_j);
    }

    /// Forgets what is owed: somebody has looked, and has commanded that the force begin anew. RT safe.
    pub(super) fn begin_anew(&mut self) {
        (self.owed_j, self.before) = (0.0, None);
    }

    /// How much the hand was given beyond what it had put in, J; negative is what it may still get. RT safe.
    pub(super) fn owed_j(&self) -> f64 {
        self.owed_j
    }

    /// The sums for people. RT safe.
    pub(super) fn energy(&self) -> Energy {
        self.energy
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
