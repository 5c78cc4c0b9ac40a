//! The safety layer itself: the list of its rules, in order.

use super::clamp::Clamp;
use super::energy::{Energy, EnergyObserver};
use super::engage_gate::{EngageGate, LONGEST_SILENCE_S};
use super::passivity::PassivityController;
use super::slew::Slew;
use super::vector::sum;
use super::velocity_guard::VelocityGuard;
use super::workspace_edge::WorkspaceEdge;
use super::{CheckedSettings, FaultCause, LimitsHit, finite, power};
use crate::source::{ForceOrigin, Wanted};
use crate::{DeviceLimits, DeviceState, Wrench};

/// Without a reading for longer than this the engage gate closes, s.
const LONGEST_BLINDNESS_S: f64 = 0.02;

/// What the motors are to be given in one period.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Applied {
    /// Finite, within every limit, at most one slew step from the one before.
    pub wrench: Wrench,
    /// What is wrong with the handle's motion, or with this layer's own sums; the wrench is on its way to zero already.
    pub fault: Option<FaultCause>,
    /// The rules that changed something.
    pub limits_hit: LimitsHit,
}

/// Turns what is wanted into what the motors may be given. RT safe, but for [`new`](SafetyLayer::new).
#[derive(Clone, Debug)]
pub struct SafetyLayer {
    period_s: f64,
    max_power_w: f64,
    gate: EngageGate,
    clamp: Clamp,
    edge: WorkspaceEdge,
    passivity: PassivityController,
    energy: EnergyObserver,
    slew: Slew,
    guard: VelocityGuard,
    last_ns: Option<u64>,
    blind_s: f64,
    /// The applied wrench times its time since the last reading, where readings are missing since then.
    blind_impulse: Wrench,
    applied: Wrench,
    /// What the passivity controller took out of it.
    kept: Wrench,
    /// Whether it comes from a source that the passivity controller acts on.
    controlled: bool,
    servo_passivity: bool,
}

/// How long a period was.
#[derive(Clone, Copy)]
struct Elapsed {
    /// Since the one before, s.
    elapsed_s: f64,
    /// The same, but never more than a nominal period: what a force may change by does not grow with being late.
    dt_s: f64,
}

impl SafetyLayer {
    /// A layer for a device with these limits, in a loop with this period, s. No force is applied yet.
    pub fn new(settings: &CheckedSettings, limits: &DeviceLimits, period_s: f64) -> SafetyLayer {
        SafetyLayer {
            period_s,
            max_power_w: settings.max_power_w,
            gate: EngageGate::new(settings),
            clamp: Clamp::new(settings, limits),
            edge: WorkspaceEdge::new(limits.workspace, settings.workspace_margin_m),
            passivity: PassivityController::new(settings, period_s),
            energy: EnergyObserver::default(),
            slew: Slew::new(settings),
            guard: VelocityGuard::new(settings.max_speed_m_per_s, period_s),
            last_ns: None,
            blind_s: 0.0,
            blind_impulse: Wrench::ZERO,
            applied: Wrench::ZERO,
            kept: Wrench::ZERO,
            controlled: true,
            servo_passivity: settings.servo_passivity,
        }
    }

    /// One period: what the motors get of `wanted`, for a handle in `state`, which must be finite, at `now_ns` by the
    /// monotonic clock. Where the operating state permits no force, the force goes to zero at the slew limit. RT safe.
    pub fn step(
        &mut self,
        wanted: &Wanted,
        state: &DeviceState,
        permits_force: bool,
        now_ns: u64,
    ) -> Applied {
        let Elapsed { elapsed_s, dt_s } = self.elapsed(now_ns);
        let mut hit = LimitsHit::NONE;
        hit.insert_if(wanted.refused, LimitsHit::NOT_FINITE);
        let held = self.held(elapsed_s);
        self.energy.observe(&held, &self.kept, self.controlled, state, elapsed_s);
        self.controlled = self.controls(wanted.origin);
        let mut fault = self.guard(state, permits_force, elapsed_s);

        let mut target = finite::or_nothing(wanted.wrench, &mut hit);
        self.kept = Wrench::ZERO;
        if permits_force && fault.is_none() {
            let share = self.gate.share(wanted, elapsed_s, dt_s, &mut hit);
            // A share of what is allowed, not of what is wanted, which may be a thousand times as much.
            target = self.clamp.apply(target, &mut hit);
            target = sum(&Wrench::ZERO, &target, share);
            target = self.edge.apply(target, state, &mut hit);
            let before = target;
            if self.controlled {
                target = self.passivity.apply(target, state, &self.energy, share, &mut hit);
            }
            self.kept = sum(&before, &target, -1.0);
            target = power::limited(target, state, self.max_power_w, &mut hit);
            target = self.clamp.apply(target, &mut hit);
        } else {
            self.gate.close();
            target = Wrench::ZERO;
        }
        if !target.is_finite() {
            // Nothing above may come to that. If it does all the same, nobody trusts it from now on.
            hit.insert(LimitsHit::NOT_FINITE);
            self.gate.close();
            (target, self.kept) = (Wrench::ZERO, Wrench::ZERO);
            fault = fault.or(Some(FaultCause::ForceNotFinite));
        }
        self.applied = self.slew.apply(&self.applied, &target, dt_s, &mut hit);
        Applied { wrench: self.applied, fault, limits_hit: hit }
    }

    /// A period whose reading cannot be used: the force goes to zero at the slew limit. RT safe.
    pub fn step_blind(&mut self, now_ns: u64) -> Applied {
        let Elapsed { elapsed_s, dt_s } = self.elapsed(now_ns);
        let mut hit = LimitsHit::NONE;
        self.blind_s += elapsed_s;
        self.blind_impulse = sum(&self.blind_impulse, &self.applied, elapsed_s);
        if self.blind_s > LONGEST_BLINDNESS_S {
            self.gate.close();
        }
        self.kept = Wrench::ZERO;
        self.applied = self.slew.apply(&self.applied, &Wrench::ZERO, dt_s, &mut hit);
        Applied { wrench: self.applied, fault: None, limits_hit: hit }
    }

    /// The largest force from now on, N. Never more than what the layer was made with; a smaller one is reached at the
    /// slew limit. RT safe.
    pub fn set_max_force_n(&mut self, force_n: f64) {
        self.clamp.set_max_force_n(force_n);
    }

    /// The force begins anew, from nothing: by command, which also forgives a debt of energy. RT safe.
    pub fn begin_anew(&mut self) {
        self.gate.close();
        self.energy.begin_anew();
    }

    /// What the motors were given last. RT safe.
    pub fn applied(&self) -> Wrench {
        self.applied
    }

    /// Whether that is nothing: the motors can be switched off without a step. RT safe.
    pub fn is_zero(&self) -> bool {
        self.applied == Wrench::ZERO
    }

    /// Energy between motors and hand since the start. RT safe.
    pub fn energy(&self) -> Energy {
        self.energy.energy()
    }

    /// What the motors held since the last reading: after missing ones, on the average.
    fn held(&mut self, elapsed_s: f64) -> Wrench {
        if self.blind_s <= 0.0 {
            return self.applied;
        }
        let impulse = sum(&self.blind_impulse, &self.applied, elapsed_s);
        let held = sum(&Wrench::ZERO, &impulse, 1.0 / (self.blind_s + elapsed_s));
        self.blind_s = 0.0;
        self.blind_impulse = Wrench::ZERO;
        held
    }

    /// Commanded wrenches may be meant to guide a hand, and then give it energy.
    fn controls(&self, origin: ForceOrigin) -> bool {
        match origin {
            ForceOrigin::ContactLaw | ForceOrigin::Hold => true,
            ForceOrigin::ServoForce => self.servo_passivity,
            // What is still held is the rest of the source before.
            ForceOrigin::Nobody => self.controlled,
        }
    }

    fn elapsed(&mut self, now_ns: u64) -> Elapsed {
        let elapsed_s =
            self.last_ns.map_or(self.period_s, |last_ns| now_ns.saturating_sub(last_ns) as f64 * 1e-9);
        self.last_ns = Some(now_ns);
        if elapsed_s > LONGEST_SILENCE_S {
            self.gate.close();
        }
        Elapsed { elapsed_s, dt_s: elapsed_s.min(self.period_s) }
    }

    /// A handle that nobody drives may be as fast as the hand likes.
    fn guard(&mut self, state: &DeviceState, permits_force: bool, elapsed_s: f64) -> Option<FaultCause> {
        if !permits_force && self.is_zero() {
            self.guard.reset();
            return None;
        }
        self.guard.is_too_fast(state, elapsed_s).then_some(FaultCause::Velocity)
    }
}
