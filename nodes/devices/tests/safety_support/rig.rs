//! A safety layer with a handle whose motion the test prescribes, and the record of every period.

use devices::safety::{Applied, CheckedSettings, Energy, LimitsHit, SafetyLayer, SafetySettings};
use devices::source::{ForceOrigin, Wanted};
use devices::{DeviceLimits, DeviceState, Workspace, Wrench};
use glam::{DQuat, DVec3};
use rhombus_chain::Pose;

pub(crate) const PERIOD_NS: u64 = 1_000_000;
pub(crate) const PERIOD_S: f64 = 1e-3;

/// No command steps by more than the slew limits allow in this time.
pub(crate) const LONGEST_STEP_S: f64 = 2e-3;

pub(crate) const LIMITS: DeviceLimits = DeviceLimits {
    max_force_n: Some(15.0),
    max_torque_n_m: Some(0.4),
    max_gripper_force_n: Some(6.0),
    workspace: Workspace { centre: DVec3::ZERO, radius_m: 0.18, height_m: 0.3 },
};

/// One period as a test asks for it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ask {
    pub(crate) wrench: Wrench,
    pub(crate) state: DeviceState,
    pub(crate) permits: bool,
    pub(crate) after_ns: u64,
    /// No reading.
    pub(crate) blind: bool,
    pub(crate) origin: ForceOrigin,
    pub(crate) settled: bool,
}

impl Default for Ask {
    fn default() -> Ask {
        Ask {
            wrench: Wrench::ZERO,
            state: still(DVec3::ZERO),
            permits: true,
            after_ns: PERIOD_NS,
            blind: false,
            origin: ForceOrigin::ServoForce,
            settled: true,
        }
    }
}

impl Ask {
    pub(crate) fn force(force_n: DVec3) -> Ask {
        Ask { wrench: Wrench::of_force(force_n), ..Ask::default() }
    }
}

/// What came of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Done {
    pub(crate) ask: Ask,
    pub(crate) before: Wrench,
    pub(crate) applied: Applied,
    pub(crate) energy: Energy,
}

impl Done {
    pub(crate) fn force_n(&self) -> DVec3 {
        self.applied.wrench.force_n
    }

    pub(crate) fn hit(&self, rule: LimitsHit) -> bool {
        self.applied.limits_hit.contains(rule)
    }
}

pub(crate) struct Rig {
    pub(crate) layer: SafetyLayer,
    pub(crate) settings: CheckedSettings,
    period_s: f64,
    now_ns: u64,
}

pub(crate) fn still(at: DVec3) -> DeviceState {
    DeviceState::at_rest(Pose { translation: at, rotation: DQuat::IDENTITY })
}

pub(crate) fn moving(at: DVec3, velocity: DVec3) -> DeviceState {
    DeviceState { linear_velocity_m_per_s: velocity, ..still(at) }
}

/// The default settings without the passivity controller, for tests of other rules.
pub(crate) fn without_passivity() -> CheckedSettings {
    super::checked(false)
}

impl Rig {
    pub(crate) fn new(settings: CheckedSettings) -> Rig {
        Rig::at_period(settings, PERIOD_S)
    }

    /// A layer of a loop with another period, which every step of the test has to name.
    pub(crate) fn at_period(settings: CheckedSettings, period_s: f64) -> Rig {
        let layer = SafetyLayer::new(&settings, &LIMITS, period_s);
        Rig { layer, settings, period_s, now_ns: 1_000_000_000 }
    }

    /// A layer that was asked for nothing for so many periods: the gate opens after 5.
    pub(crate) fn engaged_for(settings: CheckedSettings, ticks: usize) -> Rig {
        let mut rig = Rig::new(settings);
        rig.steps(Ask::default(), ticks);
        rig
    }

    /// A layer whose gate is open and whose ramp is over.
    pub(crate) fn engaged(settings: CheckedSettings, state: DeviceState) -> Rig {
        let mut rig = Rig::new(settings);
        for _ in 0..2100 {
            rig.step(Ask { state, ..Ask::default() });
        }
        rig
    }

    pub(crate) fn step(&mut self, ask: Ask) -> Done {
        self.now_ns += ask.after_ns;
        let before = self.layer.applied();
        let wanted =
            Wanted { wrench: ask.wrench, origin: ask.origin, settled: ask.settled, ..Wanted::default() };
        let applied = if ask.blind {
            self.layer.step_blind(self.now_ns)
        } else {
            self.layer.step(&wanted, &ask.state, ask.permits, self.now_ns)
        };
        let done = Done { ask, before, applied, energy: self.layer.energy() };
        self.check(&done);
        done
    }

    pub(crate) fn steps(&mut self, ask: Ask, count: usize) -> Vec<Done> {
        (0..count).map(|_| self.step(ask)).collect()
    }

    /// What holds in every period, whatever is asked.
    fn check(&self, done: &Done) {
        let Wrench { force_n, torque_n_m, gripper_force_n } = done.applied.wrench;
        let dt_s = (done.ask.after_ns as f64 * 1e-9).min(self.period_s).min(LONGEST_STEP_S);
        let SafetySettings { slew_n_per_s, torque_slew_n_m_per_s, gripper_slew_n_per_s, .. } = *self.settings;
        assert!(done.applied.wrench.is_finite(), "{done:?}");
        assert!(force_n.length() <= 15.0, "{done:?}");
        assert!(torque_n_m.length() <= 0.4, "{done:?}");
        assert!(gripper_force_n.abs() <= 6.0, "{done:?}");
        assert!((force_n - done.before.force_n).length() <= slew_n_per_s * dt_s, "{done:?}");
        assert!((torque_n_m - done.before.torque_n_m).length() <= torque_slew_n_m_per_s * dt_s, "{done:?}");
        assert!(
            (gripper_force_n - done.before.gripper_force_n).abs() <= gripper_slew_n_per_s * dt_s,
            "{done:?}"
        );
        assert_eq!(self.layer.applied(), done.applied.wrench);
        assert_eq!(self.layer.is_zero(), done.applied.wrench == Wrench::ZERO);
    }
}
