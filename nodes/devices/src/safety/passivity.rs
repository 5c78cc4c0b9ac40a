//! Rule: the motors give the hand no more energy than it has put in.
//!
//! Time-domain passivity control after Hannaford and Ryu (2002, see [`energy`](super::energy)), with two changes that
//! motors in a person's hand ask for:
//!
//! * Force cannot be taken away at once, because the slew limit holds. A force that is large when the energy runs out
//!   goes on driving the hand for milliseconds. So what is kept below the remaining energy is what the force would still
//!   give if it were taken away from now on, by the slew limit, on a light handle: with `p` the momentum that it gives
//!   on the way down and `u` the speed of the handle along it, `p u + p^2 / 2 m`. It is a braking distance for energy.
//! * Only a deficit that exists is worked off by damping, whose coefficient and force are capped: `-E / (T v^2)` of the
//!   original grows without bound as the velocity goes to zero, and turns its noise into force.

use glam::DVec3;

use super::energy::EnergyObserver;
use super::slew::share_of_limit;
use super::vector::{limited, size};
use super::{LimitsHit, SafetySettings};
use crate::{DeviceState, Wrench};

/// The lightest handle with a finger on it, kg. The lighter, the faster it runs away with a force.
const LIGHTEST_KG: f64 = 0.1;
/// The same for rotation, kg m^2: that handle with a radius of gyration of 30 mm.
const LIGHTEST_KG_M2: f64 = 1e-4;
/// A hand may itself accelerate the handle by so much while the force goes away, m/s^2 and rad/s^2.
const HAND_M_PER_S2: f64 = 5.0;
const HAND_RAD_PER_S2: f64 = 100.0;
/// What may be given beyond what was put in, once, J. Below it, forces of up to 5 N are left alone at rest.
const ALLOWANCE_J: f64 = 2e-4;
/// The damper against a deficit, N s/m, and the most it adds, N.
const DAMPING_N_S_PER_M: f64 = 20.0;
const LARGEST_DAMPING_N: f64 = 4.0;

/// The controller.
#[derive(Clone, Copy, Debug)]
pub(super) struct PassivityController {
    on: bool,
    force: Release,
    torque: Release,
    damping_n_s_per_m: f64,
}

impl PassivityController {
    pub(super) fn new(settings: &SafetySettings, period_s: f64) -> PassivityController {
        PassivityController {
            on: settings.passivity,
            force: Release {
                slew_per_s: settings.slew_n_per_s * share_of_limit(period_s),
                period_s,
                inertia: LIGHTEST_KG,
                hand_per_s2: HAND_M_PER_S2,
            },
            torque: Release {
                slew_per_s: settings.torque_slew_n_m_per_s * share_of_limit(period_s),
                period_s,
                inertia: LIGHTEST_KG_M2,
                hand_per_s2: HAND_RAD_PER_S2,
            },
            // A fifth of what stops the lightest handle within one period.
            damping_n_s_per_m: DAMPING_N_S_PER_M.min(0.2 * LIGHTEST_KG / period_s),
        }
    }

    /// The part of `wrench` that the remaining energy is enough for, with damping while there is a deficit: `share` of it,
    /// because it too is a force that has to be let in by the engage gate. RT safe.
    pub(super) fn apply(
        &self,
        wrench: Wrench,
        state: &DeviceState,
        energy: &EnergyObserver,
        share: f64,
        hit: &mut LimitsHit,
    ) -> Wrench {
        if !self.on {
            return wrench;
        }
        let left_j = ALLOWANCE_J - energy.owed_j();
        let (force, torque) = (size(wrench.force_n), size(wrench.torque_n_m));
        let velocity = state.linear_velocity_m_per_s;
        let along =
            |vector: DVec3, size: f64, rate: DVec3| if size > 0.0 { vector.dot(rate) / size } else { 0.0 };
        let speed = along(wrench.force_n, force, velocity);
        let turn = along(wrench.torque_n_m, torque, state.angular_velocity_rad_per_s);
        let mut kept = wrench;
        if self.force.energy_j(force, speed) + self.torque.energy_j(torque, turn) > left_j {
            // By the energy that each would give a handle at rest.
            let (of_force, of_torque) = (self.force.energy_j(force, 0.0), self.torque.energy_j(torque, 0.0));
            let part = of_force / (of_force + of_torque);
            kept.force_n = limited(wrench.force_n, self.force.largest(speed, left_j * part));
            kept.torque_n_m = limited(wrench.torque_n_m, self.torque.largest(turn, left_j * (1.0 - part)));
        }
        if left_j < ALLOWANCE_J {
            let missing = (1.0 - left_j / ALLOWANCE_J).clamp(0.0, 1.0);
            let damping_n = limited(velocity * (self.damping_n_s_per_m * missing), LARGEST_DAMPING_N);
            kept.force_n -= damping_n * share;
        }
        hit.insert_if(kept != wrench, LimitsHit::PASSIVITY);
        kept
    }
}

/// How a force, or a torque, is taken away: at its slew limit, on the lightest handle.
#[derive(Clone, Copy, Debug)]
struct Release {
    slew_per_s: f64,
    period_s: f64,
    inertia: f64,
    hand_per_s2: f64,
}

impl Release {
    /// What a force of `size` gives on the way down, when the handle moves along it at `speed`, J.
    fn energy_j(&self, size: f64, speed: f64) -> f64 {
        let momentum = 0.5 * size * (size / self.slew_per_s + self.period_s);
        momentum * (speed + self.hand(size) + 0.5 * momentum / self.inertia)
    }

    /// The largest force whose way down gives no more than `left_j`; where no force does, the one that brings back most
    /// of what is missing.
    fn largest(&self, speed: f64, left_j: f64) -> f64 {
        let mut size = f64::INFINITY;
        // What the hand may add depends on how long the way down is: the second round knows that well enough.
        let mut hand = 0.0;
        for _ in 0..2 {
            let speed = speed + hand;
            let momentum = self.inertia
                * (-speed + (speed * speed + 2.0 * left_j / self.inertia).max(0.0).sqrt()).max(0.0);
            let half = 0.5 * self.slew_per_s * self.period_s;
            size = -half + (half * half + 2.0 * self.slew_per_s * momentum).sqrt();
            hand = self.hand(size);
        }
        size
    }

    fn hand(&self, size: f64) -> f64 {
        self.hand_per_s2 * (size / self.slew_per_s + self.period_s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;
    use rhombus_chain::Pose;

    fn at(x: f64, velocity: DVec3) -> DeviceState {
        DeviceState {
            linear_velocity_m_per_s: velocity,
            ..DeviceState::at_rest(Pose { translation: DVec3::X * x, rotation: DQuat::IDENTITY })
        }
    }

    /// Whoever was given 0.1 J.
    fn deficit() -> EnergyObserver {
        let mut energy = EnergyObserver::default();
        let held = Wrench::of_force(DVec3::X * 10.0);
        energy.observe(&held, &Wrench::ZERO, true, &at(0.0, DVec3::ZERO), 1e-3);
        energy.observe(&held, &Wrench::ZERO, true, &at(0.01, DVec3::ZERO), 1e-3);
        energy
    }

    #[test]
    fn damping_is_along_the_velocity_and_capped_in_coefficient_and_force() {
        let controller = PassivityController::new(&SafetySettings::default(), 1e-3);
        let along = DVec3::new(0.6, 0.0, -0.8);
        for (speed, damping_n) in
            [(0.0, 0.0), (1e-300, 2e-299), (0.01, 0.2), (0.1, 2.0), (0.2, 4.0), (1.5, 4.0)]
        {
            let mut hit = LimitsHit::NONE;
            let got = controller.apply(Wrench::ZERO, &at(0.0, along * speed), &deficit(), 1.0, &mut hit);
            assert!((got.force_n + along * damping_n).length() <= 1e-11 * damping_n, "{speed}: {got:?}");
            let half = controller.apply(Wrench::ZERO, &at(0.0, along * speed), &deficit(), 0.5, &mut hit);
            assert!((half.force_n - 0.5 * got.force_n).length() <= 1e-12);
        }
        // A slow loop holds a force for longer, and stops a handle in fewer periods.
        let slow = PassivityController::new(&SafetySettings::default(), 0.1);
        let got = slow.apply(Wrench::ZERO, &at(0.0, DVec3::X), &deficit(), 1.0, &mut LimitsHit::default());
        assert!((got.force_n.x + 0.2).abs() < 1e-12, "{got:?}");
    }

    #[test]
    fn where_energy_is_missing_a_force_may_only_take_it() {
        let controller = PassivityController::new(&SafetySettings::default(), 1e-3);
        let push = Wrench { torque_n_m: DVec3::Z * 0.2, ..Wrench::of_force(DVec3::X * 10.0) };
        let with =
            |velocity| controller.apply(push, &at(0.0, velocity), &deficit(), 1.0, &mut LimitsHit::default());
        assert_eq!(with(DVec3::ZERO), Wrench::ZERO);
        assert!(with(DVec3::X * 0.1).force_n.x < 0.0);
        assert!(with(DVec3::X * -0.1).force_n.x > 1.0, "it slows down a hand that comes");
    }
}
